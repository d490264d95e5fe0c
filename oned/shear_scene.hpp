// A scene of unidirectional flow across a line: what chute and bagnold have in common.
//
// Dimensionless as in the paper: lengths in d, stress in φρgd, velocity in sqrt(gd). The velocity
// is positive along the driving force.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/rheology/rheology.hpp"

namespace talus::oned {

/// How a line is divided; see fem::graded_line and fem::aligned_line.
struct MeshOptions {
  int elements = 40;
  double grading = 1;  ///< exponent, 1 = uniform
  std::optional<double> align =
      std::nullopt;  ///< place of the scene's kink in its element, 0 = node
};

/// Orders of convergence in the four norms of Errors, with the allowed distance from each.
struct Orders {
  double l2 = 0, paper_rms = 0, nodal_max = 0, max = 0;
  double tolerance = 0.1;
};

/// A family of meshes on which an order is known; no orders where none can be fitted.
struct OrderCase {
  std::string name;
  MeshOptions mesh;
  std::vector<int> elements;
  std::optional<Orders> expected;
};

struct ShearScene;

/// The load of a scene, varied past both limits of existence.
struct LoadSweep {
  std::string symbol;
  double rest = 0, usual = 0,
         fast = 0;  ///< a load at rest, one that flows, one past the fast limit
  std::function<ShearScene(double load)> scene;
};

struct ShearScene {
  std::string name, title;
  std::string coordinate, velocity;  ///< symbols for axes: "y" and "w", "z" and "u"
  double length = 0;
  bool wall_at_start = false;  ///< no slip at 0 (else at `length`); the other end carries no stress
  rheology::Rheology limit;    ///< the exact profiles are those of its limit λr → 0
  std::function<double(double)> pressure, body_force;  ///< in φρgd and φρg
  double stress_ratio = 0;                             ///< largest shear stress over pressure
  std::string limits;          ///< of existence, in terms of the scene's load parameter
  std::optional<double> kink;  ///< of the shear rate: the end of a plug, or of the law's creep
  double lambda_r = 1e-6;      ///< the paper's

  std::function<double(double)> exact_velocity;  ///< of a flowing or resting scene
  std::function<double(double)> exact_shear_rate;
  std::function<double(double)> exact_stress;

  std::vector<OrderCase> order_cases;
  LoadSweep load;
  /// The same scene, exact for what another regularisation tends to.
  std::function<ShearScene(const rheology::Regularisation&)> under;

  const rheology::FrictionLaw& law() const { return limit.law; }
  rheology::Regime regime() const { return rheology::regime_under(limit, stress_ratio); }
};

/// "at rest for " and the bound, or that nothing ever is, for the start of ShearScene::limits.
std::string rest_limit(const rheology::Rheology& limit, const std::string& load, double bound);

/// Element boundaries of `scene`. Throws io::UserError if its kink cannot be placed, or if the
/// narrowest element has no width (program::check_grading).
std::vector<double> boundaries(const ShearScene& scene, const MeshOptions& mesh);

}  // namespace talus::oned
