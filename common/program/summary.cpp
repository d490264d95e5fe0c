#include "common/program/summary.hpp"

#include <iostream>

#include <sys/resource.h>

namespace talus::program {
namespace {

using nlohmann::json;

json newton_as_json(const solve::ContinuationSummary& newton) {
  json path = json::array();
  for (const auto& step : newton.path)
    path.push_back({{"lambda_r", step.lambda_r},
                    {"end", solve::name_of(step.end)},
                    {"iterations", step.iterations}});
  return {{"iterations", newton.total_iterations()},
          {"lambda_r", newton.lambda_r},
          {"final_residual", newton.newton.final_residual()},
          {"round_off_floor", newton.newton.round_off_floor()},
          {"continuation", path}};
}

json interior_point_as_json(const shear::InteriorPointSummary& summary) {
  return {{"factorisations", summary.factorisations()},
          {"relative_gap", summary.relative_gap()},
          {"round_off", summary.last_good.round_off},
          {"equilibrium", summary.last_good.equilibrium},
          {"at_rest", summary.at_rest}};
}

}  // namespace

json as_json(const rheology::FrictionLaw& law) {
  return {{"mu_s", law.mu_s},
          {"delta_mu", law.delta_mu},
          {"I0", law.I0},
          {"solid_fraction", law.solid_fraction},
          {"grain_size", law.grain_size}};
}

json as_json(const shear::ShearOptions& options) {
  if (options.method == shear::Method::interior_point)
    return {{"method", "interior-point"}, {"tolerance", options.interior_point.tolerance}};
  return {{"method", "newton"},
          {"regularisation", rheology::name_of(options.regularisation)},
          {"lambda_r", options.lambda_r},
          {"tolerance", options.newton.tolerance},
          {"precision", options.precision == solve::Precision::plain ? "plain" : "compensated"}};
}

void add_outcome(json& summary, const shear::ShearSolution& solution) {
  summary["status"] = solve::name_of(solution.end);
  if (solution.is_of_newton())
    summary["newton"] = newton_as_json(solution.newton);
  else
    summary["interior_point"] = interior_point_as_json(solution.interior_point);
  summary["iterations"] = summary["factorisations"] = solution.iterations();
  summary["seconds"] = solution.seconds;
}

io::Table iteration_table(const shear::ShearSolution& solution) {
  io::Table table;
  if (solution.is_of_newton()) {
    table.header = {"iteration", "residual", "round_off_floor", "step", "evaluations"};
    int iteration = 0;
    for (const auto& record : solution.newton.newton.history)
      table.rows.push_back({std::to_string(iteration++), io::exact(record.residual),
                            io::exact(record.round_off), io::exact(record.step),
                            std::to_string(record.evaluations)});
  } else {
    table.header = {"factorisation", "relative_gap", "equilibrium", "centring", "step"};
    int iteration = 0;
    for (const auto& record : solution.interior_point.history)
      table.rows.push_back({std::to_string(iteration++), io::exact(record.relative_gap),
                            io::exact(record.equilibrium), io::exact(record.centring),
                            io::exact(record.step)});
  }
  return table;
}

std::string iteration_file(const shear::ShearSolution& solution) {
  return solution.is_of_newton() ? "newton.csv" : "interior_point.csv";
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;  // from KiB
}

int report(const std::string& scene, const std::vector<solve::NamedCheck>& checks) {
  solve::Verdict verdict = checks.empty() ? solve::Verdict::not_tested : solve::Verdict::right;
  for (const solve::NamedCheck& named : checks) {
    std::cout << "Jacobian check of " << scene << ", state: " << named.state << '\n';
    solve::print(std::cout, named.check);
    verdict = std::max(verdict, named.check.verdict());
  }
  const bool passed = verdict == solve::Verdict::right;
  std::cout << (passed ? "The tangent is the derivative of the residual.\n"
                : verdict == solve::Verdict::wrong
                    ? "The tangent is NOT the derivative of the residual.\n"
                    : "No verdict: a part of the tangent was " + name_of(verdict) + ".\n");
  return passed ? 0 : 1;
}

std::string outcome_line(const shear::ShearSolution& solution) {
  const std::string count =
      solve::name_of(solution.end) + " after " + std::to_string(solution.iterations());
  if (!solution.is_of_newton())
    return "interior point: " + count + " factorisations, relative duality gap " +
           io::rounded(solution.interior_point.relative_gap(), 2);
  const solve::NewtonSummary& newton = solution.newton.newton;
  return "newton: " + count + " iterations, residual " + io::rounded(newton.final_residual(), 2) +
         ", round-off floor " + io::rounded(newton.round_off_floor(), 2) +
         (solution.newton.path.empty() ? "" : ", by continuation in lambda_r") +
         (solve::is_success(solution.end)
              ? ""
              : "; the last state is of lambda_r = " + io::rounded(solution.newton.lambda_r, 3));
}

}  // namespace talus::program
