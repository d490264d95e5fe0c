#include "common/solve/jacobian_check.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include <boost/test/unit_test.hpp>

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
    if (!test.passed) names.push_back(test.rows + "/" + test.columns);
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
      BOOST_TEST(!check.entries.passed, "entry " << row << ", " << column);
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
  BOOST_TEST(std::isnan(check.smallest_slope()));
  BOOST_TEST(printed(check).find("linear") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_wrong_matrix_of_a_linear_problem_is_not_taken_for_linear) {
  const Eigen::Matrix4d matrix = derivative(state);
  const auto linear = [&](const Eigen::Vector4d& d) -> Eigen::Vector4d { return matrix * d; };
  const JacobianCheck check = check_jacobian(problem_of(linear, 1.01 * matrix));
  BOOST_TEST(!check.passed());
  for (const TaylorTest& test : check.blocks) BOOST_TEST(!test.passed);
}
