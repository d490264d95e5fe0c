#include "oned/chute.hpp"

#include <cmath>

#include "common/io/table.hpp"

namespace talus::oned {

ShearScene scene_of(const Chute& chute) {
  const double half = chute.width / 2, p = chute.pressure;
  const rheology::Rheology limit(chute.law, chute.regularisation);
  const rheology::FrictionLaw& law = limit.law;
  const double rate = law.reference_shear_rate(p) / law.I0;  // of I = 1
  const double kink = limit.limit_kink() * p;
  ShearScene scene;
  scene.name = "chute";
  scene.title = "vertical chute";
  scene.coordinate = "y";
  scene.velocity = "w";
  scene.length = half;
  scene.wall_at_start = false;
  scene.limit = limit;
  scene.body_force = [](double) { return 1.; };
  scene.pressure = [p](double) { return p; };
  scene.stress_ratio = half / p;
  scene.limits = rest_limit(limit, "pressure >= ", half / law.mu_s) +
                 "no steady flow for pressure <= " + io::rounded(half / law.mu_2(), 6);
  if (kink < half) scene.kink = kink;
  scene.lambda_r = 1e-4;
  scene.exact_shear_rate = [=](double y) { return rate * limit.limit_inertial_number(y / p); };
  const double wall = limit.limit_inertial_number_integral(half / p);
  scene.exact_velocity = [=](double y) {
    return rate * p * (wall - limit.limit_inertial_number_integral(y / p));
  };
  scene.exact_stress = [](double y) { return y; };  // eq. (21)
  // Where a creep ends the slope jumps by 5% only: order 3 turns into 2 along the family.
  const auto mid_element = rheology::has_yield_stress(limit.regularisation)
                               ? std::optional(Orders{2, 2.5, 2, 2, 0.05})
                               : std::nullopt;
  // Every 17 elements put 13 into the plug: y0/(b/2) = 0.766 = 13/17, so in multiples of 34 as
  // well.
  scene.order_cases = {{"node at y0",
                        {.align = 0.0},
                        {136, 170, 204, 272, 340, 408, 544, 816},
                        Orders{3, 4.5, 4, 3, 0.05}},
                       {"y0 mid-element", {.align = 0.5}, {20, 40, 80, 160, 320, 640}, mid_element},
                       {"uniform", {}, {5, 10, 20, 40, 80, 160, 320, 640}, std::nullopt}};
  scene.load = {"p", 40, 28, 20, [chute](double pressure) {
                  Chute other = chute;
                  other.pressure = pressure;
                  return scene_of(other);
                }};
  scene.under = [chute](const rheology::Regularisation& regularisation) {
    Chute other = chute;
    other.regularisation = regularisation;
    return scene_of(other);
  };
  return scene;
}

}  // namespace talus::oned
