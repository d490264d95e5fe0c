#include "common/solve/jacobian_check.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(jacobian_check_test)

using namespace talus::solve;

namespace {

// Two velocities and two pressures, every block nonlinear.
Eigen::Vector4d force(const Eigen::Vector4d& x) {
  return {x[0] * x[0] * x[0] + x[1] * x[2] + x[0] * x[3] * x[3],
          std::sin(x[0]) + x[1] * x[1] + std::exp(x[2]) * x[3], std::exp(x[2]) + x[0] * x[1] * x[1],
          x[3] * x[3] + x[0] * x[0] * x[2]};
}

Eigen::Matrix4d derivative(const Eigen::Vector4d& x) {
  return Eigen::Matrix4d{{3 * x[0] * x[0] + x[3] * x[3], x[2], x[1], 2 * x[0] * x[3]},
                         {std::cos(x[0]), 2 * x[1], std::exp(x[2]) * x[3], std::exp(x[2])},
                         {x[1] * x[1], 2 * x[0] * x[1], std::exp(x[2]), 0},
                         {2 * x[0] * x[2], 0, x[0] * x[0], 2 * x[3]}};
}

JacobianProblem problem_of(const std::function<Eigen::Vector4d(const Eigen::Vector4d&)>& residual,
                           const Eigen::Matrix4d& jacobian) {
  const std::vector<Block> blocks{{"velocity", {0, 1}}, {"pressure", {2, 3}}};
  return {4,
          [=](const Eigen::VectorXd& displacement) {
            Residual r{residual(displacement), Eigen::Vector4d::Constant(5), {}};
            r.round_off = 4 * std::numeric_limits<double>::epsilon() * r.magnitude;
            return r;
          },
          [=](const Eigen::VectorXd& v) { return Eigen::VectorXd(jacobian * v); }, blocks, blocks};
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector4d state{0.7, -0.3, 0.5, 1.1};

JacobianCheck check_with(const Eigen::Matrix4d& jacobian) {
  return check_jacobian(
      problem_of([](const Eigen::Vector4d& d) { return force(state + d); }, jacobian));
}

std::string printed(const JacobianCheck& check) {
  std::ostringstream out;
  print(out, check);
  return out.str();
}

std::vector<std::string> wrong_blocks(const JacobianCheck& check) {
  std::vector<std::string> names;
  for (const TaylorTest& test : check.blocks)
    if (!test.passed()) names.push_back(test.rows + "/" + test.columns);
  return names;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_right_derivative_passes_with_slope_two) {
  const JacobianCheck check = check_with(derivative(state));
  BOOST_TEST(check.passed());
  BOOST_TEST(check.blocks.size() == 5);
  for (const TaylorTest& test : check.blocks) {
    BOOST_TEST(test.slope > 1.9, test.rows << "/" << test.columns);
    BOOST_TEST(test.slope < 2.1, test.rows << "/" << test.columns);
  }
  BOOST_TEST(check.smallest_slope() > 1.9);
  BOOST_TEST(check.entries.worst < 1e-8);
  BOOST_TEST(printed(check).find("WRONG") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_wrong_sign_in_one_entry_is_caught_and_located) {
  Eigen::Matrix4d jacobian = derivative(state);
  jacobian(1, 2) *= -1;
  const JacobianCheck check = check_with(jacobian);
  BOOST_TEST(!check.passed());
  BOOST_TEST(check.entries.row == 1);
  BOOST_TEST(check.entries.column == 2);
  BOOST_TEST(check.entries.analytic == jacobian(1, 2));
  BOOST_TEST(check.smallest_slope() < 1.1);
  BOOST_TEST(printed(check).find("WRONG") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_missing_term_is_named_by_its_block_alone) {
  Eigen::Matrix4d jacobian = derivative(state);
  jacobian.topRightCorner<2, 2>().setZero();
  const std::vector<std::string> expected{"all/all", "velocity/pressure"};
  BOOST_TEST(wrong_blocks(check_with(jacobian)) == expected, boost::test_tools::per_element());

  jacobian = derivative(state);
  jacobian(3, 0) = 0;
  const std::vector<std::string> other{"all/all", "pressure/velocity"};
  BOOST_TEST(wrong_blocks(check_with(jacobian)) == other, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_relative_error_of_a_thousandth_in_any_entry_is_caught) {
  for (Eigen::Index row = 0; row < 4; ++row)
    for (Eigen::Index column = 0; column < 4; ++column) {
      Eigen::Matrix4d jacobian = derivative(state);
      if (jacobian(row, column) == 0) continue;
      jacobian(row, column) *= 1.001;
      const JacobianCheck check = check_with(jacobian);
      BOOST_TEST(!check.entries.passed(), "entry " << row << ", " << column);
      BOOST_TEST(check.entries.row == row);
      BOOST_TEST(check.entries.column == column);
      BOOST_TEST(!wrong_blocks(check).empty(), "entry " << row << ", " << column);
    }
}

BOOST_AUTO_TEST_CASE(a_linear_problem_is_reported_as_linear) {
  const Eigen::Matrix4d matrix = derivative(state);
  const auto linear = [&](const Eigen::Vector4d& d) -> Eigen::Vector4d { return matrix * d; };
  const JacobianCheck check = check_jacobian(problem_of(linear, matrix));
  BOOST_TEST(check.passed());
  for (const TaylorTest& test : check.blocks) BOOST_TEST(test.is_linear());
  BOOST_TEST(std::isinf(check.smallest_slope()));
  BOOST_TEST(printed(check).find("linear") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_wrong_matrix_of_a_linear_problem_is_not_taken_for_linear) {
  const Eigen::Matrix4d matrix = derivative(state);
  const auto linear = [&](const Eigen::Vector4d& d) -> Eigen::Vector4d { return matrix * d; };
  const JacobianCheck check = check_jacobian(problem_of(linear, 1.01 * matrix));
  BOOST_TEST(!check.passed());
  for (const TaylorTest& test : check.blocks) BOOST_TEST(!test.passed());
}

BOOST_AUTO_TEST_CASE(a_nan_in_the_derivative_is_wrong_and_its_row_is_told) {
  for (Eigen::Index row = 0; row < 4; ++row)
    for (Eigen::Index column = 0; column < 4; ++column) {
      Eigen::Matrix4d jacobian = derivative(state);
      jacobian(row, column) = not_a_number;
      const JacobianCheck check = check_with(jacobian);
      BOOST_CHECK(check.verdict() == Verdict::wrong);
      BOOST_CHECK(check.entries.verdict == Verdict::wrong);
      BOOST_TEST(check.entries.row == row);
      BOOST_TEST(std::isnan(check.smallest_slope()));
      BOOST_TEST(printed(check).find("WRONG") != std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(a_residual_that_is_no_number_gets_no_verdict_on_its_derivative) {
  const auto nowhere = [](const Eigen::Vector4d&) -> Eigen::Vector4d {
    return Eigen::Vector4d::Constant(not_a_number);
  };
  const auto only_there = [=](const Eigen::Vector4d& d) -> Eigen::Vector4d {
    return d.isZero() ? force(state) : nowhere(d);
  };
  const auto one_row_of = [](const Eigen::Vector4d& d) {
    Eigen::Vector4d f = force(state + d);
    f[2] = not_a_number;
    return f;
  };
  for (const std::function<Eigen::Vector4d(const Eigen::Vector4d&)>& residual :
       {std::function<Eigen::Vector4d(const Eigen::Vector4d&)>(nowhere),
        {only_there},
        {one_row_of}}) {
    const JacobianCheck check = check_jacobian(problem_of(residual, derivative(state)));
    BOOST_CHECK(check.verdict() == Verdict::not_evaluated);
    BOOST_TEST(!check.passed());
    BOOST_TEST(printed(check).find("not evaluated") != std::string::npos);
    BOOST_TEST(printed(check).find("WRONG") == std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(far_steps_may_leave_the_domain_of_the_residual) {
  const auto bounded = [](const Eigen::Vector4d& d) -> Eigen::Vector4d {
    if (d.norm() > 0.1) return Eigen::Vector4d::Constant(not_a_number);
    return force(state + d);
  };
  BOOST_TEST(check_jacobian(problem_of(bounded, derivative(state))).passed());
  BOOST_CHECK(check_jacobian(problem_of(bounded, 1.01 * derivative(state))).verdict() ==
              Verdict::wrong);
}

BOOST_AUTO_TEST_CASE(what_round_off_hides_is_not_tested_and_does_not_pass) {
  JacobianProblem problem =
      problem_of([](const Eigen::Vector4d& d) { return force(state + d); }, derivative(state));
  const auto exact = problem.residual;
  problem.residual = [=](const Eigen::VectorXd& d) {
    Residual r = exact(d);
    r.round_off.setConstant(1e3);
    return r;
  };
  const JacobianCheck check = check_jacobian(problem);
  BOOST_CHECK(check.verdict() == Verdict::not_tested);
  BOOST_CHECK(check.entries.verdict == Verdict::not_tested);
  for (const TaylorTest& test : check.blocks) BOOST_CHECK(test.verdict == Verdict::not_tested);
  BOOST_TEST(!check.passed());
  BOOST_TEST(printed(check).find("not tested") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(blocks_alone_leave_the_entries_untested_and_do_not_pass) {
  const JacobianCheck check = check_blocks(
      problem_of([](const Eigen::Vector4d& d) { return force(state + d); }, derivative(state)));
  for (const TaylorTest& test : check.blocks) BOOST_TEST(test.passed());
  BOOST_CHECK(check.entries.verdict == Verdict::not_tested);
  BOOST_CHECK(check.verdict() == Verdict::not_tested);
  BOOST_TEST(!check.passed());
}

BOOST_AUTO_TEST_CASE(a_system_that_is_not_the_derivative_is_caught) {
  JacobianProblem problem =
      problem_of([](const Eigen::Vector4d& d) { return force(state + d); }, derivative(state));
  for (const double error : {1e-12, 1e-5, 1.0, not_a_number}) {
    problem.system_error = [=] { return SystemError{error}; };
    const JacobianCheck check = check_jacobian(problem);
    BOOST_TEST(check.passed() == (error == 1e-12));
    BOOST_TEST(check.system.is_asked);
  }
}

BOOST_AUTO_TEST_CASE(
    an_error_of_the_system_within_its_round_off_is_none_but_must_not_hide_a_percent) {
  JacobianProblem problem =
      problem_of([](const Eigen::Vector4d& d) { return force(state + d); }, derivative(state));
  const auto verdict = [&](double error, double round_off) {
    problem.system_error = [=] { return SystemError{error, round_off}; };
    return check_jacobian(problem).verdict();
  };
  BOOST_CHECK(verdict(1e-5, 2e-5) == Verdict::right);
  BOOST_CHECK(verdict(1e-2, 2e-5) == Verdict::wrong);
  BOOST_CHECK(verdict(1e-2, 2e-2) == Verdict::not_tested);
  BOOST_CHECK(verdict(1e-12, 2e-2) == Verdict::not_tested);
  BOOST_CHECK(verdict(1e-12, not_a_number) != Verdict::right);
  constexpr double not_solved = std::numeric_limits<double>::infinity();
  BOOST_CHECK(verdict(not_solved, 2e-2) == Verdict::not_tested);
  for (const double round_off : {0.0, 1e-4, not_a_number})
    BOOST_CHECK(verdict(not_solved, round_off) == Verdict::wrong);
}

// A term that is linear, too small to be seen over the distance in which the others curve.
BOOST_AUTO_TEST_CASE(a_linear_block_too_small_for_the_scale_is_seen_from_afar_and_passes_if_right) {
  constexpr double small = 1e-14;
  const auto verdict = [&](double factor, double curvature) {
    const auto residual = [=](const Eigen::Vector4d& d) -> Eigen::Vector4d {
      return {std::sin(d[0]), 2 * d[1], 3 * d[0] + small * (d[2] + curvature * d[2] * d[2]),
              3 * d[1] + small * d[3]};
    };
    const double s = factor * small;
    const Eigen::Matrix4d jacobian{{1, 0, 0, 0}, {0, 2, 0, 0}, {3, 0, s, 0}, {0, 3, 0, s}};
    return check_blocks(problem_of(residual, jacobian)).blocks.back().verdict;
  };
  BOOST_CHECK(verdict(1, 0) == Verdict::right);
  BOOST_CHECK(verdict(1, 1) == Verdict::not_tested);  // curved: nothing is known
  for (const double factor : {0.5, 0.99, 1.01, 2.0, -1.0})
    for (const double curvature : {0.0, 1.0})
      BOOST_CHECK(verdict(factor, curvature) != Verdict::right);
}

// x|x| and a kink at the origin of the law, a hair beside the state.
BOOST_AUTO_TEST_CASE(a_kink_next_to_the_state_is_no_error_of_the_derivative) {
  for (const double beside : {1e-12, 1e-9, 1e-6, 1e-3}) {
    const auto kinked = [=](const Eigen::Vector4d& d) -> Eigen::Vector4d {
      const Eigen::Array4d x = d.array() + beside;
      return x * x + x.abs() + 2 * x;
    };
    const Eigen::Matrix4d right = (3 + 2 * beside) * Eigen::Matrix4d::Identity();
    BOOST_TEST(check_jacobian(problem_of(kinked, right)).passed(), beside);
    for (const double factor : {0.0, 0.5, 0.99, 2.0, -1.0})
      BOOST_CHECK(check_jacobian(problem_of(kinked, factor * right)).verdict() == Verdict::wrong);
  }
}

BOOST_AUTO_TEST_SUITE_END()
