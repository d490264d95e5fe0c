#include "oned/heap_line.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "common/io/table.hpp"
#include "oned/depth.hpp"

namespace talus::oned {
namespace {

// ∫ f over [from, to], to 1e-12 of what it can be told to.
double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr unsigned halvings = 12;
  if (!(from < to)) return 0;
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, halvings,
                                                                       1e-12);
}

// What follows from the balance of forces alone, by depth h = H - z.
struct Balance {
  HeapLine heap;
  rheology::Rheology limit;
  double cosine, tangent;

  explicit Balance(const HeapLine& of)
      : heap(of),
        limit(of.law, of.regularisation),
        cosine(std::cos(of.angle)),
        tangent(std::tan(of.angle)) {}

  double depth_at(double ratio) const {  // where τ/p has fallen to `ratio`
    return (tangent - ratio) * heap.width / heap.wall_friction;
  }
  double stress_ratio(double h) const {
    return std::max(0., tangent - heap.wall_friction * h / heap.width);
  }
  double shear_rate(double h) const {
    const double p = h * cosine;
    return p > 0 ? limit.limit_inertial_number(stress_ratio(h)) *
                       limit.law.reference_shear_rate(p) / limit.law.I0
                 : 0;
  }
  // ∫ g γ dh over [from, to]: by √h, in which it is smooth, in pieces between its kinks.
  double sheared(const std::function<double(double)>& g, double from, double to) const {
    const auto rate = [&](double s) { return 2 * s * g(s * s) * shear_rate(s * s); };
    double sum = 0, start = from;
    std::vector<double> ends{depth_at(limit.limit_kink()), depth_at(0), to};
    std::ranges::sort(ends);
    for (const double end : ends) {
      const double stop = std::clamp(end, start, to);
      sum += integral(rate, std::sqrt(start), std::sqrt(stop));
      start = stop;
    }
    return sum;
  }
};

}  // namespace

ShearScene scene_of(const HeapLine& heap) {
  const Balance balance(heap);
  const double H = heap.height, sine = std::sin(heap.angle), carried = balance.depth_at(0);
  ShearScene scene;
  scene.name = "heap";
  scene.title = "heap, averaged over its width";
  scene.coordinate = "z";
  scene.velocity = "u";
  scene.length = H;
  scene.wall_at_start = true;
  scene.limit = balance.limit;
  scene.pressure = [=](double z) { return (H - z) * balance.cosine; };
  scene.body_force = [=](double z) {
    const double h = H - z;
    return h < carried ? sine - 2 * heap.wall_friction * h * balance.cosine / heap.width : 0;
  };
  scene.stress_ratio = balance.tangent;
  scene.limits = rest_limit(balance.limit, "angle <= ", std::atan(heap.law.mu_s)) +
                 "no steady flow for angle >= " + io::rounded(std::atan(heap.law.mu_2()), 6);
  const double kink = H - balance.depth_at(balance.limit.limit_kink());
  if (0 < kink && kink < H) scene.kink = kink;
  scene.exact_shear_rate = [=](double z) { return balance.shear_rate(H - z); };
  scene.exact_velocity = [=](double z) {
    return balance.sheared([](double) { return 1.; }, H - z, H);
  };
  scene.exact_stress = [=](double z) {
    return balance.stress_ratio(H - z) * (H - z) * balance.cosine;
  };
  scene.load = {"α", 0.34, 0.41, 0.6, [heap](double angle) {
                  HeapLine other = heap;
                  other.angle = angle;
                  return scene_of(other);
                }};
  scene.under = [heap](const rheology::Regularisation& regularisation) {
    HeapLine other = heap;
    other.regularisation = regularisation;
    return scene_of(other);
  };
  return scene;
}

double exact_flow_rate(const HeapLine& heap) {
  // ∫ u dz = ∫ h γ dh: by parts, with no slip at the bottom.
  return Balance(heap).sheared([](double h) { return h; }, 0, heap.height);
}

LayerMeasures measures(const Solution& solution, const ShearScene& scene) {
  const auto& space = solution.space;
  const auto& nodes = space.mesh().nodes;
  const Eigen::VectorXd velocity = solution.velocity.value();
  LayerMeasures all;
  std::vector<double> depth, values;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    depth.push_back(scene.length - nodes[i][0]);
    values.push_back(velocity[static_cast<Eigen::Index>(i)]);
  }
  all.surface_velocity = values.front();
  all.depth_1 = depth_of_fall(depth, values, 0.01 * all.surface_velocity, scene.length);
  all.depth_5 = depth_of_fall(depth, values, 0.05 * all.surface_velocity, scene.length);

  std::vector<double> at{0}, excess{0};  // of the stress over yield, relative
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const std::size_t k : space.points_of(e)) {
      const auto& point = space.points()[k];
      const double yield = scene.law().mu_s * scene.pressure(point.position[0]);
      for (std::size_t a = 0; a < space.mesh().elements[e].size(); ++a)
        all.flow_rate += point.weight * point.values[static_cast<Eigen::Index>(a)] *
                         velocity[space.mesh().elements[e][a]];
      if (solution.stress[k] > yield) all.yielded_share += point.weight / scene.length;
    }
  for (std::size_t k = space.points().size(); k-- > 0;) {
    const double z = space.points()[k].position[0];
    at.push_back(scene.length - z);
    excess.push_back(solution.stress[k] / (scene.law().mu_s * scene.pressure(z)) - 1);
  }
  excess.front() = std::max(excess[1], 0.);  // the surface itself carries nothing
  all.depth_yield = depth_of_fall(at, excess, 0, scene.length);
  return all;
}

}  // namespace talus::oned
