#include "oned/program.hpp"

#include <iostream>
#include <sstream>

#include "common/io/options.hpp"

namespace talus::oned {
namespace {

std::vector<std::string> names_of_regularisations() {
  std::vector<std::string> names;
  for (const auto& each : rheology::regularisations()) names.push_back(rheology::name_of(each));
  return names;
}

SolveOptions solve_options(const ProgramOptions& options) {
  SolveOptions result;
  result.method = options.method == "newton" ? Method::newton : Method::interior_point;
  result.regularisation = *rheology::regularisation_named(options.regularisation);
  result.lambda_r = options.lambda_r;
  result.continuation = !options.no_continuation;
  result.precision =
      options.precision == "plain" ? solve::Precision::plain : solve::Precision::compensated;
  result.newton.line_search =
      options.line_search == "none" ? solve::LineSearch::none : solve::LineSearch::energy_slope;
  result.tangent_term = options.tangent == "full"     ? flow::TangentTerm::full
                        : options.tangent == "frozen" ? flow::TangentTerm::frozen
                                                      : flow::TangentTerm::wrong_sign;
  if (options.tolerance > 0)
    result.newton.tolerance = result.interior_point.tolerance = options.tolerance;
  if (options.max_iterations > 0)
    result.newton.max_iterations = result.interior_point.max_factorisations =
        options.max_iterations;
  return result;
}

int print_jacobian_check(const ShearScene& scene, const std::vector<double>& line,
                         const SolveOptions& options) {
  bool passed = true;
  for (const NamedCheck& named : check_jacobian(scene, line, options)) {
    std::cout << "Jacobian check of " << scene.name << ", state: " << named.state << '\n';
    solve::print(std::cout, named.check);
    passed = passed && named.check.passed();
  }
  std::cout << (passed ? "The tangent is the derivative of the residual.\n"
                       : "The tangent is NOT the derivative of the residual.\n");
  return passed ? 0 : 1;
}

void print_outcome(const ShearScene& scene, const Solution& solution, Method method,
                   const nlohmann::json& summary, double lambda_r) {
  const double velocity = summary["results"]["max_velocity"];
  if (method == Method::newton)
    std::cout << "newton: " << solve::name_of(solution.end) << " after " << solution.iterations()
              << " iterations, residual " << io::rounded(solution.newton.newton.final_residual(), 2)
              << ", round-off floor " << io::rounded(solution.newton.newton.round_off_floor(), 2)
              << (solution.newton.path.empty() ? "" : ", by continuation in lambda_r") << '\n';
  else
    std::cout << "interior point: " << solve::name_of(solution.end) << " after "
              << solution.iterations() << " factorisations, relative duality gap "
              << io::rounded(solution.interior_point.relative_gap(), 2) << '\n';
  if (scene.regime() == rheology::Regime::at_rest) {
    std::cout << "The material is at rest (" << scene.limits << ").\n";
    if (method == Method::newton)
      std::cout << "The regularisation adds a creep of " << io::rounded(velocity, 4) << " = "
                << io::rounded(velocity / lambda_r, 4) << " lambda_r.\n";
  }
  const nlohmann::json& results = summary["results"];
  std::cout << "largest velocity " << io::rounded(velocity, 10) << " (exact "
            << io::rounded(results["exact_max_velocity"], 10) << "), error in L2 "
            << io::rounded(results["error_l2"], 3) << ", in the maximum norm "
            << io::rounded(results["error_max"], 3) << '\n';
}

}  // namespace

void add_options(CLI::App& app, ProgramOptions& options, const std::string& scene) {
  options.output = "results/" + scene;
  io::add_integer(app, "--elements", options.mesh.elements, "Quadratic elements", 1, 100000);
  io::add_real(app, "--grading", options.mesh.grading,
               "Exponent q of the mesh x_i = L(1 - (1 - i/n)^q); 1 is uniform", 1, 10);
  io::add_choice(app, "--method", options.method,
                 "Newton on the regularised law, or interior point without regularisation",
                 {"newton", "interior-point"});
  io::add_choice(app, "--regularisation", options.regularisation, "Viscosity, eq. (9)-(12)",
                 names_of_regularisations());
  io::add_real(app, "--lambda-r", options.lambda_r, "Regularisation parameter, in sqrt(g/d)", 1e-15,
               1);
  app.add_option("--friction", options.friction,
                 "Friction law mu_s,delta_mu,I0 [each 0.001 ... 10; default 0.383,0.26,0.279]");
  io::add_choice(app, "--precision", options.precision,
                 "Of Newton's iterate: double, or double with its rounding kept",
                 {"compensated", "plain"});
  io::add_choice(app, "--line-search", options.line_search, "Of Newton", {"energy-slope", "none"});
  io::add_choice(app, "--tangent", options.tangent,
                 "Derivative of the viscosity in the tangent: kept, dropped, or broken",
                 {"full", "frozen", "wrong-sign"});
  io::add_real(app, "--tolerance", options.tolerance,
               "Relative residual (default 1e-12) or duality gap (default 1e-10)", 1e-16, 0.1)
      ->default_str("");
  io::add_integer(app, "--max-iterations", options.max_iterations,
                  "Of Newton (default 200) or of the interior point (default 100)", 1, 100000)
      ->default_str("");
  app.add_flag("--no-continuation", options.no_continuation,
               "Do not fall back to continuation in lambda_r when Newton fails");
  app.add_option("--output", options.output, "Folder for the results")->capture_default_str();
  app.add_flag("--plot", options.plot, "Draw the profiles (data, gnuplot script, SVG and PNG)");
  app.add_flag("--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual");
}

rheology::FrictionLaw friction_law(const ProgramOptions& options) {
  rheology::FrictionLaw law;
  if (options.friction.empty()) return law;
  std::vector<double> numbers;
  std::istringstream parts(options.friction);
  for (std::string part; std::getline(parts, part, ',');)
    numbers.push_back(io::real_in_range("--friction", part, 1e-3, 10));
  if (numbers.size() != 3)
    throw io::UserError("--friction: '" + options.friction +
                        "' is not three numbers mu_s,delta_mu,I0, each 0.001 ... 10");
  law.mu_s = numbers[0];
  law.delta_mu = numbers[1];
  law.I0 = numbers[2];
  return law;
}

int run(const ShearScene& scene, const ProgramOptions& options, const nlohmann::json& parameters) {
  // 1. The mesh, and what is to be solved on it.
  RunParameters run{options.mesh, solve_options(options), parameters};
  if (!options.align.empty()) run.mesh.align = io::real_in_range("--align", options.align, 0, 0.99);
  const std::vector<double> line = boundaries(scene, run.mesh);
  if (options.check_jacobian) return print_jacobian_check(scene, line, run.solve);
  const io::ResultFolder folder(options.output);

  // 2. The limits of existence come first: past them a mesh can return a number all the same.
  if (scene.regime() == rheology::Regime::no_steady_state) {
    folder.write("summary.json", refusal(scene, run).dump(2) + "\n");
    std::cerr << scene.name << ": no_steady_state: the load exceeds mu_2 p (" << scene.limits
              << "); " << solve::advice_for(solve::End::no_steady_state) << '\n';
    return 1;
  }

  // 3. The nonlinear solve, from rest.
  const Solution solution = solve(scene, line, run.solve);

  // 4. What came out, against the exact solution.
  const nlohmann::json results = summary(scene, run, solution);
  print_outcome(scene, solution, run.solve.method, results, run.solve.lambda_r);

  // 5. The files.
  const std::string iterations =
      run.solve.method == Method::newton ? "newton.csv" : "interior_point.csv";
  folder.write("summary.json", results.dump(2) + "\n");
  folder.write("profile.csv", io::to_csv(profile_table(scene, solution)));
  folder.write(iterations, io::to_csv(iteration_table(solution)));
  std::cout << "results in " << folder.path().string() << ": summary.json profile.csv "
            << iterations;
  if (options.plot) {
    const io::Figure figure = profile_figure(scene, {{options.method, &solution}});
    const bool drawn =
        io::write_figure(folder, figure, "png") && io::write_figure(folder, figure, "svg");
    std::cout << (drawn ? " profile.svg profile.png" : " (no figure: gnuplot is missing)");
  }
  std::cout << '\n';

  // 6. The exit code says whether the numbers can be trusted.
  if (solve::is_success(solution.end)) return 0;
  std::cerr << scene.name << ": " << solve::name_of(solution.end) << ": "
            << solve::advice_for(solution.end) << '\n';
  return 1;
}

}  // namespace talus::oned
