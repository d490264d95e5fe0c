// Where Newton's method fails in the heap's section and in space, by the programs themselves.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Cases of a scene that are to be mapped, as words after `./run study stability`.
struct MapQuestion {
  std::string name, title, scene, words;
  /// Share of the cases that arrives, and of those with a broken tangent.
  double least = 0, most = 1, most_broken = 1;
};

/// Tangents, searches and what then works, over λr and meshes.
std::vector<MapQuestion> map_questions(bool full);

/// A map of each with the end of every cell, and a check of the share that arrives. Nothing that
/// leaves no record arrives.
void add_model_maps(Chapter& chapter, const std::vector<MapQuestion>& questions,
                    const std::function<void(double)>& progress);

}  // namespace talus::verification
