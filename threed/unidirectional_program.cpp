#include "threed/unidirectional_program.hpp"

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>

#include "common/io/options.hpp"
#include "common/program/model_choice.hpp"
#include "common/program/summary.hpp"
#include "common/program/work.hpp"
#include "common/solve/parallel.hpp"

namespace talus::threed {
namespace {

using nlohmann::json;
using oned::ShearScene;

// Which options a run uses, and the one value that only the line has a use for.
void refuse_unused(const io::CommandLine& line, const UnidirectionalProgram& options) {
  const std::string model = "--model " + options.model;
  if (!options.is_line() && options.method.method != "newton")
    throw io::UserError("--method: '" + options.method.method + "' is not for " + model +
                        "; only newton is");
  std::vector<io::Use> table = {
      {{"--penalty", "--lambda-p", "--threads"},
       !options.is_line(),
       "--model line; add --model plane or --model space"},
      {{"--line-search"},
       options.is_line(),
       model + ", which takes full steps, and searches on a way down in lambda_r only"}};
  std::ranges::copy(program::used_options(options.method, options.check_jacobian),
                    std::back_inserter(table));
  table.push_back({{"--fields", "--window"},
                   !options.is_line(),
                   "--model line, which has no fields; add --model plane or --model space"});
  io::refuse_unused(line, table);
  program::check_pictures(line, options.picture, options.plot);
}

UnidirectionalOptions solve_options(const UnidirectionalProgram& options) {
  return {{program::shear_options(options.method)}, program::penalty_of(options.penalty)};
}

oned::RunParameters run_parameters(const UnidirectionalProgram& options, json scene) {
  if (!options.is_line()) scene.update(program::as_json(program::penalty_of(options.penalty)));
  return {options.model, options.mesh, solve_options(options), scene};
}

// At a share of the elements across; as thin as it is. A solve from rest takes some twenty
// factorisations. On a line a hundred thousand elements are little.
program::Task task_at(const UnidirectionalProgram& options, double share) {
  const int across = std::max(1, static_cast<int>(share * options.mesh.elements));
  program::Task task{std::to_string(across), {}};
  constexpr int factorisations = 20;
  // Where the flow enters and leaves only its velocity along the stream is free.
  if (options.model == "plane")
    task.work = program::mixed_work({thinnest<2>.along, across, 0}, 1.6, factorisations);
  if (options.model == "space")
    task.work = program::mixed_work({thinnest<3>.along, thinnest<3>.between, across}, 5. / 3,
                                    factorisations);
  return task;
}

// What a model found: on a line, and what only the richer ones have.
struct Found {
  oned::Solution line;
  json size, results;
  std::function<io::Figure()> picture = {};  // none of a line
};

template <int Dim>
Found found_in(const ShearScene& scene, std::span<const double> across,
               const UnidirectionalOptions& options, const program::PictureOptions& drawn) {
  const auto kept = std::make_shared<UnidirectionalSolution<Dim>>(
      solve_unidirectional<Dim>(scene, across, options));
  UnidirectionalSolution<Dim>& solution = *kept;
  return {std::move(solution.line),
          {{"unknowns", solution.unknowns},
           {"condensed_unknowns", solution.condensed},
           {"factorisations", solution.factorisations},
           {"factor_entries", solution.factor_entries}},
          {{"cross_flow", solution.cross_flow},
           {"dynamic_pressure", solution.dynamic_pressure},
           {"change_along", solution.change_along}},
          [&scene, kept, options, drawn] { return picture(scene, *kept, options, drawn); }};
}

Found solve(const std::string& model, const ShearScene& scene, std::span<const double> across,
            const UnidirectionalOptions& options, const program::PictureOptions& drawn) {
  if (model == "plane") return found_in<2>(scene, across, options, drawn);
  if (model == "space") return found_in<3>(scene, across, options, drawn);
  Found found{oned::solve(scene, across, options), {}, json::object()};
  found.size["unknowns"] = found.line.velocity.size();
  return found;
}

std::vector<solve::NamedCheck> check_jacobian(const std::string& model, const ShearScene& scene,
                                              std::span<const double> across,
                                              const UnidirectionalOptions& options) {
  return model == "plane"   ? check_unidirectional<2>(scene, across, options)
         : model == "space" ? check_unidirectional<3>(scene, across, options)
                            : oned::check_jacobian(scene, across, options);
}

json summary(const ShearScene& scene, const oned::RunParameters& run, const Found& found,
             const OwnOfScene& own) {
  json all = oned::summary(scene, run, found.line);
  all.update(found.size);
  if (!solve::is_success(found.line.end)) return all;
  all["results"].update(found.results);
  if (own.measures) all["results"].update(own.measures(found.line));
  return all;
}

void print(const ShearScene& scene, const oned::RunParameters& run, const Found& found,
           const json& results) {
  std::cout << program::outcome_line(found.line) << '\n';
  if (!solve::is_success(found.line.end)) return;
  const double velocity = results["max_velocity"];
  if (scene.regime() == rheology::Regime::at_rest) {
    std::cout << "The material is at rest (" << scene.limits << ").\n";
    if (found.line.is_of_newton())
      std::cout << "The regularisation adds a creep of " << io::rounded(velocity, 4) << " = "
                << io::rounded(velocity / run.solve.lambda_r, 4) << " lambda_r.\n";
  }
  std::cout << "largest velocity " << io::rounded(velocity, 10) << " (exact "
            << io::rounded(results["exact_max_velocity"], 10) << "), error in L2 "
            << io::rounded(results["error_l2"], 3) << ", in the maximum norm "
            << io::rounded(results["error_max"], 3) << '\n';
  if (run.model == "line") return;
  std::cout << "cross-flow " << io::rounded(results["cross_flow"], 2) << ", dynamic pressure "
            << io::rounded(results["dynamic_pressure"], 2) << '\n'
            << program::hint_of_poorer_model(scene.title,
                                             run.model == "plane" ? "the plane" : "space", "a line",
                                             "--model line")
            << '\n';
}

// The summary last: where it is, the others are. Of a failed solve it says how it went, and there
// is no flow to show.
void write_files(const io::ResultFolder& folder, const ShearScene& scene,
                 const UnidirectionalProgram& options, const Found& found, const json& summary) {
  const oned::Solution& solution = found.line;
  const std::string iterations = program::iteration_file(solution);
  std::string written = " summary.json " + iterations;
  folder.write(iterations, io::to_csv(program::iteration_table(solution)));
  if (solve::is_success(solution.end)) {
    folder.write("profile.csv", io::to_csv(profile_table(scene, solution)));
    written += " profile.csv";
    const std::string label = options.is_line() ? options.method.method : options.model;
    if (options.plot) {
      std::vector<io::Figure> figures = {profile_figure(scene, {{label, &solution}})};
      if (found.picture) figures.push_back(found.picture());
      written += io::draw(folder, figures);
    }
  }
  folder.write("summary.json", summary.dump(2) + "\n");
  if (!folder.is_nowhere())
    std::cout << "results in " << folder.path().string() << ":" << written << '\n';
}

std::string advice_for(const UnidirectionalProgram& options, solve::End end) {
  return options.is_line() ? solve::advice_for(end)
                           : "check the tangent with --check-jacobian, try a larger --lambda-r or "
                             "--tangent primal-dual, or --model line";
}

}  // namespace

std::vector<std::string> files_of_line() {
  std::vector<std::string> names = io::files_of("profile");
  std::ranges::copy(io::files_of("fields"), std::back_inserter(names));
  for (const char* name : {"summary.json", "profile.csv", "newton.csv", "interior_point.csv"})
    names.emplace_back(name);
  return names;
}

void add_options(io::CommandLine& line, UnidirectionalProgram& options, const std::string& scene) {
  options.output = "results/" + scene;
  io::add_choice(line, "--model", options.model,
                 "How much of the scene is modelled: a line across, or velocity and pressure in "
                 "the plane or in space (by Newton)",
                 {"line", "plane", "space"});
  io::add_integer(line, "--elements", options.mesh.elements, "Quadratic elements across", 1,
                  100000);
  io::add_real(line, "--grading", options.mesh.grading,
               "Exponent q of the mesh x_i = L(1 - (1 - i/n)^q); 1 is uniform", 1, 10);
  program::add_method_options(line, options.method);
  program::add_penalty(line, options.penalty);
  program::add_threads(line, options.threads);
  io::add_text(line, "--output", options.output, "Folder for the results");
  io::add_flag(line, "--plot", options.plot,
               "Draw profiles, of plane and space the fields (data, gnuplot script, SVG and PNG)");
  program::add_pictures(line, options.picture);
  io::add_flag(line, "--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual");
}

int run(const io::CommandLine& line, const ShearScene& scene, const UnidirectionalProgram& options,
        const OwnOfScene& own, scene::Case& a_case) {
  refuse_unused(line, options);

  // 1. The mesh, and what is to be solved on it.
  const oned::RunParameters run = run_parameters(options, own.parameters);
  const UnidirectionalOptions method = solve_options(options);
  const std::vector<double> across = oned::boundaries(scene, run.mesh);
  program::admit(scene.name, "--elements", [&](double share) { return task_at(options, share); });
  solve::set_threads(options.threads);
  if (a_case.is_dry_run()) return 0;
  if (options.check_jacobian)
    return program::report(scene.name, check_jacobian(options.model, scene, across, method));
  const io::ResultFolder folder = a_case.folder(options.output);
  folder.remove_older(files_of_line());
  folder.remove_older(own.other_files);

  // 2. The limits of existence come first: past them a mesh can return a number all the same.
  if (scene.regime() == rheology::Regime::no_steady_state) {
    json refusal = oned::refusal(scene, run);
    a_case.complete(refusal);
    folder.write("summary.json", refusal.dump(2) + "\n");
    a_case.write(refusal);
    std::cerr << scene.name << ": no_steady_state: the load exceeds mu_2 p (" << scene.limits
              << "); " << solve::advice_for(solve::End::no_steady_state) << '\n';
    return 1;
  }

  // 3. The nonlinear solve, from rest.
  const Found found =
      a_case.timed([&] { return solve(options.model, scene, across, method, options.picture); });
  const oned::Solution& solution = found.line;

  // 4. What came out, against the exact solution, and the files.
  json results = summary(scene, run, found, own);
  a_case.complete(results);
  print(scene, run, found, results["results"]);
  if (own.remarks && solve::is_success(solution.end)) std::cout << own.remarks(results["results"]);
  write_files(folder, scene, options, found, results);
  a_case.write(results);

  // 5. The exit code says whether the numbers can be trusted.
  if (solve::is_success(solution.end)) return 0;
  std::cerr << scene.name << ": " << solve::name_of(solution.end) << ": "
            << advice_for(options, solution.end) << '\n';
  return 1;
}

}  // namespace talus::threed
