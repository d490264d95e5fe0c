#include "twod/section.hpp"

#include <algorithm>
#include <cmath>

#include "common/fem/line_mesh.hpp"
#include "oned/depth.hpp"

namespace talus::twod {
namespace {

// Distinct first coordinates of the nodes, ascending: nodes are stored row by row.
std::size_t nodes_in_row(const shear::CrossSection<2>& space) {
  const auto& nodes = space.mesh().nodes;
  const auto next = std::find_if(nodes.begin() + 1, nodes.end(),
                                 [&](const auto& node) { return node[1] != nodes[0][1]; });
  return static_cast<std::size_t>(next - nodes.begin());
}

// Depths, by columns of quadrature points, where |τ| first falls to μs p below the surface.
struct YieldDepths {
  std::vector<double> y, depth;

  YieldDepths(const SectionSolution& solution, const shear::CrossSection<2>& space,
              std::size_t elements_across) {
    const auto load = load_of(solution.section);
    const std::size_t elements = space.element_count();
    const auto per_direction =
        static_cast<std::size_t>(std::lround(std::sqrt(space.points_per_element())));
    for (std::size_t column = 0; column < elements_across * per_direction; ++column) {
      std::vector<double> below{0}, excess{0};  // the surface, and the points down from it
      for (std::size_t row = elements / elements_across * per_direction; row-- > 0;) {
        const std::size_t e = row / per_direction * elements_across + column / per_direction;
        const std::size_t k = *space.points_of(e).begin() + column % per_direction +
                              row % per_direction * per_direction;
        const auto& x = space.points()[k].position;
        below.push_back(solution.section.height - x[1]);
        excess.push_back(solution.stress[k] / (load.law.mu_s * load.pressure(x)) - 1);
      }
      excess.front() = std::max(excess[1], 0.);  // where nothing is carried
      y.push_back(
          space.points()[*space.points_of(column / per_direction).begin() + column % per_direction]
              .position[0]);
      depth.push_back(oned::depth_of_fall(below, excess, 0, solution.section.height));
    }
  }

  // Linear between the columns, constant beyond the outer ones.
  double at(double position) const {
    const auto after = std::upper_bound(y.begin(), y.end(), position);
    if (after == y.begin()) return depth.front();
    if (after == y.end()) return depth.back();
    const auto i = static_cast<std::size_t>(after - y.begin());
    return std::lerp(depth[i - 1], depth[i], (position - y[i - 1]) / (y[i] - y[i - 1]));
  }
};

}  // namespace

shear::ShearOptions default_options() {
  shear::ShearOptions options;
  options.method = shear::Method::interior_point;
  options.interior_point.tolerance = 1e-8;
  options.interior_point.path = shear::CentralPath::uniform;
  options.lambda_r = 1e-5;
  options.tangent_term = shear::TangentTerm::primal_dual;
  options.continuation = shear::Continuation::always;
  options.path.step = 3;
  options.path.tolerance_on_the_way = 1e-2;
  return options;
}

shear::ShearOptions newton_options(double lambda_r) {
  shear::ShearOptions options = default_options();
  options.method = shear::Method::newton;
  options.lambda_r = lambda_r;
  return options;
}

SectionLines lines_of(const Section& section, const SectionMesh& mesh) {
  return {fem::graded_line(0, section.width / 2, mesh.across, mesh.grading_to_wall),
          fem::graded_line(0, section.height, mesh.up, mesh.grading_to_surface)};
}

shear::CrossSection<2> space_of(const Section& section, const SectionMesh& mesh) {
  const auto [y, z] = lines_of(section, mesh);
  const double half = section.width / 2;
  const bool slips = section.wall == Wall::friction;
  return shear::CrossSection<2>(
      fem::rectangle_mesh(
          y, z, [=](const Eigen::Vector2d& x) { return x[1] == 0 || (x[0] == half && !slips); }),
      slips ? "right" : "");
}

shear::ShearLoad<2> load_of(const Section& section) {
  return {
      section.law,
      [=](const Eigen::Vector2d& x) { return (section.height - x[1]) * std::cos(section.angle); },
      [=](const Eigen::Vector2d&) { return std::sin(section.angle); }};
}

SectionSolution solve(const Section& section, shear::CrossSection<2>& space,
                      const shear::ShearOptions& options, const shear::ShearStart<2>* start) {
  return {shear::solve_shear(space, load_of(section), options, start), section};
}

double flow_rate(const SectionSolution& solution, const shear::CrossSection<2>& space) {
  const auto& mesh = space.mesh();
  double integral = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const std::size_t k : space.points_of(e) | std::views::take(space.points_per_element()))
      for (std::size_t a = 0; a < mesh.elements[e].size(); ++a)
        integral += space.points()[k].weight *
                    space.points()[k].values[static_cast<Eigen::Index>(a)] *
                    solution.velocity.value()[mesh.elements[e][a]];
  return 2 * integral / solution.section.width;
}

SurfaceProfile surface_profile(const SectionSolution& solution,
                               const shear::CrossSection<2>& space) {
  const auto& nodes = space.mesh().nodes;
  const std::size_t columns = nodes_in_row(space), rows = nodes.size() / columns;
  const YieldDepths yield(solution, space, (columns - 1) / 2);
  SurfaceProfile profile;
  for (std::size_t column = 0; column < columns; ++column) {
    std::vector<double> below, velocity;  // down from the surface
    for (std::size_t row = rows; row-- > 0;) {
      below.push_back(solution.section.height - nodes[column + row * columns][1]);
      velocity.push_back(
          solution.velocity.value()[static_cast<Eigen::Index>(column + row * columns)]);
    }
    const double at_surface = velocity.front();
    const auto depth_below = [&](double threshold) {
      return oned::depth_of_fall(below, velocity, threshold, solution.section.height);
    };
    profile.y.push_back(nodes[column][0]);
    profile.velocity.push_back(at_surface);
    profile.depth_1.push_back(depth_below(0.01 * at_surface));
    profile.depth_5.push_back(depth_below(0.05 * at_surface));
    profile.depth_yield.push_back(yield.at(nodes[column][0]));
  }
  return profile;
}

double yielded_share(const SectionSolution& solution, const shear::CrossSection<2>& space) {
  const auto load = load_of(solution.section);
  double yielded = 0, all = 0;
  for (std::size_t k = 0; k < space.points().size(); ++k) {
    const auto& point = space.points()[k];
    if (point.on_wall) continue;
    all += point.weight;
    if (solution.stress[k] > load.law.mu_s * load.pressure(point.position)) yielded += point.weight;
  }
  return yielded / all;
}

rheology::Regime regime(const Section& section) {
  return rheology::regime_under(section.law, std::tan(section.angle));
}

}  // namespace talus::twod
