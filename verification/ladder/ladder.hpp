// The ladder of models: one scene in a poorer and a richer model, rung by rung.
#pragma once

#include <string>
#include <vector>

#include "common/mixed/extrusion.hpp"
#include "common/solve/end.hpp"
#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// What a model took to solve a case.
struct ModelCost {
  solve::End end = solve::End::stagnated;
  int iterations = 0;
  bool continued = false;     ///< by continuation in λr, for Newton from rest failed
  Eigen::Index unknowns = 0;  ///< velocities and pressures
  Eigen::Index condensed = 0;
  double seconds = 0;       ///< CPU time from nothing, set-up included
  double factor_bytes = 0;  ///< of the factors of the linear system
};

/// A scene solved in both models, on the same elements across.
struct RungCase {
  std::string what;  ///< law, λr, mesh
  mixed::Departure apart;
  ModelCost poorer, richer;
  bool same_start = true;  ///< else the richer one started from the poorer's solution
  bool solved() const { return solve::is_success(poorer.end) && solve::is_success(richer.end); }
};

/// Two models of a scene.
struct Rung {
  std::string scene, poorer, richer;
  double target = 1e-10;  ///< largest distance, of all three kinds
  std::vector<RungCase> cases;

  double farthest() const;  ///< velocity, cross-flow or pressure; NaN if a case was not solved
  /// CPU time of the richer over the poorer, all cases with the same start together.
  double times_cpu() const;
  double times_memory() const;      ///< of the factors, in the largest case
  const RungCase& largest() const;  ///< the last one with the same start
};

/// All rungs: they share an overview.
void ladder_study(Chapter& chapter, const Context& context);

/// Chute and inclined plane on a line against the plane and against space.
std::vector<Rung> line_rungs(const Context& context);
/// The cylinder in the plane against one layer of H27 elements.
std::vector<Rung> cylinder_rungs(const Context& context);
/// The heap as its cross-section against one layer of H27 elements along the stream.
std::vector<Rung> heap_rungs(const Context& context);

/// Negative controls: how far apart the two models are where one is driven by so much more.
double lines_apart_with_force_times(double factor);
double cylinder_apart_with_force_times(double factor);

}  // namespace talus::verification
