// Depth of a flowing layer, down from the free surface.
#pragma once

#include <span>

namespace talus::oned {

/// Where a profile first falls to a threshold, going down: `depth` ascending from the surface, with
/// the value at each; linear between them. `bottom` where it never does, 0 where it starts there.
inline double depth_of_fall(std::span<const double> depth, std::span<const double> value,
                            double threshold, double bottom) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (value[i] > threshold) continue;
    if (i == 0 || value[i - 1] <= threshold) return depth[i == 0 ? 0 : i - 1];
    const double share = (value[i - 1] - threshold) / (value[i - 1] - value[i]);
    return depth[i - 1] + share * (depth[i] - depth[i - 1]);
  }
  return bottom;
}

}  // namespace talus::oned
