// How the systems of velocity-pressure flow are assembled and solved: threads, lagged factors.
#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_path.hpp"
#include "common/mixed/mixed_test_problems.hpp"
#include "common/solve/memory.hpp"
#include "common/testing/allocation_limit.hpp"

BOOST_AUTO_TEST_SUITE(mixed_solve_test)
using namespace talus;
using namespace talus::mixed;

namespace {
const rheology::Rheology eq12{{}, rheology::ChauchatMedale{}, 1e-2};
constexpr solve::NewtonOptions newton_options{.line_search = solve::LineSearch::residual_norm};

struct Threads {  // as many in one test, one again after it
  explicit Threads(int count) { solve::set_threads(count); }
  ~Threads() { solve::set_threads(1); }
};

fem::Mesh<3> bricks(int n) {
  std::vector<double> line;
  for (int i = 0; i <= n; ++i) line.push_back(i / static_cast<double>(n));
  return curved(fem::box_mesh(line, line, line));
}

// Everything assembled at a state, and one step.
struct Assembled {
  Eigen::VectorXd residual, magnitude, round_off, step, product;
  int sign;
  bool operator==(const Assembled&) const = default;
};

template <int Dim>
Assembled assemble(const MixedSpace<Dim>& space, int thread_count) {
  const Threads threads(thread_count);
  MixedFlow<Dim> flow(space, eq12, test_load<Dim>(1));
  const auto state = state_of(space, {"", 1, 1, 0.5, 1});
  const solve::Residual residual = flow.evaluate(state);
  typename MixedFlow<Dim>::State step;
  BOOST_REQUIRE(flow.linear_solve(residual.value, step));
  return {residual.value, residual.magnitude,          residual.round_off,
          step.value(),   flow.tangent_product(state), flow.determinant_sign()};
}

// Shear between two plates, the upper one pulled along: a start is its speed.
class Sheared {
 public:
  explicit Sheared(LinearSolver solver) : flow_(space_, eq12, load()) {
    flow_.set_linear_solver(solver);
  }
  MixedFlow<2>& flow() { return flow_; }
  MixedFlow<2>::State start() const { return space_.start(); }

 private:
  static MixedLoad<2> load() {
    return {[](const fem::Point<2>&) { return 2.0; },
            [](const fem::Point<2>& x) { return fem::Point<2>(1.5 * x[1], 0.1); }};
  }
  static BoundaryConditions<2> conditions() {
    BoundaryConditions<2> all = mixed_conditions<2>(false);
    all["left"] = no_slip<2>();
    return all;
  }
  MixedSpace<2> space_{awkward_mesh2(6, 6), conditions()};
  MixedFlow<2> flow_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(any_number_of_threads_gives_the_same_bits) {
  const MixedSpace<2> plane(awkward_mesh2(40, 40), mixed_conditions<2>());
  const MixedSpace<3> box(bricks(6), mixed_conditions<3>());
  const Assembled plane_alone = assemble(plane, 1), box_alone = assemble(box, 1);
  for (const int count : {2, 3, 5}) {
    BOOST_TEST((assemble(plane, count) == plane_alone), count << " threads, 2D");
    BOOST_TEST((assemble(box, count) == box_alone), count << " threads, 3D");
  }
}

BOOST_AUTO_TEST_CASE(batches_of_a_colour_share_no_node_and_each_is_visited_once) {
  const MixedSpace<3> space(bricks(4), mixed_conditions<3>());
  std::vector<int> times(space.batches().size(), 0);
  space.for_each_batch([&](std::size_t b) { ++times[b]; });
  for (const int each : times) BOOST_TEST(each == 1);
  // More threads than batches: what is then met at the same time is a whole colour.
  std::vector<std::size_t> colour;
  const auto disjoint = [&] {
    std::vector<bool> used(space.mesh().nodes.size(), false);
    for (const std::size_t b : colour)
      for (std::size_t lane = 0; lane < space.batches()[b].count; ++lane)
        for (const auto node : space.mesh().elements[space.batches()[b].elements[lane]]) {
          if (used[static_cast<std::size_t>(node)]) return false;
          used[static_cast<std::size_t>(node)] = true;
        }
    return true;
  };
  std::size_t first = 0, colours = 0;
  for (const std::size_t end : space.colour_ends()) {
    colour.clear();
    for (std::size_t b = first; b < end; ++b) colour.push_back(b);
    BOOST_TEST(disjoint());
    first = end;
    ++colours;
  }
  BOOST_TEST(colours == 8U);
  for (std::size_t b = 0; b < times.size(); ++b) colour.push_back(b);
  BOOST_TEST(!disjoint());  // negative control
}

BOOST_AUTO_TEST_CASE(lagged_factors_find_the_same_flow_with_fewer_factorisations) {
  Sheared direct(LinearSolver::direct), lagged(LinearSolver::lagged);
  auto expected = direct.start(), found = lagged.start();
  const auto direct_newton = solve::newton(direct.flow(), expected, newton_options);
  const auto lagged_newton = solve::newton(lagged.flow(), found, newton_options);
  BOOST_REQUIRE(is_success(direct_newton.end));
  BOOST_REQUIRE(is_success(lagged_newton.end));
  // One a step, and perhaps one for the direction that shows that no step is left.
  const int tried = direct.flow().factorisations() - direct_newton.iterations();
  BOOST_TEST((tried == 0 || tried == 1));
  BOOST_TEST(direct.flow().krylov_iterations() == 0);
  BOOST_TEST(lagged.flow().factorisations() <= direct.flow().factorisations() / 2);
  BOOST_TEST(lagged.flow().krylov_iterations() > 0);
  BOOST_TEST(lagged_newton.iterations() <= direct_newton.iterations() + 2);
  BOOST_TEST((found.value() - expected.value()).norm() < 1e-9 * expected.value().norm());
}

BOOST_AUTO_TEST_CASE(a_lagged_step_solves_its_own_system_and_not_that_of_the_factors) {
  Sheared sheared(LinearSolver::lagged);
  MixedFlow<2>& flow = sheared.flow();
  auto state = sheared.start();
  BOOST_REQUIRE(is_success(solve::newton(flow, state, newton_options).end));
  const int before = flow.factorisations();
  flow.set_load_factor(1.1);
  const Eigen::VectorXd b = flow.evaluate(state.moved(0.1, state)).value;
  MixedFlow<2>::State step, of_old_factors;
  BOOST_REQUIRE(flow.linear_solve(b, step));
  BOOST_TEST(flow.factorisations() == before);
  Eigen::VectorXd unrefined;
  BOOST_REQUIRE(flow.system().solve(b, unrefined));
  const auto residual = [&](const solve::CompensatedVector& x) {
    return (b - flow.tangent_product(x)).norm() / b.norm();
  };
  BOOST_TEST(residual(step) < 1e-2);
  BOOST_TEST(residual(solve::CompensatedVector(unrefined)) > 2e-2);  // negative control
}

BOOST_AUTO_TEST_CASE(useless_factors_are_replaced) {
  Sheared sheared(LinearSolver::lagged), fresh(LinearSolver::direct);
  MixedFlow<2>& flow = sheared.flow();
  auto state = sheared.start();
  BOOST_REQUIRE(is_success(solve::newton(flow, state, newton_options).end));
  const int before = flow.factorisations();
  flow.set_lambda_r(1e-7);  // at rest: every viscosity up by 1e5
  const Eigen::VectorXd b = flow.evaluate(sheared.start()).value;
  MixedFlow<2>::State x, expected;
  BOOST_REQUIRE(flow.linear_solve(b, x));
  BOOST_TEST(flow.factorisations() == before + 1);
  fresh.flow().set_lambda_r(1e-7);
  fresh.flow().evaluate(fresh.start());
  BOOST_REQUIRE(fresh.flow().linear_solve(b, expected));
  BOOST_TEST(x.value() == expected.value());
}

BOOST_AUTO_TEST_CASE(a_path_refuses_a_solver_without_determinants) {
  Sheared sheared(LinearSolver::lagged);
  BOOST_CHECK_THROW(LoadPath<2>{sheared.flow()}, std::invalid_argument);
  sheared.flow().set_linear_solver(LinearSolver::direct);
  BOOST_CHECK_NO_THROW(LoadPath<2>{sheared.flow()});
}

// Where the pressure is negative there is no viscosity to scale the penalty of the matrix by: with
// inertia left out of the scale the refinement stalled, and Newton's method was linear in wakes.
BOOST_AUTO_TEST_CASE(a_step_is_exact_where_negative_pressure_leaves_inertia_alone) {
  const auto rest_of_step = [](const auto& space) {
    constexpr int dim = std::remove_cvref_t<decltype(space)>::Vector::RowsAtCompileTime;
    MixedFlow<dim> flow(space, {{}, rheology::ChauchatMedale{}, 1e-6}, test_load<dim>(1));
    auto state = state_of(space, {"", 1, 1, 0.5, 1});
    for (std::size_t e = 0; e < space.element_count(); e += 3)
      state.set(space.pressure_index(e, 0), -5);
    const Eigen::VectorXd residual = flow.evaluate(state).value;
    typename MixedFlow<dim>::State step;
    BOOST_REQUIRE(flow.linear_solve(-residual, step));
    return (flow.tangent_product(step) + residual).norm() / residual.norm();
  };
  BOOST_TEST(rest_of_step(MixedSpace<2>(awkward_mesh2(8, 8), mixed_conditions<2>())) < 1e-10);
  BOOST_TEST(rest_of_step(MixedSpace<3>(bricks(3), mixed_conditions<3>())) < 1e-10);
}

// One element in a wake, as stiff as its slow flow is heavy, has its pressure answered by far
// stiffer neighbours: refinement alone takes little of that one mode out.
BOOST_AUTO_TEST_CASE(a_step_keeps_mass_where_an_element_without_viscosity_has_stiff_neighbours) {
  const MixedSpace<2> space(awkward_mesh2(8, 8), mixed_conditions<2>());
  const Eigen::Index pressures = space.size() - space.velocity_count();
  double worst_refined = 0;
  for (const double inertia : {1e-3, 1e-2, 0.1, 1.0}) {
    MixedFlow<2> flow(space, {{}, rheology::ChauchatMedale{}, 1e-6}, test_load<2>(inertia));
    auto state = state_of(space, {"", 1e-3, 1, 0, 1});
    state.set(space.pressure_index(27, 0), -5);
    const Eigen::VectorXd b = -flow.evaluate(state).value;
    MixedFlow<2>::State step;
    BOOST_REQUIRE(flow.linear_solve(b, step));
    const auto share_of_mass = [&](const Eigen::VectorXd& x) {
      return (flow.tangent_product(solve::CompensatedVector(x)) - b).tail(pressures).norm() /
             b.tail(pressures).norm();
    };
    Eigen::VectorXd refined = Eigen::VectorXd::Zero(space.size()), correction;
    for (int i = 0; i < 5; ++i, refined += correction)
      flow.system().solve(b - flow.tangent_product(solve::CompensatedVector(refined)), correction);
    worst_refined = std::max(worst_refined, share_of_mass(refined));
    BOOST_TEST(share_of_mass(step.value()) < 1e-3, "inertia " << inertia);
  }
  BOOST_TEST(worst_refined > 0.1);  // it did happen
}

BOOST_AUTO_TEST_CASE(a_refinement_that_makes_it_worse_is_taken_back_and_a_useless_step_is_none) {
  const MixedSpace<2> space(awkward_mesh2(4, 4), mixed_conditions<2>());
  const auto state = state_of(space, {"", 1, 1, 0.5, 1});
  int solved = 0, useless = 0, worse = 0;
  for (const double sign : {1.0, -1.0})  // the wrong sign of the penalty: refinement may diverge
    for (double lambda_p = 1e-4; lambda_p < 1e7; lambda_p *= 3) {
      MixedFlow<2> flow(space, eq12, test_load<2>(1), {Penalty::iterated, sign * lambda_p});
      const Eigen::VectorXd b = flow.evaluate(state).value;
      MixedFlow<2>::State x;
      const bool is_solved = flow.linear_solve(b, x);
      const auto left_by = [&](const Eigen::VectorXd& y) {
        return (b - flow.tangent_product(solve::CompensatedVector(y))).norm();
      };
      Eigen::VectorXd first, correction;
      if (!flow.system().solve(b, first)) continue;
      const double unrefined = left_by(first);
      flow.system().solve(b - flow.tangent_product(solve::CompensatedVector(first)), correction);
      worse += left_by(first + correction) > unrefined;
      useless += !is_solved;
      if (!is_solved) continue;
      ++solved;
      const double left = (b - flow.tangent_product(x)).norm();
      BOOST_TEST(left < b.norm(), sign * lambda_p << " leaves " << left / b.norm());
      BOOST_TEST(left <= std::max(unrefined, 1e-9 * b.norm()), sign * lambda_p);
    }
  BOOST_TEST(solved > 5);
  BOOST_TEST(useless > 0);
  BOOST_TEST(worse > 0);  // it did happen
}

BOOST_AUTO_TEST_CASE(newton_ends_where_a_step_is_useless) {
  const MixedSpace<2> space(awkward_mesh2(4, 4), mixed_conditions<2>());
  const auto end = [&](double lambda_p) {
    MixedFlow<2> flow(space, eq12, test_load<2>(1), {Penalty::iterated, lambda_p});
    auto state = state_of(space, {"", 1, 1, 0.5, 1});
    return solve::newton(flow, state, newton_options).end;
  };
  BOOST_TEST((end(1e6) == solve::End::linear_solver_failed), solve::name_of(end(1e6)));
  BOOST_TEST((end(1e-4) != solve::End::linear_solver_failed), solve::name_of(end(1e-4)));
}

// Without eq. (16) there is no viscosity where the pressure is negative: what is carried beside it
// must then vanish from the tangent, as it does in the limit of eq. (16), p_regu = λr²/(4|p|).
BOOST_AUTO_TEST_CASE(a_carried_stress_leaves_the_tangent_with_the_viscosity) {
  const MixedSpace<2> space(awkward_mesh2(5, 5), mixed_conditions<2>());
  const auto stress = [](const fem::Point<2>& x) {
    return Eigen::Matrix2d({{x[0], 0.3}, {0.3, -x[0]}});
  };
  const auto direction = state_of(space, {"", 0.7, 1, 0.2, 1});
  for (const auto& law : rheology::regularisations())
    for (const double inertia : {1.0, 0.0}) {
      auto state = state_of(space, {"", 1, 1, 0.5, 1});
      for (std::size_t e = 0; e < space.element_count(); e += 3)
        state.set(space.pressure_index(e, 0), -5);
      rheology::Rheology without{{}, law, 1e-9};
      without.regularises_pressure = false;
      MixedFlow<2> limit(space, {{}, law, 1e-9}, test_load<2>(inertia)),
          flow(space, without, test_load<2>(inertia));
      for (MixedFlow<2>* each : {&limit, &flow}) {
        each->set_primal_dual(true);
        state.stress = each->stress_of(stress);
        each->evaluate(state);
      }
      const Eigen::VectorXd expected = limit.tangent_product(direction),
                            product = flow.tangent_product(direction);
      BOOST_REQUIRE(product.allFinite());
      BOOST_TEST((product - expected).norm() < 1e-9 * expected.norm(), rheology::name_of(law));
      if (inertia == 0) continue;  // nothing moves what has neither friction nor mass
      MixedFlow<2>::State x;
      BOOST_REQUIRE(flow.linear_solve(product, x));
      BOOST_TEST((flow.tangent_product(x) - product).norm() < 1e-6 * product.norm(),
                 rheology::name_of(law));
    }
}

BOOST_AUTO_TEST_CASE(lack_of_memory_is_no_end_of_newton_but_thrown) {
  const MixedSpace<2> space(awkward_mesh2(12, 12), mixed_conditions<2>());
  MixedFlow<2> flow(space, eq12, test_load<2>(1));
  auto state = space.start();
  const talus::testing::AllocationLimit limit(50000);
  BOOST_CHECK_THROW(solve::newton(flow, state, newton_options), solve::OutOfMemory);
}
BOOST_AUTO_TEST_SUITE_END()
