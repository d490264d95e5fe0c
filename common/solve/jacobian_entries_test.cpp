#include "common/solve/jacobian_entries.hpp"

#include <limits>

#include <boost/test/unit_test.hpp>

#include "common/solve/jacobian_check.hpp"

BOOST_AUTO_TEST_SUITE(jacobian_entries_test)

using namespace talus::solve;

BOOST_AUTO_TEST_CASE(columns_that_share_no_row_are_differenced_together) {
  constexpr int n = 40;
  int evaluations = 0;
  JacobianProblem problem;
  problem.size = n;
  problem.residual = [&](const Eigen::VectorXd& d) {
    ++evaluations;
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 0.5, 1.5) + d;
    Residual r{x.array().cube(), Eigen::VectorXd::Constant(n, 4), {}};
    for (int i = 1; i < n; ++i) r.value[i] += x[i - 1] * x[i];
    r.round_off = 4 * std::numeric_limits<double>::epsilon() * r.magnitude;
    return r;
  };
  double factor = 1;  // of one entry
  bool has_corner = false;
  problem.product = [&](const Eigen::VectorXd& v) {
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 0.5, 1.5);
    Eigen::VectorXd product = 3 * x.array().square() * v.array();
    for (int i = 1; i < n; ++i)
      product[i] += (i == 30 ? factor : 1) * x[i] * v[i - 1] + x[i - 1] * v[i];
    if (has_corner) product[0] += v[n - 1];
    return product;
  };
  Block all{"x", {}};
  for (int i = 0; i < n; ++i) all.indices.push_back(i);
  problem.rows = problem.columns = {all};
  BOOST_TEST(check_jacobian(problem).passed());
  BOOST_TEST(evaluations < 400);
  factor = 1.01;
  JacobianCheck check = check_jacobian(problem);
  BOOST_CHECK(check.entries.verdict == Verdict::wrong);
  BOOST_TEST(check.entries.row == 30);
  BOOST_TEST(check.entries.column == 29);
  factor = 0;  // an entry that the claimed matrix lacks
  check = check_jacobian(problem);
  BOOST_CHECK(check.entries.verdict == Verdict::wrong);
  BOOST_TEST(check.entries.row == 30);
  factor = 1;
  has_corner = true;  // one too many
  check = check_jacobian(problem);
  BOOST_TEST(check.entries.row == 0);
  BOOST_TEST(check.entries.column == n - 1);
}

BOOST_AUTO_TEST_CASE(an_entry_that_has_no_difference_is_not_evaluated) {
  JacobianProblem problem;
  problem.size = 4;
  bool breaks = true;
  problem.residual = [&](const Eigen::VectorXd& d) {
    Residual r{d + Eigen::VectorXd::Ones(4), Eigen::VectorXd::Constant(4, 2), {}};
    if (breaks && d[3] != 0) r.value[3] = std::numeric_limits<double>::quiet_NaN();
    r.round_off = std::numeric_limits<double>::epsilon() * r.magnitude;
    return r;
  };
  problem.product = [](const Eigen::VectorXd& v) -> Eigen::VectorXd { return v; };
  problem.rows = problem.columns = {{"x", {0, 1, 2, 3}}};
  const Eigen::VectorXd scale = Eigen::VectorXd::Ones(4);
  const auto verdict = [&] {
    return test_entries(problem, claimed_matrix(problem), scale).verdict;
  };
  BOOST_CHECK(verdict() == Verdict::not_evaluated);
  breaks = false;
  BOOST_CHECK(verdict() == Verdict::right);
}

BOOST_AUTO_TEST_SUITE_END()
