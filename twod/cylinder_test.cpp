// The flow past the cylinder against reference numbers, balances and itself.
#include <algorithm>
#include <numbers>

#include "common/mixed/mixed_jacobian.hpp"
#include "common/mixed/mixed_test_problems.hpp"
#include "twod/cylinder_report.hpp"
#include "twod/cylinder_test_problems.hpp"

BOOST_AUTO_TEST_SUITE(cylinder_test)

using namespace talus;
using namespace talus::twod;
using State = CylinderFlow::State;
using solve::PathEnd;

namespace {

// L2 norms of the dynamic pressure and of grad u.
std::pair<double, double> norms(const CylinderFlow& cylinder, const State& state) {
  double pressure = 0, gradient = 0;
  const auto& space = cylinder.space();
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<2>(3)) {
      const double weight =
          point.weight * fem::ElementPoint<2>(space.mesh(), e, point.position).determinant;
      const auto values = space.values_at(state, e, point.position);
      pressure += weight * std::pow(values.pressure, 2);
      gradient += weight * values.velocity_gradient.squaredNorm();
    }
  return {std::sqrt(pressure), std::sqrt(gradient)};
}

}  // namespace

// The references have 160 elements around; the error is of first order in the first layer, here
// the same D/50, and hardly depends on the elements around.
BOOST_AUTO_TEST_CASE(creep_has_the_drag_and_velocity_of_the_references) {
  struct Reference {
    double loading, drag, mean_velocity;
  };
  Cylinder fine = cylinder_of(32);
  fine.mesh.first_layer = 0.02;
  for (const auto& [loading, drag, velocity] :
       {Reference{0.01, 1.64313, 4.97e-7}, {0.04, 4.61716, 3.22e-6}}) {
    const CylinderMeasures m = creep_at(fine, loading);
    BOOST_TEST_MESSAGE("F = " << loading << ": drag " << m.drag << ", U " << m.mean_velocity
                              << ", imbalance " << m.imbalance() << ", projected divergence "
                              << m.projected_divergence);
    BOOST_TEST(relative(m.drag, drag) < 0.01);
    BOOST_TEST(relative(m.mean_velocity, velocity) < 0.01);
    BOOST_TEST(std::abs(m.imbalance()) < 1e-10);
    BOOST_TEST(m.projected_divergence < 1e-13);
    BOOST_TEST(m.divergence > 1e-6);  // what the pressures do not see is no round-off
    BOOST_TEST(relative(m.weight, loading * (600 - std::numbers::pi / 4)) < 1e-6);
  }
  BOOST_TEST(relative(creep_at(cylinder_of(16), 0.04).drag, 4.61716) >
             0.01);  // a coarse mesh is seen
}

BOOST_AUTO_TEST_CASE(creep_is_proportional_to_lambda_r_and_flow_is_not) {
  const CylinderMeasures one = creep_at(cylinder_of(24), 0.01),
                         half = creep_at(cylinder_of(24, 5e-7), 0.01);
  BOOST_TEST(relative(one.mean_velocity, 2 * half.mean_velocity) < 1e-5);
  BOOST_TEST(relative(one.drag, half.drag) < 1e-5);
  CylinderFlow flowing(cylinder_of(16, 2e-3));
  const CylinderPath path = solve_from_rest(flowing, 0.054);
  BOOST_REQUIRE((path.end == PathEnd::target_reached));
  State state = path.next.state;
  const double velocity = measure(flowing, state).mean_velocity;
  solve_at(flowing, 0.054, 1e-3, state);
  BOOST_TEST(relative(velocity, measure(flowing, state).mean_velocity) < 0.1);
}

BOOST_AUTO_TEST_CASE(the_traction_approaches_the_reactions_at_first_order) {
  const auto gap = [](int around) {
    const CylinderMeasures m = creep_at(cylinder_of(around), 0.01);
    return relative(m.drag_traction, m.drag);
  };
  const double coarse = gap(16), fine = gap(32);
  const double order = std::log2(coarse / fine);
  BOOST_TEST_MESSAGE("gaps " << coarse << ", " << fine);
  BOOST_TEST((0.8 < order && order < 1.2), "order " << order);
}

BOOST_AUTO_TEST_CASE(half_and_full_domain_agree) {
  Cylinder full = cylinder_of(16);
  full.mesh.full = true;
  const CylinderMeasures a = creep_at(cylinder_of(16), 0.03), b = creep_at(full, 0.03);
  BOOST_TEST(relative(a.drag, b.drag) < 1e-9);
  BOOST_TEST(relative(a.drag_traction, b.drag_traction) < 1e-9);
  BOOST_TEST(relative(a.wall_force, b.wall_force) < 1e-9);
  BOOST_TEST(relative(a.mean_velocity, b.mean_velocity) < 1e-9);
  BOOST_TEST(relative(a.weight, b.weight) < 1e-12);
}

// Eq. (8): the divergence of a plain penalty is -λp p, exactly: p is in the space of projections.
BOOST_AUTO_TEST_CASE(a_plain_penalty_leaves_the_divergence_it_should) {
  constexpr double loading = 0.03, lambda_r = 1e-2;
  Cylinder plain = cylinder_of(16, lambda_r);
  plain.penalty = {mixed::Penalty::plain, 1e-8};
  CylinderFlow cylinder(plain);
  const State state = creep(cylinder, loading);
  const CylinderMeasures m = measure(cylinder, state);
  const auto [pressure, gradient] = norms(cylinder, state);
  BOOST_TEST(relative(m.projected_divergence, 1e-8 * pressure / gradient) < 1e-3);
  const CylinderMeasures iterated = creep_at(cylinder_of(16, lambda_r), loading);
  BOOST_TEST(iterated.projected_divergence < 1e-13);
  BOOST_TEST_MESSAGE("drag changed by " << relative(m.drag, iterated.drag));
  BOOST_TEST(relative(m.drag, iterated.drag) < 1e-6);
}

BOOST_AUTO_TEST_CASE(an_outlet_whose_pressure_is_open_carries_the_column) {
  const auto velocity = [](mixed::Open open) {
    Cylinder outlet = cylinder_of(16, 0.1);
    outlet.mesh.outlet = 8;
    outlet.open_outlet = open;
    CylinderFlow cylinder(outlet);
    State state = cylinder.space().start();
    solve_at(cylinder, 0.045, 0.1, state, 1e-9);
    return measure(cylinder, state).mean_velocity;
  };
  const double developed = velocity(mixed::Open::no);
  BOOST_TEST_MESSAGE("U " << developed << ", viscous " << velocity(mixed::Open::viscous) << ", all "
                          << velocity(mixed::Open::all));
  BOOST_TEST(relative(velocity(mixed::Open::viscous), developed) < 0.05);
  BOOST_TEST(std::abs(velocity(mixed::Open::all)) < 1e-3 * developed);
}

BOOST_AUTO_TEST_CASE(the_tangent_at_a_viscous_outlet_is_the_derivative) {
  auto conditions = mixed::mixed_conditions<2>();
  const mixed::MixedSpace<2> all(mixed::awkward_mesh2(2, 2), conditions);
  conditions["right"] = mixed::open_boundary<2>(mixed::Open::viscous);
  const mixed::MixedSpace<2> viscous(mixed::awkward_mesh2(2, 2), conditions);
  for (const auto& law : rheology::regularisations()) {
    mixed::MixedFlow<2> problem(viscous, {{}, law, 1e-2}, mixed::test_load<2>(1));
    mixed::MixedFlow<2> other(all, {{}, law, 1e-2}, mixed::test_load<2>(1));
    const auto state = mixed::state_of(viscous, {"", 1, 1, 0.5, 1});
    auto jacobian = mixed::jacobian_problem(problem, state);
    BOOST_TEST(solve::check_jacobian(jacobian, 0.1).passed(), rheology::name_of(law));
    jacobian.product = mixed::jacobian_problem(other, state).product;
    BOOST_TEST(!solve::check_jacobian(jacobian, 0.1).passed(), rheology::name_of(law));
  }
}

// Without eq. (16) nothing presses where the pressure is negative: I has no bound there.
BOOST_AUTO_TEST_CASE(fields_are_finite_where_nothing_presses) {
  Cylinder bare = cylinder_of(16);
  bare.regularises_pressure = false;
  CylinderFlow cylinder(bare);
  Eigen::VectorXd sheared = 0.1 * Eigen::VectorXd::Random(cylinder.space().size());
  sheared.tail(sheared.size() - cylinder.space().velocity_count()).setConstant(-2);
  bool is_unbounded = false;
  for (const io::Field& field : grid(cylinder, State(sheared)).cell_fields)
    for (const double value : field.values) {
      BOOST_REQUIRE_MESSAGE(std::isfinite(value), field.name);
      is_unbounded = is_unbounded || value > 1e30;
    }
  BOOST_TEST(is_unbounded);
}

// Creep keeps factors over several steps; whoever solves next has the solver he chose.
BOOST_AUTO_TEST_CASE(creep_leaves_the_flow_as_it_was) {
  for (const auto solver : {mixed::LinearSolver::direct, mixed::LinearSolver::lagged}) {
    CylinderFlow cylinder(cylinder_of(16));
    cylinder.flow().set_linear_solver(solver);
    const rheology::Rheology before = cylinder.flow().rheology();
    creep(cylinder, 0.03);
    BOOST_CHECK(cylinder.flow().linear_solver() == solver);
    BOOST_TEST(cylinder.flow().rheology().lambda_r == before.lambda_r);
    BOOST_TEST(cylinder.flow().rheology().pressure_floor == before.pressure_floor);
  }
}

BOOST_AUTO_TEST_CASE(reports_keep_what_was_measured) {
  CylinderFlow cylinder(cylinder_of(16));
  const State state = creep(cylinder, 0.03);
  const nlohmann::json json = as_json(measure(cylinder, state));
  BOOST_TEST((as_json(measures_from(nlohmann::json::parse(json.dump()))) == json));
  nlohmann::json incomplete = json;
  incomplete.erase("drag");
  BOOST_CHECK_THROW(measures_from(incomplete), nlohmann::json::exception);
  // Froude number and drag coefficient in the units of the paper: g = p_ext = D = 1 first.
  const CylinderMeasures m{.mean_velocity = 0.2, .drag = 6};
  BOOST_TEST(m.drag_coefficient() == 300, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(m.froude(4) == 0.4, boost::test_tools::tolerance(1e-14));

  const io::Table table = perimeter_table(cylinder, state);
  std::vector<double> angles;
  for (const auto& row : table.rows) angles.push_back(std::stod(row[0]));
  BOOST_TEST(angles.size() == 3U * 8);
  BOOST_TEST(std::ranges::is_sorted(angles, std::less_equal{}));
  BOOST_TEST((0 < angles.front() && angles.front() < 3 && 177 < angles.back()));
  BOOST_TEST(angles.back() < 180);
}

BOOST_AUTO_TEST_SUITE_END()
