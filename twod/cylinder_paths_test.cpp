// Ways to a solution of the cylinder: do they arrive, and where?
#include <algorithm>

#include "twod/cylinder_test_problems.hpp"

BOOST_AUTO_TEST_SUITE(cylinder_paths_test)

using namespace talus;
using namespace talus::twod;
using State = CylinderFlow::State;
using solve::PathEnd;

namespace {

int folds(const CylinderPath& path) {
  return static_cast<int>(std::ranges::count_if(
      path.points, [](const solve::PathPoint& point) { return point.is_fold_passed; }));
}

// Down in λr at the loading, the way that needs no creep.
CylinderMeasures along_lambda_r(const Cylinder& scene, double loading) {
  CylinderFlow cylinder(scene);
  CylinderPath path = solve_from_rest(cylinder, loading);
  BOOST_REQUIRE((path.end == PathEnd::target_reached));
  solve_at(cylinder, loading, scene.lambda_r, path.next.state);
  return measure(cylinder, path.next.state);
}

void check_same_flow(const CylinderMeasures& m, const CylinderMeasures& other) {
  BOOST_TEST(relative(m.mean_velocity, other.mean_velocity) < 1e-8);
  BOOST_TEST(relative(m.drag, other.drag) < 1e-8);
  BOOST_TEST(relative(m.wall_force, other.wall_force) < 1e-8);
}

template <class Path>
struct WithWrongDerivative : Path {
  using Path::Path;
  Eigen::VectorXd parameter_derivative() const { return 0.5 * Path::parameter_derivative(); }
};

template <class Path>
void check_predictor_order(CylinderFlow& cylinder, const State& state, double step) {
  Path path(cylinder.flow());
  WithWrongDerivative<Path> wrong(cylinder.flow());
  const double order = solve::predictor_order(path, state, step);
  const double wrong_order = solve::predictor_order(wrong, state, step);
  BOOST_TEST((1.9 < order && order < 2.1), "order " << order);
  BOOST_TEST((0.9 < wrong_order && wrong_order < 1.1), "wrong order " << wrong_order);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_well_posed_law_has_no_folds_on_the_way_to_flow) {
  Cylinder well_posed = cylinder_of(40);
  well_posed.regularisation = *rheology::regularisation_named("barker-gray");
  CylinderFlow cylinder(well_posed);
  solve::PathOptions options = cylinder_path_options();  // few steps in vain
  options.corrector.tolerance = 1e-6;
  options.few_corrections = 3;
  options.growth = 1.3;
  options.corrector.max_iterations = 6;
  const CylinderPath path = solve_from_rest(cylinder, 0.054, Continuation::arclength, options);
  BOOST_TEST((path.end == PathEnd::target_reached), solve::name_of(path.end));
  BOOST_TEST(folds(path) == 0);
  const CylinderMeasures m = measure(cylinder, path.next.state);
  BOOST_TEST_MESSAGE("U " << m.mean_velocity << ", drag " << m.drag << ", imbalance "
                          << m.imbalance());
  BOOST_TEST(std::abs(m.mean_velocity - 0.1618) < 1e-4);
  BOOST_TEST(std::abs(m.drag - 6.077) < 1e-3);
  BOOST_TEST(std::abs(m.imbalance()) < 1e-10);
  BOOST_TEST(std::abs(m.momentum_flux / m.weight) > 1e-8);  // and inertia counts
  BOOST_TEST((0 < m.yielded_share && m.yielded_share < 1));
}

BOOST_AUTO_TEST_CASE(where_rest_is_too_far_paths_set_out_along_the_loading) {
  Cylinder fast = cylinder_of(32);
  fast.regularisation = *rheology::regularisation_named("barker-gray");
  solve::PathOptions options = cylinder_path_options();
  options.max_points = 1;
  for (const auto& [way, lambda_r] :
       {std::pair(Continuation::primal_dual, 0.01), {Continuation::arclength, 0.03}}) {
    CylinderFlow cylinder(fast);  // from rest Newton fails at 0.01 and 0.1
    const CylinderPath path = solve_from_rest(cylinder, 0.059, way, options);
    BOOST_REQUIRE(path.points.size() == 1U);
    BOOST_TEST(std::abs(path.points[0].parameter - std::log10(lambda_r)) < 1e-12);
  }
}

// On this mesh the path turns back at the yield load and once more.
BOOST_AUTO_TEST_CASE(arclength_passes_the_yield_load_where_natural_continuation_stops) {
  CylinderFlow cylinder(cylinder_of(16));
  const solve::PathStart<State> start{.state = creep(cylinder, 0.045), .parameter = 0.045};
  solve::PathOptions options = cylinder_path_options();
  const CylinderPath arclength =
      follow_loading(cylinder, start, 0.051, Continuation::arclength, options);
  BOOST_TEST((arclength.end == PathEnd::target_reached), solve::name_of(arclength.end));
  BOOST_TEST(measure(cylinder, arclength.next.state).mean_velocity > 0.01);
  const auto turns = solve::fold_parameters(arclength.points);
  BOOST_REQUIRE(turns.size() == 2U);
  options.smallest_step = 1e-3;
  const CylinderPath natural =
      follow_loading(cylinder, start, 0.051, Continuation::natural, options);
  BOOST_TEST_MESSAGE("folds at " << turns[0] << ", " << turns[1] << ", natural stops at "
                                 << natural.next.parameter);
  BOOST_TEST((natural.end == PathEnd::step_too_small), solve::name_of(natural.end));
  BOOST_TEST(std::abs(natural.next.parameter - turns[0]) < 1e-5);
  // A step in vain is seen to be soon: of ten corrections it needs no more than seven or so.
  const solve::PathCost cost = natural.total_cost();
  int arriving = 0;
  for (const solve::PathPoint& point : natural.points) arriving += point.corrections;
  BOOST_TEST_MESSAGE(cost.failures << " steps in vain, " << cost.factorisations - arriving
                                   << " factorisations for them");
  BOOST_TEST(cost.factorisations - arriving <= 8 * cost.failures);
  BOOST_TEST(turns[1] < turns[0]);
}

BOOST_AUTO_TEST_CASE(the_paths_lead_where_newton_leads) {
  constexpr double lambda_r = 1e-4;
  const CylinderMeasures direct = creep_at(cylinder_of(16, lambda_r), 0.03);
  for (const auto continuation :
       {Continuation::arclength, Continuation::natural, Continuation::primal_dual}) {
    CylinderFlow cylinder(cylinder_of(16, lambda_r));
    CylinderPath path = solve_from_rest(cylinder, 0.03, continuation);
    BOOST_REQUIRE((path.end == PathEnd::target_reached));
    solve_at(cylinder, 0.03, lambda_r, path.next.state);
    const CylinderMeasures m = measure(cylinder, path.next.state);
    BOOST_TEST(relative(m.drag, direct.drag) < 1e-9);
    BOOST_TEST(relative(m.mean_velocity, direct.mean_velocity) < 1e-9);
  }
  CylinderFlow cylinder(cylinder_of(16, lambda_r));
  const auto stop = [](const auto&, const CylinderMeasures& m, const solve::PathPoint&) {
    return m.lambda_r > 0.01;
  };
  const auto path =
      solve_from_rest(cylinder, 0.03, Continuation::arclength, cylinder_path_options(), stop);
  BOOST_TEST((path.end == PathEnd::stopped));
  BOOST_TEST(cylinder.flow().rheology().lambda_r <= 0.01);
}

BOOST_AUTO_TEST_CASE(tangent_steps_along_both_parameters_are_of_second_order) {
  CylinderFlow cylinder(cylinder_of(16, 1e-2));
  const State state = creep(cylinder, 0.045);
  check_predictor_order<mixed::RegularisationPath<2>>(cylinder, state, 0.02);
  check_predictor_order<mixed::LoadPath<2>>(cylinder, state, 0.02);
}

// To the last digit that Newton is asked for, all counted: start, steps in vain and the end.
BOOST_AUTO_TEST_CASE(a_flow_past_yield_costs_no_more_than_its_path_needs) {
  struct Case {
    const char* law;
    double mean_velocity, drag;
    int start, all;
  };
  for (const auto& [law, mean_velocity, drag, start, all] :
       {Case{"chauchat-medale", 0.1547649307, 6.184699084, 20, 66},
        Case{"barker-gray", 0.1548115239, 6.136634907, 20, 44}}) {
    Cylinder scene = cylinder_of(24);
    scene.regularisation = *rheology::regularisation_named(law);
    CylinderFlow cylinder(scene);
    int at_start = 0;
    CylinderPath path =
        solve_from_rest(cylinder, 0.054, Continuation::primal_dual, cylinder_path_options(),
                        [&](const auto&, const auto&, const auto&) {
                          if (at_start == 0) at_start = cylinder.flow().factorisations();
                          return true;
                        });
    BOOST_REQUIRE((path.end == PathEnd::target_reached));
    const int on_arrival = cylinder.flow().factorisations();
    solve_at(cylinder, 0.054, scene.lambda_r, path.next.state);
    const CylinderMeasures m = measure(cylinder, path.next.state);
    BOOST_TEST_MESSAGE(law << ": " << at_start << " to the start, " << on_arrival
                           << " to the end of the path, " << cylinder.flow().factorisations());
    BOOST_TEST(cylinder.flow().factorisations() - on_arrival <=
               3);  // the steps are exact where the wake has no viscosity
    BOOST_TEST(at_start <= start);
    BOOST_TEST(cylinder.flow().factorisations() <= all);
    BOOST_TEST(relative(m.mean_velocity, mean_velocity) < 1e-8);
    BOOST_TEST(relative(m.drag, drag) < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(points_on_the_way_are_rough_and_the_last_one_is_not) {
  CylinderFlow cylinder(cylinder_of(16));
  const CylinderPath path = solve_from_rest(cylinder, 0.05);
  BOOST_REQUIRE((path.end == PathEnd::target_reached));
  double roughest = 0;
  for (const solve::PathPoint& point : path.points) roughest = std::max(roughest, point.residual);
  BOOST_TEST(roughest <= 1e-6);
  BOOST_TEST(path.points.back().residual <= cylinder_path_options().corrector.tolerance);
}

BOOST_AUTO_TEST_CASE(a_creeping_load_takes_at_most_fifteen_factorisations_from_rest) {
  for (const double lambda_r : {1e-6, 1e-3})
    for (const double loading : {0.005, 0.02, 0.044, 0.0475}) {
      CylinderFlow cylinder(cylinder_of(24, lambda_r));
      State state;
      const auto creep = creep_to(cylinder, loading, 0, state);
      BOOST_TEST_MESSAGE("F = " << loading << ", λr = " << lambda_r << ": "
                                << cylinder.flow().factorisations() << " factorisations");
      BOOST_REQUIRE(solve::is_success(creep.newton.end));
      BOOST_TEST(creep.loads == 1);
      BOOST_TEST(cylinder.flow().factorisations() <= 15);
      if (lambda_r < 1e-3 && loading > 0.01)
        check_same_flow(measure(cylinder, state), along_lambda_r(cylinder.scene(), loading));
    }
}

BOOST_AUTO_TEST_CASE(a_creeping_load_takes_at_most_seven_factorisations_from_the_one_before) {
  CylinderFlow cylinder(cylinder_of(32));
  State state = creep(cylinder, 0.01);
  double before = 0.01;
  for (const double loading : {0.02, 0.03, 0.035, 0.04, 0.044, 0.046, 0.047, 0.0475, 0.046}) {
    const int spent = cylinder.flow().factorisations();
    const auto there = creep_to(cylinder, loading, before, state);
    BOOST_REQUIRE(solve::is_success(there.newton.end));
    BOOST_TEST(there.loads == 1);
    BOOST_TEST(cylinder.flow().factorisations() - spent <= 7, "F = " << loading);
    before = loading;
  }
  check_same_flow(measure(cylinder, state), along_lambda_r(cylinder.scene(), before));
}

BOOST_AUTO_TEST_CASE(a_load_that_does_not_creep_costs_little_and_leaves_the_state) {
  CylinderFlow cylinder(cylinder_of(24));
  const State creeping = creep(cylinder, 0.04);
  for (const double before : {0.04, 0.0}) {
    State state = creeping;
    const int spent = cylinder.flow().factorisations();
    const auto there = creep_to(cylinder, 0.056, before, state);
    BOOST_TEST(!solve::is_success(there.newton.end));
    BOOST_TEST(there.failures > 0);
    BOOST_TEST(cylinder.flow().factorisations() - spent <= 28);
    BOOST_TEST(cylinder.flow().load_factor() == 0.056);
    BOOST_TEST(!cylinder.flow().is_primal_dual());
    BOOST_TEST((state.value() == creeping.value() && state.correction() == creeping.correction()));
  }
  BOOST_TEST(may_creep(cylinder.scene(), 0.0485));
  BOOST_TEST(!may_creep(cylinder.scene(), 0.05));
  Cylinder fluid = cylinder.scene();
  fluid.regularisation = *rheology::regularisation_named("barker-gray");
  BOOST_TEST(!may_creep(fluid, 0.02));
  Cylinder soft = cylinder.scene();
  soft.penalty = {mixed::Penalty::plain, 10 * soft.lambda_r};
  BOOST_TEST(!may_creep(soft, 0.02));
}

// Newton's own tangent and the primal-dual one come to the same creep; a broken one does not.
BOOST_AUTO_TEST_CASE(the_tangent_asked_for_is_the_one_that_creep_is_solved_with) {
  const auto creep_with = [](shear::TangentTerm tangent) {
    Cylinder scene = cylinder_of(16);
    scene.tangent = tangent;
    CylinderFlow cylinder(scene);
    State state;
    const auto newton = solve_creep(cylinder, 0.04, state);
    return std::pair(newton, solve::is_success(newton.end) ? measure(cylinder, state).drag : 0);
  };
  const auto [by_both, drag] = creep_with(shear::TangentTerm::primal_dual);
  const auto [by_newton, drag_of_newton] = creep_with(shear::TangentTerm::full);
  BOOST_TEST(solve::is_success(by_both.end));
  BOOST_TEST(solve::is_success(by_newton.end));
  BOOST_TEST(drag == drag_of_newton, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(by_both.history[2].residual != by_newton.history[2].residual);
  for (const auto broken : {shear::TangentTerm::frozen, shear::TangentTerm::wrong_sign})
    BOOST_TEST(!solve::is_success(creep_with(broken).first.end));
}

BOOST_AUTO_TEST_SUITE_END()
