// Words as a shell reads them.
#pragma once

#include <string>

namespace talus::io {

/// The text in single quotes, if the shell needs them; control characters escaped.
std::string shell_word(const std::string& text);

}  // namespace talus::io
