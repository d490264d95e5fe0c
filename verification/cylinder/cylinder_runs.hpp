// Runs of the cylinder that the studies share: creep, and paths past yield.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "twod/cylinder.hpp"

namespace talus::verification {

/// The scene with so many elements around.
twod::Cylinder cylinder_around(int around,
                               const rheology::Regularisation& law = rheology::ChauchatMedale{});

/// eq. (12), and every law of the registry without a yield stress: the controls.
std::vector<rheology::Regularisation> laws_of_paths();

/// A loading that the cylinder holds, solved from rest down to round-off: at once, or, with an open
/// outlet or where that fails along a path in λr.
struct Creep {
  twod::CylinderMeasures measures;  ///< NaN if it failed
  std::size_t elements = 0;
  int factorisations = 0;
  double seconds = 0;  ///< CPU time, set-up included
};
Creep creep_at(const twod::Cylinder& scene, double loading);

/// Flows at several loadings on one mesh: each without a path where it creeps, else down in λr.
struct Flows {
  std::unique_ptr<twod::CylinderFlow> cylinder;
  std::vector<twod::CylinderMeasures> measures;   ///< one a loading; NaN if it was not reached
  std::vector<twod::CylinderFlow::State> states;  ///< of the same; empty if it was not reached
  int factorisations = 0;

  /// Of these loadings. Throws std::out_of_range if it is none of them.
  std::size_t index_of(double loading) const;
};
Flows flows_at(
    const twod::Cylinder& scene, const std::vector<double>& loadings,
    const std::function<void(double fraction)>& progress = [](double) {});

/// A path, point by point.
struct Followed {
  solve::PathEnd end = solve::PathEnd::start_failed;
  std::vector<twod::CylinderMeasures> measures;
  std::vector<solve::PathPoint> points;
  int factorisations = 0;
  double seconds = 0;

  bool arrived() const { return end == solve::PathEnd::target_reached; }
  twod::CylinderMeasures last() const;  ///< NaN if there is no point
  int folds() const;
  double largest_loading() const;    ///< NaN if there is no point
  double smallest_lambda_r() const;  ///< the same
};

/// From creep at F = 0.044 along the loading, at the scene's λr.
Followed along_loading(const twod::Cylinder& scene, double target, twod::Continuation continuation,
                       int max_points);
/// At a loading, from λr = 0.1 down to the scene's.
Followed along_lambda_r(const twod::Cylinder& scene, double loading,
                        twod::Continuation continuation, int max_points);

}  // namespace talus::verification
