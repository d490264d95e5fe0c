// Taylor tests of the tangent of velocity-pressure flow, in the plane and in space: a part of the
// Jacobian study.
#include <cmath>
#include <limits>

#include "common/fem/line_mesh.hpp"
#include "common/fem/mesh_tools.hpp"
#include "common/mixed/manufactured.hpp"
#include "common/mixed/mixed_jacobian.hpp"
#include "common/solve/extremes.hpp"
#include "verification/harness/methods.hpp"
#include "verification/jacobian/jacobian_parts.hpp"

namespace talus::verification {
namespace {

struct MixedState {
  std::string name;
  double shear_rate, translation, pressure;
};

std::vector<MixedState> mixed_states(double lambda_r) {
  return {{"rest", 0, 0, 1},
          {"plug", 1e-3 * lambda_r, 1, 1},
          {"yield", lambda_r, 0, 1},
          {"flow", 1, 0, 1},
          {"negative pressure", 1, 0, -1}};
}

// A manufactured flow scaled to this rate and moved along, the pressure about constant.
template <int Dim>
typename mixed::MixedSpace<Dim>::State state_at(const mixed::MixedSpace<Dim>& space,
                                                const MixedState& at) {
  const auto& flow = mixed::manufactured_flows<Dim>().front();
  auto state = space.start();
  for (Eigen::Index node = 0; node < space.velocity_count() / Dim; ++node)
    for (int i = 0; i < Dim; ++i)
      state.set(space.velocity_index(node, i),
                at.translation +
                    at.shear_rate *
                        flow.at(space.mesh().nodes[static_cast<std::size_t>(node)]).velocity[i]);
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    state.set(space.pressure_index(e, 0), at.pressure);
    state.set(space.pressure_index(e, 1), 0.1);
  }
  return state;
}

// Elements that are no parallelograms: four in the plane, two in space.
template <int Dim>
fem::Mesh<Dim> small_mesh() {
  const auto once = fem::graded_line(0, 1, 1, 1), twice = fem::graded_line(0, 1, 2, 1);
  if constexpr (Dim == 2) {
    return fem::distorted(fem::tensor_mesh<2>({twice, twice}), 0.2, 1);
  } else {
    auto mesh = fem::tensor_mesh<3>({once, once, twice});
    for (auto& x : mesh.nodes) x += 0.2 * fem::Point<3>(x[1] * x[2], x[2] * x[0], x[0] * x[1]);
    return mesh;
  }
}

// A wall, a symmetry, free sides and the open boundary of eq. (8).
template <int Dim>
mixed::MixedSpace<Dim> small_space() {
  mixed::BoundaryConditions<Dim> conditions = {{"left", mixed::no_slip<Dim>()},
                                               {"bottom", mixed::symmetry<Dim>(1)},
                                               {"top", {}},
                                               {"right", mixed::open_boundary<Dim>()}};
  if constexpr (Dim == 3) {
    conditions["back"] = mixed::fully_developed<3>(2);
    conditions["front"] = {};
  }
  return {small_mesh<Dim>(), conditions};
}

template <int Dim>
mixed::MixedLoad<Dim> downwards() {
  return {[](const auto&) { return 0.0; },
          [](const auto&) -> fem::Point<Dim> { return -fem::Point<Dim>::Unit(1); }};
}

// How many of the four blocks may be a percent too large without being caught; a plain penalty, so
// that none is empty.
template <int Dim>
int wrong_blocks_not_caught(const mixed::MixedSpace<Dim>& space,
                            const rheology::Regularisation& law, const MixedState& at,
                            double scale) {
  mixed::MixedFlow<Dim> problem(space, {{}, law, 1e-2}, downwards<Dim>(),
                                {mixed::Penalty::plain, 1e-2});
  auto jacobian = mixed::jacobian_problem(problem, state_at<Dim>(space, at));
  const auto right = jacobian.product;
  const auto only = [](const solve::Block& block, const Eigen::VectorXd& v) {
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(v.size());
    for (const Eigen::Index i : block.indices) kept[i] = v[i];
    return kept;
  };
  int not_caught = 0;
  for (const solve::Block& rows : jacobian.rows)
    for (const solve::Block& columns : jacobian.columns) {
      jacobian.product = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return right(v) + 0.01 * only(rows, right(only(columns, v)));
      };
      if (solve::check_blocks(jacobian, scale).verdict() != solve::Verdict::wrong) ++not_caught;
    }
  return not_caught;
}

template <int Dim>
void check_tangents(Chapter& chapter) {
  constexpr double scale = 0.1, lowest_slope = 1.8;
  const std::string name = "velocity-pressure flow in " + std::to_string(Dim) + "D: ";
  const auto space = small_space<Dim>();
  const auto checked = [&](const rheology::Regularisation& law, double lambda_r,
                           const MixedState& at) {
    mixed::MixedFlow<Dim> problem(space, {{}, law, lambda_r}, downwards<Dim>());
    return solve::check_jacobian(mixed::jacobian_problem(problem, state_at<Dim>(space, at)), scale);
  };
  // By its blocks alone.
  const auto is_caught = [&](const rheology::Regularisation& law,
                             const mixed::TangentFactors& factors) {
    mixed::MixedFlow<Dim> problem(space, {{}, law, 1e-2}, downwards<Dim>());
    problem.set_tangent_factors(factors);
    const auto jacobian = mixed::jacobian_problem(problem, state_at<Dim>(space, {"", 1, 1, 1}));
    return solve::check_blocks(jacobian, scale).verdict() == solve::Verdict::wrong;
  };
  io::Table table{
      "Velocity-pressure flow: smallest slope over all blocks (" +
          std::string(Dim == 2 ? "4 distorted Q9/P1" : "2 distorted H27/P1") +
          " elements, inertia, an open boundary), worst entry and system over the states",
      {"law", "λr"},
      {}};
  for (const MixedState& at : mixed_states(1)) table.header.push_back(at.name);
  table.header.insert(table.header.end(), {"worst entry", "system"});
  double smallest = std::numeric_limits<double>::infinity(), worst_entry = 0, worst_system = 0;
  int wrong = 0, not_caught = 0;
  for (const auto& law : rheology::regularisations())
    for (const double lambda_r : Dim == 2 ? std::vector{1e-2, 1e-6} : std::vector{1e-2}) {
      std::vector<std::string> row = {rheology::name_of(law), short_power(lambda_r)};
      double worst = 0, system = 0;
      for (const MixedState& at : mixed_states(lambda_r)) {
        const auto check = checked(law, lambda_r, at);
        row.push_back(
            (std::isinf(check.smallest_slope()) ? "linear" : io::fixed(check.smallest_slope(), 3)) +
            (check.passed() ? "" : " " + name_of(check.verdict())));
        smallest = solve::nan_min(smallest, check.smallest_slope());
        worst = solve::nan_max(worst, check.entries.worst);
        system = solve::nan_max(system, check.system.error);
        if (!check.passed()) ++wrong;
      }
      row.insert(row.end(), {io::rounded(worst, 2), io::rounded(system, 2)});
      table.rows.push_back(row);
      worst_entry = solve::nan_max(worst_entry, worst);
      worst_system = solve::nan_max(worst_system, system);
    }
  for (const auto& law : rheology::regularisations())
    for (const double factor : Dim == 2 ? std::vector{0.0, -1.0} : std::vector{0.0})
      for (const mixed::TangentFactors& factors :
           {mixed::TangentFactors{factor, 1, 1}, {1, factor, 1}, {1, 1, factor}})
        if (!is_caught(law, factors)) ++not_caught;
  const int blocks_not_caught =
      wrong_blocks_not_caught<Dim>(space, rheology::ChauchatMedale{}, {"", 1, 1, 1}, scale);
  chapter.check(Kind::other_method, name + "smallest slope over all laws and states", smallest,
                lowest_slope, 4);
  chapter.check(Kind::other_method,
                name + "largest error of an entry of the matrix that is factored", worst_entry, 0,
                1e-6);
  chapter.check(Kind::other_method, name + "product and condensed solve, off the matrix, unrefined",
                worst_system, 0, 1e-6);
  chapter.check(Kind::self_consistency, name + "laws and states that do not pass", wrong, 0, 0);
  chapter.check(Kind::control,
                name +
                    "broken tangents (η'(|γ|), η'(p) or the variation of "
                    "inertia dropped" +
                    (Dim == 2 ? std::string(", or with the wrong sign") : "") + ") not caught",
                not_caught, 0, 0);
  chapter.check(Kind::control, name + "blocks a percent too large not caught", blocks_not_caught, 0,
                0);
  chapter.table(std::move(table));
}

}  // namespace

// In space less of it.
void check_mixed_tangents(Chapter& chapter) {
  check_tangents<2>(chapter);
  check_tangents<3>(chapter);
}

}  // namespace talus::verification
