// Work done side by side, until it is interrupted.
#pragma once

#include <functional>

namespace talus::process {

/// Calls `work` for 0 to count - 1, so many at a time, until SIGINT or SIGTERM: what has begun then
/// ends, nothing else begins. Whether all were called.
bool in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);

/// Whether one of these came.
bool interrupted();

}  // namespace talus::process
