#include "oned/chute.hpp"

#include <algorithm>
#include <cmath>

#include "common/io/table.hpp"

namespace talus::oned {

ShearScene scene_of(const Chute& chute) {
  const double half = chute.width / 2, p = chute.pressure;
  const rheology::FrictionLaw law = chute.law;
  const double y0 = law.mu_s * p, span = law.delta_mu * p;
  ShearScene scene;
  scene.name = "chute";
  scene.title = "vertical chute";
  scene.coordinate = "y";
  scene.velocity = "w";
  scene.length = half;
  scene.wall_at_start = false;
  scene.law = law;
  scene.body_force = 1;
  scene.pressure = [p](double) { return p; };
  scene.stress_ratio = half / p;
  scene.limits = "at rest for pressure >= " + io::rounded(half / law.mu_s, 6) +
                 ", no steady flow for pressure <= " + io::rounded(half / law.mu_2(), 6);
  if (y0 < half) scene.yield_point = y0;
  scene.lambda_r = 1e-4;
  scene.exact_shear_rate = [law, p](double y) { return law.shear_rate(y, p); };  // eq. (25)
  scene.exact_velocity = [=](double y) {                                         // eq. (17)
    const double s = std::max(y, y0);
    if (half <= y0) return 0.0;
    return law.reference_shear_rate(p) *
           ((s - half) + span * std::log((span - (s - y0)) / (span - (half - y0))));
  };
  scene.exact_stress = [](double y) { return y; };  // eq. (21)
  // Every 17 elements put 13 into the plug: y0/(b/2) = 0.766 = 13/17, so in multiples of 34 as
  // well.
  scene.order_cases = {
      {"node at y0",
       {.align = 0.0},
       {136, 170, 204, 272, 340, 408, 544, 816},
       Orders{3, 4.5, 4, 3, 0.05}},
      {"y0 mid-element", {.align = 0.5}, {20, 40, 80, 160, 320, 640}, Orders{2, 2.5, 2, 2, 0.05}},
      {"uniform", {}, {5, 10, 20, 40, 80, 160, 320, 640}, std::nullopt}};
  scene.load = {"p", 40, 28, 20, [chute](double pressure) {
                  Chute other = chute;
                  other.pressure = pressure;
                  return scene_of(other);
                }};
  return scene;
}

}  // namespace talus::oned
