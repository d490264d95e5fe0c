#include "twod/section.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include "common/fem/line_mesh.hpp"

namespace talus::twod {
namespace {

// Distinct first coordinates of the nodes, ascending: nodes are stored row by row.
std::size_t nodes_in_row(const flow::CrossSection<2>& space) {
  const auto& nodes = space.mesh().nodes;
  const auto next = std::find_if(nodes.begin() + 1, nodes.end(),
                                 [&](const auto& node) { return node[1] != nodes[0][1]; });
  return static_cast<std::size_t>(next - nodes.begin());
}

}  // namespace

flow::ShearOptions default_options() {
  flow::ShearOptions options;
  options.method = flow::Method::interior_point;
  options.interior_point.tolerance = 1e-8;
  options.interior_point.path = flow::CentralPath::uniform;
  options.lambda_r = 1e-5;
  return options;
}

flow::CrossSection<2> space_of(const Section& section, const SectionMesh& mesh) {
  const double half = section.width / 2;
  const auto y = fem::graded_line(0, half, mesh.across, mesh.grading_to_wall);
  const auto z = fem::graded_line(0, section.height, mesh.up, mesh.grading_to_surface);
  return flow::CrossSection<2>(flow::rectangle_mesh(
      y, z, [=](const Eigen::Vector2d& x) { return x[0] == half || x[1] == 0; }));
}

flow::ShearLoad<2> load_of(const Section& section) {
  return {
      section.law,
      [=](const Eigen::Vector2d& x) { return (section.height - x[1]) * std::cos(section.angle); },
      [=](const Eigen::Vector2d&) { return std::sin(section.angle); }};
}

SectionSolution solve(const Section& section, flow::CrossSection<2>& space,
                      const flow::ShearOptions& options, const SectionSolution* start) {
  return {flow::solve_shear(space, load_of(section), options, start ? &start->velocity : nullptr),
          section};
}

double flow_rate(const SectionSolution& solution, const flow::CrossSection<2>& space) {
  const auto& mesh = space.mesh();
  double integral = 0;
  for (std::size_t e = 0, k = 0; e < mesh.elements.size(); ++e)
    for (std::size_t q = 0; q < space.points_per_element(); ++q, ++k)
      for (std::size_t a = 0; a < mesh.elements[e].size(); ++a)
        integral += space.points()[k].weight *
                    space.points()[k].values[static_cast<Eigen::Index>(a)] *
                    solution.velocity.value()[mesh.elements[e][a]];
  return 2 * integral / solution.section.width;
}

SectionSolution solve_for_flow_rate(double target, Section section, flow::CrossSection<2>& space,
                                    const flow::ShearOptions& options) {
  constexpr double angle_tolerance = 1e-10;
  constexpr int most_angles = 60;
  SectionSolution last;
  // log Q* is nearly linear in the angle; rest counts as a rate far below every other.
  const auto excess = [&](double angle) {
    constexpr double rate_of_rest = 1e-12;
    section.angle = angle;
    // A plug does not form again from a faster flow: where the last solution leads nowhere, rest
    // does.
    const SectionSolution before = std::move(last);
    if (!before.shear_rate.empty()) last = solve(section, space, options, &before);
    if (before.shear_rate.empty() || !solve::is_success(last.end))
      last = solve(section, space, options);
    if (!solve::is_success(last.end))
      throw std::runtime_error(solve::name_of(last.end) + " at an angle of " +
                               std::to_string(angle) + ": " + solve::advice_for(last.end));
    return std::log(std::max(flow_rate(last, space), rate_of_rest) / target);
  };
  struct Callback {
    const decltype(excess)* function;
    std::exception_ptr error;
  } callback{&excess, nullptr};
  gsl_function f{[](double angle, void* data) {
                   auto* self = static_cast<Callback*>(data);
                   try {
                     return (*self->function)(angle);
                   } catch (...) {  // must not cross GSL's frames
                     self->error = std::current_exception();
                     return std::nan("");
                   }
                 },
                 &callback};
  // Flow starts above arctan μs, later than that because of the side walls.
  double lower = std::atan(section.law.mu_s), upper = lower + 0.02;
  while (excess(upper) < 0) {
    lower = upper;
    upper += 0.02;
    if (upper > std::atan(section.law.mu_2()))
      throw std::runtime_error("no angle below arctan mu_2 reaches this flow rate");
  }
  gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  gsl_root_fsolver* solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  int status = gsl_root_fsolver_set(solver, &f, lower, upper);
  for (int i = 0; i < most_angles && status == GSL_SUCCESS; ++i) {
    status = gsl_root_fsolver_iterate(solver);
    lower = gsl_root_fsolver_x_lower(solver);
    upper = gsl_root_fsolver_x_upper(solver);
    if (gsl_root_test_interval(lower, upper, angle_tolerance, 0) == GSL_SUCCESS) break;
  }
  const double angle = gsl_root_fsolver_root(solver);
  gsl_root_fsolver_free(solver);
  gsl_set_error_handler(previous);
  if (callback.error) std::rethrow_exception(callback.error);
  if (last.section.angle != angle) excess(angle);
  return last;
}

SurfaceProfile surface_profile(const SectionSolution& solution,
                               const flow::CrossSection<2>& space) {
  const auto& nodes = space.mesh().nodes;
  const std::size_t columns = nodes_in_row(space), rows = nodes.size() / columns;
  SurfaceProfile profile;
  for (std::size_t column = 0; column < columns; ++column) {
    const auto velocity_at = [&](std::size_t row) {
      return solution.velocity.value()[static_cast<Eigen::Index>(column + row * columns)];
    };
    const auto depth_at = [&](std::size_t row) {
      return solution.section.height - nodes[column + row * columns][1];
    };
    const double at_surface = velocity_at(rows - 1);
    const auto depth_below = [&](double threshold) {
      if (at_surface <= 0) return 0.0;
      for (std::size_t row = rows - 1; row-- > 0;) {
        const double below = velocity_at(row), above = velocity_at(row + 1);
        if (below >= threshold) continue;
        const double share = above > below ? (above - threshold) / (above - below) : 0;
        return depth_at(row + 1) + share * (depth_at(row) - depth_at(row + 1));
      }
      return solution.section.height;
    };
    profile.y.push_back(nodes[column][0]);
    profile.velocity.push_back(at_surface);
    profile.depth_1.push_back(depth_below(0.01 * at_surface));
    profile.depth_5.push_back(depth_below(0.05 * at_surface));
  }
  return profile;
}

double yielded_share(const SectionSolution& solution, const flow::CrossSection<2>& space) {
  const auto load = load_of(solution.section);
  double yielded = 0, all = 0;
  for (std::size_t k = 0; k < space.points().size(); ++k) {
    const auto& point = space.points()[k];
    all += point.weight;
    if (solution.stress[k] > load.law.mu_s * load.pressure(point.position)) yielded += point.weight;
  }
  return yielded / all;
}

rheology::Regime regime(const Section& section) {
  return rheology::regime_under(section.law, std::tan(section.angle));
}

}  // namespace talus::twod
