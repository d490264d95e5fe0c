#include "common/shear/law_check.hpp"

#include <cmath>
#include <limits>

namespace talus::shear {

std::vector<LawState> law_states(const rheology::Rheology& rheology, double pressure) {
  const double lambda_r = rheology.lambda_r;
  const double flowing = rheology.law.reference_shear_rate(pressure);  // I = I0
  return {{"in plug", 5e-3 * lambda_r, pressure},     {"at yield", lambda_r, pressure},
          {"just flowing", 30 * lambda_r, pressure},  {"flowing", flowing, pressure},
          {"tiny pressure", flowing, 0.1 * lambda_r}, {"negative pressure", flowing, -pressure}};
}

solve::JacobianProblem law_problem(const rheology::Rheology& rheology,
                                   const std::vector<LawState>& states) {
  const auto count = static_cast<Eigen::Index>(states.size());
  const auto state = [=](Eigen::Index i) { return states[static_cast<std::size_t>(i)]; };
  solve::JacobianProblem problem;
  problem.size = 2 * count;  // the second half of the rows is empty
  problem.scale = Eigen::VectorXd(2 * count);
  problem.columns = {{"|γ|", {}}, {"p", {}}};
  for (Eigen::Index i = 0; i < count; ++i) {
    problem.scale[i] = 0.5 * state(i).shear_rate;
    problem.scale[count + i] = 0.5 * std::abs(state(i).total_pressure);
    problem.rows.push_back({"η " + state(i).name, {i}});
    problem.columns[0].indices.push_back(i);
    problem.columns[1].indices.push_back(count + i);
  }
  problem.residual = [=](const Eigen::VectorXd& x) {
    Eigen::VectorXd eta = Eigen::VectorXd::Zero(2 * count);
    for (Eigen::Index i = 0; i < count; ++i)
      eta[i] =
          rheology.evaluate(state(i).shear_rate + x[i], state(i).total_pressure + x[count + i]).eta;
    return solve::Residual{eta, eta, 8 * std::numeric_limits<double>::epsilon() * eta};
  };
  problem.product = [=](const Eigen::VectorXd& v) {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(2 * count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = rheology.evaluate(state(i).shear_rate, state(i).total_pressure);
      // A direction that is not taken does not meet the other derivative.
      if (v[i] != 0) change[i] += at.d_eta_d_shear_rate * v[i];
      if (v[count + i] != 0) change[i] += at.d_eta_d_pressure * v[count + i];
    }
    return change;
  };
  return problem;
}

solve::NamedCheck check_law(const rheology::Rheology& rheology, double pressure) {
  return {"the law alone",
          solve::check_jacobian(law_problem(rheology, law_states(rheology, pressure)))};
}

}  // namespace talus::shear
