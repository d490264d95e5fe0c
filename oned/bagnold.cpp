#include "oned/bagnold.hpp"

#include <cmath>

#include "common/io/table.hpp"

namespace talus::oned {

ShearScene scene_of(const Bagnold& bagnold) {
  const double H = bagnold.height, alpha = bagnold.angle;
  const rheology::Rheology limit(bagnold.law, bagnold.regularisation);
  const rheology::FrictionLaw& law = limit.law;
  const double I_alpha = limit.limit_inertial_number(std::tan(alpha));  // eq. (19)
  const double rate = I_alpha * std::sqrt(law.solid_fraction * std::cos(alpha)) / law.grain_size;
  ShearScene scene;
  scene.name = "bagnold";
  scene.title = "inclined plane";
  scene.coordinate = "z";
  scene.velocity = "u";
  scene.length = H;
  scene.wall_at_start = true;
  scene.limit = limit;
  scene.body_force = [=](double) { return std::sin(alpha); };
  scene.pressure = [=](double z) { return (H - z) * std::cos(alpha); };
  scene.stress_ratio = std::tan(alpha);
  scene.limits = rest_limit(limit, "angle <= ", std::atan(law.mu_s)) +
                 "no steady flow for angle >= " + io::rounded(std::atan(law.mu_2()), 6);
  scene.lambda_r = 1e-8;
  scene.exact_shear_rate = [=](double z) { return rate * std::sqrt(H - z); };  // eq. (30)
  scene.exact_velocity = [=](double z) {                                       // eq. (18)
    return 2. / 3 * rate * (std::pow(H, 1.5) - std::pow(H - z, 1.5));
  };
  scene.exact_stress = [=](double z) { return (H - z) * std::sin(alpha); };
  const std::vector<int> meshes{20, 40, 80, 160, 320};
  scene.order_cases = {
      {"uniform", {}, meshes, Orders{2, 2.5, 1.5, 1.5, 0.1}},
      {"graded, exponent 2", {.grading = 2}, meshes, Orders{3, 3.98, 3, 3, 0.05}},
      {"graded, exponent 3", {.grading = 3}, meshes, Orders{3, 4.5, 3.95, 3, 0.05}},
      {"graded, exponent 4", {.grading = 4}, meshes, Orders{3, 4.5, 3.95, 3, 0.05}}};
  scene.load = {"α", 0.34, 0.406, 0.6, [bagnold](double angle) {
                  Bagnold other = bagnold;
                  other.angle = angle;
                  return scene_of(other);
                }};
  scene.under = [bagnold](const rheology::Regularisation& regularisation) {
    Bagnold other = bagnold;
    other.regularisation = regularisation;
    return scene_of(other);
  };
  return scene;
}

}  // namespace talus::oned
