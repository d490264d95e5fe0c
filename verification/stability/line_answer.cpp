#include "verification/stability/line_answer.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace talus::verification {
namespace {

constexpr std::array<double, 3> shape = {0.4, -0.5, 0.4};  // φ
const double gauss_point = std::sqrt(0.6);
constexpr double round_off = std::numeric_limits<double>::epsilon();

// Root of an increasing function with f(lower) <= 0 <= f(upper), to `resolution`: Newton's steps,
// and the middle where they lead out of the bracket or are not half as long as the last.
template <class Function>
double root_of(const Function& f, double start, double lower, double upper, double resolution) {
  double x = start, last = upper - lower;
  for (int i = 0; i < 100; ++i) {
    const Rate at = f(x);
    if (at.value == 0) return x;
    (at.value > 0 ? upper : lower) = x;
    double step = -at.value / at.slope;
    const bool is_good = x + step > lower && x + step < upper && std::abs(step) <= 0.5 * last;
    if (!is_good) step = 0.5 * (lower + upper) - x;
    last = std::abs(step);
    x += step;
    if (last <= resolution) return x;
  }
  return x;
}

// The law continued oddly: t may turn the stress round beside a free end.
Rate odd(const RateLaw& law, double stress, double pressure) {
  const Rate rate = law(std::abs(stress), pressure);
  return {std::copysign(rate.value, stress), rate.slope};
}

struct Points {
  std::array<double, 3> stress, pressure;
};

// Shear rates at the Gauss points of an element.
std::array<double, 3> rates_in(const Points& at, const RateLaw& law) {
  const auto rate = [&](std::size_t q, double t) {
    return odd(law, at.stress[q] + t * shape[q], at.pressure[q]);
  };
  const auto bend = [&](double t) -> Rate {
    const Rate first = rate(0, t), middle = rate(1, t), last = rate(2, t);
    return {first.value - 2 * middle.value + last.value,
            shape[0] * first.slope - 2 * shape[1] * middle.slope + shape[2] * last.slope};
  };
  double most = 0;  // where a stress is beyond what any law carries
  for (std::size_t q = 0; q < 3; ++q) most += 10 * (at.pressure[q] + std::abs(at.stress[q]));
  const double t = root_of(bend, 0, -most, most, 0.01 * round_off * most);
  return {rate(0, t).value, rate(1, t).value, rate(2, t).value};
}

}  // namespace

RateLaw rate_of(const rheology::FrictionLaw& law) {
  return [law](double stress, double pressure) -> Rate {
    const double rate = law.shear_rate(stress, pressure);
    return {rate, rate > 0 ? 1 / law.stress_slope(rate, pressure) : 0};
  };
}

RateLaw rate_of(const rheology::Rheology& rheology) {
  return [rheology](double stress, double pressure) -> Rate {
    if (stress == 0) return {0, 1 / rheology.evaluate(0, pressure).eta};
    constexpr double least = 1e-40, most = 1e20;
    const auto excess = [&](double log_rate) -> Rate {
      const double rate = std::exp(log_rate);
      const rheology::Viscosity v = rheology.evaluate(rate, pressure);
      return {std::log(v.eta * rate / stress), 1 + rate * v.d_eta_d_shear_rate / v.eta};
    };
    if (excess(std::log(most)).value < 0) return {std::numeric_limits<double>::infinity(), 0};
    const double rate = std::exp(
        root_of(excess, std::log(rheology.lambda_r), std::log(least), std::log(most), round_off));
    const rheology::Viscosity v = rheology.evaluate(rate, pressure);
    return {rate, 1 / (v.eta + rate * v.d_eta_d_shear_rate)};
  };
}

Eigen::VectorXd line_answer(const oned::ShearScene& scene, const shear::CrossSection<1>& space,
                            const RateLaw& law) {
  const auto& mesh = space.mesh();
  const auto place = [&](Eigen::Index node) {
    return mesh.nodes[static_cast<std::size_t>(node)][0];
  };
  Eigen::VectorXd velocity(static_cast<Eigen::Index>(mesh.nodes.size()));
  long double beside = 0;  // velocity at the end of the last element, from the wall on
  const std::size_t count = mesh.elements.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& nodes = mesh.elements[scene.wall_at_start ? i : count - 1 - i];
    const double start = place(nodes[0]), length = place(nodes[2]) - start;
    Points at;
    for (std::size_t q = 0; q < 3; ++q) {
      const double x = start + 0.5 * length * (1 + gauss_point * (static_cast<double>(q) - 1));
      at.stress[q] = scene.exact_stress(x);
      at.pressure[q] = scene.pressure(x);
    }
    const auto rates = rates_in(at, law);
    // The shear rate is rates[1] + slope ξ; half an element adds its integral.
    const double slope = (rates[2] - rates[0]) / (2 * gauss_point);
    const double towards_wall = scene.wall_at_start ? -0.5 : 0.5;
    const Eigen::Index near = scene.wall_at_start ? nodes[0] : nodes[2];
    const Eigen::Index far = scene.wall_at_start ? nodes[2] : nodes[0];
    velocity[near] = static_cast<double>(beside);
    velocity[nodes[1]] =
        static_cast<double>(beside + 0.5L * length * (rates[1] + towards_wall * slope));
    beside += static_cast<long double>(length) * rates[1];
    velocity[far] = static_cast<double>(beside);
  }
  return velocity;
}

}  // namespace talus::verification
