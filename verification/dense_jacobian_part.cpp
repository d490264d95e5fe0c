// Taylor tests of the tangent of velocity-pressure flow: the 2D part of the Jacobian study.
#include <cmath>
#include <limits>

#include "common/fem/line_mesh.hpp"
#include "common/flow/dense_jacobian.hpp"
#include "common/flow/manufactured.hpp"
#include "common/flow/mesh_tools.hpp"
#include "verification/dense_parts.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

using Space = flow::DenseSpace<2>;

struct DenseState {
  std::string name;
  double shear_rate, translation, pressure;
};

std::vector<DenseState> dense_states(double lambda_r) {
  return {{"rest", 0, 0, 1},
          {"plug", 1e-3 * lambda_r, 1, 1},
          {"yield", lambda_r, 0, 1},
          {"flow", 1, 0, 1},
          {"negative pressure", 1, 0, -1}};
}

// A manufactured flow scaled to this rate and moved along, the pressure about constant.
solve::CompensatedVector state_at(const Space& space, const DenseState& at) {
  const auto& flow = flow::manufactured_flows<2>().front();
  auto state = space.start();
  for (Eigen::Index node = 0; node < space.velocity_count() / 2; ++node)
    for (int i = 0; i < 2; ++i)
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

// Distorted elements, a wall, a symmetry, a free side and the open boundary of eq. (8).
Space small_space() {
  const auto line = fem::graded_line(0, 1, 2, 1);
  return {flow::distorted(flow::tensor_mesh<2>({line, line}), 0.2, 1),
          {{"left", flow::no_slip<2>()},
           {"bottom", flow::symmetry<2>(1)},
           {"top", {}},
           {"right", flow::open_boundary<2>()}}};
}

}  // namespace

void check_dense_tangents(Chapter& chapter) {
  constexpr double scale = 0.1, lowest_slope = 1.8;
  const Space space = small_space();
  const auto checked = [&](const rheology::Regularisation& law, double lambda_r,
                           const DenseState& at, const flow::TangentFactors& factors) {
    flow::DenseFlow<2> problem(
        space, {{}, law, lambda_r},
        {[](const auto&) { return 0.0; }, [](const auto&) { return flow::Point<2>(0, -1); }});
    problem.set_tangent_factors(factors);
    return solve::check_jacobian(flow::jacobian_problem(problem, state_at(space, at)), scale);
  };
  io::Table table{
      "Velocity-pressure flow: smallest slope over all blocks (4 distorted Q9/P1 "
      "elements, inertia, an open boundary), and worst entry over the states",
      {"law", "λr"},
      {}};
  for (const DenseState& at : dense_states(1)) table.header.push_back(at.name);
  table.header.push_back("worst entry");
  double smallest = std::numeric_limits<double>::infinity(), worst_entry = 0;
  int wrong = 0, not_caught = 0;
  for (const auto& law : rheology::regularisations())
    for (const double lambda_r : {1e-2, 1e-6}) {
      std::vector<std::string> row = {rheology::name_of(law), short_power(lambda_r)};
      double worst = 0;
      for (const DenseState& at : dense_states(lambda_r)) {
        const auto check = checked(law, lambda_r, at, {});
        row.push_back(io::fixed(check.smallest_slope(), 3) + (check.passed() ? "" : " WRONG"));
        smallest = std::fmin(smallest, check.smallest_slope());
        worst = std::max(worst, check.entries.worst);
        if (!check.passed()) ++wrong;
      }
      row.push_back(io::rounded(worst, 2));
      table.rows.push_back(row);
      worst_entry = std::max(worst_entry, worst);
    }
  for (const auto& law : rheology::regularisations())
    for (const double factor : {0.0, -1.0})
      for (const flow::TangentFactors& factors :
           {flow::TangentFactors{factor, 1, 1}, {1, factor, 1}, {1, 1, factor}})
        if (checked(law, 1e-2, {"", 1, 1, 1}, factors).passed()) ++not_caught;
  chapter.check("velocity-pressure flow: smallest slope over all laws and states", smallest,
                lowest_slope, 4);
  chapter.check("velocity-pressure flow: largest error of an entry", worst_entry, 0, 1e-5);
  chapter.check("velocity-pressure flow: wrong blocks or entries", wrong, 0, 0);
  chapter.check(
      "velocity-pressure flow: broken tangents (η'(|γ|), η'(p) or the variation of "
      "inertia dropped, or with the wrong sign) not caught",
      not_caught, 0, 0);
  chapter.table(std::move(table));
}

}  // namespace talus::verification
