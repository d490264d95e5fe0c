#include "twod/split_bottom.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/fem/line_mesh.hpp"

namespace talus::twod {
namespace {

// Boundaries that narrow towards `start`.
std::vector<double> narrow_at_start(double start, double end, int elements, double grading) {
  std::vector<double> line = fem::graded_line(start, end, elements, grading);
  for (double& x : line) x = start + end - x;
  std::ranges::reverse(line);
  return line;
}

int in_proportion(int elements, double length) {
  return std::max(1, static_cast<int>(std::lround(elements * length)));
}

// Where ω first takes a share of Ω, coming from the wall inwards along a row of nodes, three an
// element; quadratic between them.
double radius_of(const std::vector<double>& r, const std::vector<double>& omega, double share) {
  for (std::size_t end = r.size() - 1; end >= 2; end -= 2) {
    const auto at = [&](double s) {  // s from 0 at the inner end of the element to 1
      return omega[end - 2] * (1 - s) * (1 - 2 * s) + omega[end - 1] * 4 * s * (1 - s) +
             omega[end] * s * (2 * s - 1);
    };
    if (at(0) > share || at(1) < share) continue;
    double low = 0, high = 1;
    for (int halvings = 0; halvings < 50; ++halvings) {
      const double middle = 0.5 * (low + high);
      (at(middle) < share ? low : high) = middle;
    }
    return std::lerp(r[end - 2], r[end], high);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

shear::ShearOptions default_options(const SplitBottom& cell) {
  shear::ShearOptions options;
  options.method = shear::Method::interior_point;
  options.interior_point.tolerance = 1e-8;
  options.interior_point.path = shear::CentralPath::uniform;
  options.lambda_r = 1e-5 * cell.rate;
  options.tangent_term = shear::TangentTerm::primal_dual;
  options.continuation = shear::Continuation::always;
  options.path.first = cell.rate;
  options.path.tolerance_on_the_way = 1e-2;
  return options;
}

shear::CrossSection<2> space_of(const SplitBottom& cell, const SplitBottomMesh& mesh) {
  const int n = mesh.elements;
  std::vector<double> r = fem::graded_line(0, 1, n, mesh.grading);
  const std::vector<double> ring =
      narrow_at_start(1, cell.outer_radius, in_proportion(n, cell.outer_radius - 1), mesh.grading);
  r.insert(r.end(), ring.begin() + 1, ring.end());
  const std::vector<double> z =
      narrow_at_start(0, cell.height, in_proportion(n, cell.height), mesh.grading);
  return shear::CrossSection<2>(
      fem::rectangle_mesh(
          r, z, [=](const Eigen::Vector2d& x) { return x[1] == 0 || x[0] == cell.outer_radius; }),
      "", 3, shear::Symmetry::rotation);
}

shear::ShearLoad<2> load_of(const SplitBottom& cell) {
  using Position = shear::ShearLoad<2>::Position;
  return {cell.law, [=](const Position& x) { return cell.height - x[1]; },
          [](const Position&) { return 0.; },
          [=](const Position& x) {  // at the split itself half of the jump
            return x[0] < 1 ? 0 : x[0] == 1 ? cell.rate / 2 : cell.rate;
          }};
}

SplitBottomSolution solve(const SplitBottom& cell, shear::CrossSection<2>& space,
                          const shear::ShearOptions& options) {
  return {shear::solve_shear(space, load_of(cell), options), cell};
}

Zone zone_of(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  const auto& nodes = space.mesh().nodes;
  const Eigen::VectorXd omega = solution.velocity.value() / solution.cell.rate;
  const double sixth = 0.5 * std::erfc(std::sqrt(0.5)), root_of_two = std::sqrt(2.);
  Zone zone;
  for (std::size_t row = 0; row < nodes.size();) {
    std::vector<double> r, along;
    const double z = nodes[row][1];
    for (; row < nodes.size() && nodes[row][1] == z; ++row) {
      r.push_back(nodes[row][0]);
      along.push_back(omega[static_cast<Eigen::Index>(row)]);
    }
    zone.height.push_back(z);
    zone.centre.push_back(radius_of(r, along, 0.5));
    zone.width.push_back((radius_of(r, along, 1 - sixth) - radius_of(r, along, sixth)) /
                         root_of_two);
  }
  return zone;
}

double torque_integral(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  double power = 0;
  for (std::size_t k = 0; k < space.points().size(); ++k)
    power += space.points()[k].weight * solution.stress[k] * solution.shear_rate[k];
  return power / (solution.cell.law.mu_s * solution.cell.rate);
}

double energy(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  const auto pressure = load_of(solution.cell).pressure;
  double sum = 0;
  for (std::size_t k = 0; k < space.points().size(); ++k)
    sum +=
        space.points()[k].weight *
        solution.cell.law.dissipation(solution.shear_rate[k], pressure(space.points()[k].position));
  return sum / (solution.cell.law.mu_s * solution.cell.rate);
}

}  // namespace talus::twod
