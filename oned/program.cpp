#include "oned/program.hpp"

#include <iostream>

#include "common/io/options.hpp"
#include "common/program/summary.hpp"

namespace talus::oned {
namespace {

void print_outcome(const ShearScene& scene, const Solution& solution, const nlohmann::json& summary,
                   double lambda_r) {
  std::cout << program::outcome_line(solution) << '\n';
  if (!solve::is_success(solution.end)) return;
  const double velocity = summary["results"]["max_velocity"];
  if (scene.regime() == rheology::Regime::at_rest) {
    std::cout << "The material is at rest (" << scene.limits << ").\n";
    if (solution.is_of_newton())
      std::cout << "The regularisation adds a creep of " << io::rounded(velocity, 4) << " = "
                << io::rounded(velocity / lambda_r, 4) << " lambda_r.\n";
  }
  const nlohmann::json& results = summary["results"];
  std::cout << "largest velocity " << io::rounded(velocity, 10) << " (exact "
            << io::rounded(results["exact_max_velocity"], 10) << "), error in L2 "
            << io::rounded(results["error_l2"], 3) << ", in the maximum norm "
            << io::rounded(results["error_max"], 3) << '\n';
}

// Whatever a run can leave.
std::vector<std::string> files() {
  std::vector<std::string> names = io::files_of("profile");
  for (const char* name : {"summary.json", "profile.csv", "newton.csv", "interior_point.csv"})
    names.emplace_back(name);
  return names;
}

}  // namespace

void add_options(CLI::App& app, ProgramOptions& options, const std::string& scene) {
  options.output = "results/" + scene;
  io::add_integer(app, "--elements", options.mesh.elements, "Quadratic elements", 1, 100000);
  io::add_real(app, "--grading", options.mesh.grading,
               "Exponent q of the mesh x_i = L(1 - (1 - i/n)^q); 1 is uniform", 1, 10);
  program::add_method_options(app, options.method);
  io::add_text(app, "--output", options.output, "Folder for the results");
  app.add_flag("--plot", options.plot, "Draw the profiles (data, gnuplot script, SVG and PNG)");
  app.add_flag("--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual");
}

int run(const CLI::App& app, const ShearScene& scene, const ProgramOptions& options,
        const nlohmann::json& parameters) {
  io::refuse_unused(app, program::used_options(options.method, options.check_jacobian));

  // 1. The mesh, and what is to be solved on it.
  const RunParameters run{options.mesh, {program::shear_options(options.method)}, parameters};
  const std::vector<double> line = boundaries(scene, run.mesh);
  if (options.check_jacobian)
    return program::report(scene.name, check_jacobian(scene, line, run.solve));
  const io::ResultFolder folder(options.output);
  folder.remove_older(files());

  // 2. The limits of existence come first: past them a mesh can return a number all the same.
  if (scene.regime() == rheology::Regime::no_steady_state) {
    folder.write("summary.json", refusal(scene, run).dump(2) + "\n");
    std::cerr << scene.name << ": no_steady_state: the load exceeds mu_2 p (" << scene.limits
              << "); " << solve::advice_for(solve::End::no_steady_state) << '\n';
    return 1;
  }

  // 3. The nonlinear solve, from rest.
  const Solution solution = solve(scene, line, run.solve);
  const bool is_solved = solve::is_success(solution.end);

  // 4. What came out, against the exact solution.
  const nlohmann::json results = summary(scene, run, solution);
  print_outcome(scene, solution, results, run.solve.lambda_r);

  // 5. The files, the summary last: where it is, the others are. Of a failed solve it says how it
  // went, and there is no flow to show.
  const std::string iterations = program::iteration_file(solution);
  std::string written = " summary.json " + iterations;
  folder.write(iterations, io::to_csv(program::iteration_table(solution)));
  if (is_solved) {
    folder.write("profile.csv", io::to_csv(profile_table(scene, solution)));
    written += " profile.csv";
    if (options.plot)
      written += io::draw(folder, {profile_figure(scene, {{options.method.method, &solution}})});
  }
  folder.write("summary.json", results.dump(2) + "\n");
  std::cout << "results in " << folder.path().string() << ":" << written << '\n';

  // 6. The exit code says whether the numbers can be trusted.
  if (is_solved) return 0;
  std::cerr << scene.name << ": " << solve::name_of(solution.end) << ": "
            << solve::advice_for(solution.end) << '\n';
  return 1;
}

}  // namespace talus::oned
