// The registry of one-dimensional scenes, with the paper's parameters. A scene added here appears
// in every study and chart.
#pragma once

#include <vector>

#include "oned/bagnold.hpp"
#include "oned/chute.hpp"

namespace talus::oned {

inline std::vector<ShearScene> scenes() {
  return {scene_of(Chute{}), scene_of(Bagnold{})};
}

}  // namespace talus::oned
