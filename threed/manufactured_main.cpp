// Manufactured flows: velocity and pressure are prescribed as smooth functions, with the body force
// that makes them a solution in the law that is asked for. The answer is known, on any mesh.
//
// Sample runs (the test suite runs them):
//   manufactured --elements 12 --plot
//   manufactured --flow turning --mesh sector --elements 8 --regularisation barker-gray
//   manufactured --mesh distorted --elements 8 --penalty plain --lambda-p 1e-4 --no-inertia
//   manufactured --model space --mesh distorted --elements 3 --tangent primal-dual --threads 2
//   manufactured --model space --elements 2 --check-jacobian
#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/io/options.hpp"
#include "common/program/flow_picture.hpp"
#include "common/program/method_options.hpp"
#include "common/program/penalty_options.hpp"
#include "common/program/summary.hpp"
#include "common/program/work.hpp"
#include "common/scene/case.hpp"
#include "common/solve/parallel.hpp"
#include "threed/manufactured.hpp"

using namespace talus;

namespace {

struct Options {
  std::string model = "plane", flow = "sheared", mesh = "uniform";
  std::string regularisation = "chauchat-medale", friction, method = "newton", tangent = "full";
  std::string output = "results/manufactured";
  program::PenaltyOptions penalty;
  program::PictureOptions picture;
  double lambda_r = 0;   // 0: the flow's own
  double tolerance = 0;  // 0: Newton's own default
  int elements = 16, max_iterations = 200, threads = 1;
  bool no_inertia = false, plot = false, check_jacobian = false;
};

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& each : all) names.push_back(each.name);
  return names;
}

template <int Dim>
threed::ManufacturedCase<Dim> case_of(const Options& options) {
  const auto& flows = mixed::manufactured_flows<Dim>();
  threed::ManufacturedCase<Dim> manufactured{
      *std::ranges::find(flows, options.flow, &mixed::ManufacturedFlow<Dim>::name),
      *rheology::regularisation_named(options.regularisation), options.no_inertia ? 0. : 1.};
  if (options.lambda_r > 0) manufactured.exact.lambda_r = options.lambda_r;
  manufactured.law = program::friction_law(options.friction);
  return manufactured;
}

template <int Dim>
const threed::MeshFamily<Dim>& family_of(const Options& options) {
  const auto& families = threed::mesh_families<Dim>();
  const auto found = std::ranges::find(families, options.mesh, &threed::MeshFamily<Dim>::name);
  if (found == families.end())
    throw io::UserError("--mesh: '" + options.mesh + "' is not for --model " + options.model +
                        "; uniform, stretched and distorted are");
  return *found;
}

threed::ManufacturedOptions solve_options(const Options& options) {
  threed::ManufacturedOptions all;
  all.penalty = program::penalty_of(options.penalty);
  all.tangent = program::tangent_named(options.tangent);
  all.newton.max_iterations = options.max_iterations;
  if (options.tolerance > 0) all.newton.tolerance = all.newton.distance = options.tolerance;
  return all;
}

// From the exact flow interpolated Newton takes some ten steps.
program::Task task_at(const Options& options, double share) {
  const int n = std::max(1, static_cast<int>(share * options.elements));
  const bool is_plane = options.model == "plane";
  return {std::to_string(n), program::mixed_work({n, n, is_plane ? 0 : n}, is_plane ? 2 : 3, 10)};
}

template <int Dim>
nlohmann::json parameters(const Options& options,
                          const threed::ManufacturedCase<Dim>& manufactured) {
  const threed::ManufacturedOptions method = solve_options(options);
  nlohmann::json all = {{"flow", options.flow},
                        {"mesh", options.mesh},
                        {"elements", options.elements},
                        {"regularisation", options.regularisation},
                        {"lambda_r", manufactured.exact.lambda_r},
                        {"inertia", !options.no_inertia},
                        {"friction", program::as_json(manufactured.law)},
                        {"tangent", options.tangent},
                        {"tolerance", method.newton.tolerance}};
  all.update(program::as_json(method.penalty));
  return all;
}

nlohmann::json results_of(const mixed::FlowErrors& errors) {
  return {{"error_velocity_l2", errors.velocity},
          {"error_velocity_h1", errors.gradient},
          {"error_pressure_l2", errors.pressure},
          {"divergence", errors.divergence}};
}

void print(const shear::ShearSolution& record, const mixed::FlowErrors& errors) {
  std::cout << program::outcome_line(record) << '\n';
  if (!solve::is_success(record.end)) return;
  std::cout << "errors in L2: velocity " << io::rounded(errors.velocity, 4) << ", its gradient "
            << io::rounded(errors.gradient, 4) << ", pressure " << io::rounded(errors.pressure, 4)
            << "; divergence " << io::rounded(errors.divergence, 4) << '\n';
}

io::Figure picture(const threed::ManufacturedCase<2>& manufactured,
                   const threed::SolvedManufactured<2>& solution, const Options& options) {
  const auto flow = threed::problem_of(manufactured, *solution.space, solve_options(options));
  const std::string title = "manufactured, " + options.flow + ", " + options.mesh + " mesh, " +
                            std::to_string(options.elements) + " elements along an edge, " +
                            options.regularisation +
                            ", λr = " + io::rounded(manufactured.exact.lambda_r);
  return program::picture(program::surface_of(flow, solution.state), manufactured.law,
                          {.name = "fields", .title = title, .caption = title, .x = "x", .y = "y"},
                          options.picture);
}

template <int Dim>
int run(const Options& options, scene::Case& a_case) {
  // 1. The flow, the law and the mesh.
  const auto manufactured = case_of<Dim>(options);
  const auto& family = family_of<Dim>(options);
  const threed::ManufacturedOptions method = solve_options(options);
  program::admit("manufactured", "--elements",
                 [&](double share) { return task_at(options, share); });
  solve::set_threads(options.threads);
  if (a_case.is_dry_run()) return 0;
  if (options.check_jacobian)
    return program::report(
        "manufactured", threed::check_manufactured(manufactured, family, options.elements, method));
  const io::ResultFolder folder = a_case.folder(options.output);
  std::vector<std::string> files = io::files_of("fields");
  files.insert(files.end(), {"summary.json", "newton.csv"});
  folder.remove_older(files);

  // 2. The nonlinear solve, from the exact flow.
  const auto solution = a_case.timed(
      [&] { return threed::solve_manufactured(manufactured, family, options.elements, method); });
  shear::ShearSolution record;
  record.newton = {solution.newton, {}, manufactured.exact.lambda_r};
  record.end = solution.newton.end;
  record.seconds = solution.seconds;
  const bool is_solved = solve::is_success(record.end);

  // 3. What came out, and the files: the summary last, where it is, the others are.
  nlohmann::json summary = {{"scene", "manufactured"},
                            {"model", options.model},
                            {"parameters", parameters(options, manufactured)}};
  program::add_outcome(summary, record);
  summary["elements"] = static_cast<int>(std::pow(options.elements, Dim));
  summary["element_size"] = 1. / options.elements;  // of an edge
  summary["unknowns"] = solution.unknowns;
  summary["condensed_unknowns"] = solution.condensed;
  summary["factorisations"] = solution.factorisations;
  summary["factor_entries"] = solution.factor_entries;
  summary["results"] = is_solved ? results_of(solution.errors) : nlohmann::json::object();
  a_case.complete(summary);
  print(record, solution.errors);
  folder.write("newton.csv", io::to_csv(program::iteration_table(record)));
  std::string written = " summary.json newton.csv";
  if constexpr (Dim == 2)
    if (options.plot && is_solved)
      written += io::draw(folder, {picture(manufactured, solution, options)});
  folder.write("summary.json", summary.dump(2) + "\n");
  a_case.write(summary);
  if (!folder.is_nowhere())
    std::cout << "results in " << folder.path().string() << ":" << written << '\n';

  // 4. The exit code says whether the numbers can be trusted.
  if (is_solved) return 0;
  std::cerr << "manufactured: " << solve::name_of(record.end)
            << ": check the tangent with --check-jacobian, try a larger --lambda-r, more "
               "--elements or --tangent primal-dual\n";
  return 1;
}

const scene::Description& description() {
  static const scene::Description manufactured{
      .name = "manufactured",
      .title = "manufactured flows",
      .models = {"plane", "space"},
      .mesh_option = "--elements",
      .problem_options = {"--flow", "--regularisation", "--lambda-r", "--friction", "--no-inertia"},
      .main_quantity = "divergence",
      .main_error = "error_velocity_l2",
      .quantities = {{"error_velocity_l2", "1", "error of the velocity in L2"},
                     {"error_velocity_h1", "1", "error of the velocity gradient in L2"},
                     {"error_pressure_l2", "1", "error of the pressure in L2"},
                     {"divergence", "1", "of the velocity, in L2"}}};
  return manufactured;
}

void add_options(io::CommandLine& line, Options& o) {
  io::add_choice(line, "--model", o.model, "In the plane or in space", {"plane", "space"});
  io::add_choice(line, "--flow", o.flow, "Sheared everywhere, or turning with little shear inside",
                 names_of(mixed::manufactured_flows<2>()));
  io::add_choice(line, "--mesh", o.mesh,
                 "Square or cube of uniform, stretched or distorted elements, or in the plane a "
                 "sector of an annulus",
                 names_of(threed::mesh_families<2>()));
  io::add_integer(line, "--elements", o.elements, "Elements along an edge", 1, 2000);
  program::add_regularisation(line, o.regularisation);
  io::add_real(line, "--lambda-r", o.lambda_r,
               "Regularisation parameter; default 0.001 (sheared), 0.5 (turning)", 1e-15, 1)
      .without_default();
  program::add_friction(line, o.friction);
  io::add_flag(line, "--no-inertia", o.no_inertia, "Leave out the advective term");
  program::add_penalty(line, o.penalty);
  program::add_newton(line, o.method);
  program::add_tangent(line, o.tangent);
  io::add_real(line, "--tolerance", o.tolerance,
               "Of Newton's answer: relative residual and distance to the solution (default 1e-12)",
               1e-16, 1e-3)
      .without_default();
  io::add_integer(line, "--max-iterations", o.max_iterations, "Of Newton", 1, 100000);
  program::add_threads(line, o.threads);
  io::add_text(line, "--output", o.output, "Folder for the results");
  io::add_flag(line, "--plot", o.plot,
               "Draw the fields of a plane flow (data, gnuplot script, SVG and PNG)");
  program::add_pictures(line, o.picture);
  io::add_flag(line, "--check-jacobian", o.check_jacobian,
               "Only compare the tangent with differences of the residual (take few elements)");
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{"Manufactured dense granular flows in velocity and pressure",
                       "manufactured"};
  Options options;
  add_options(line, options);
  scene::Case a_case(line, description());
  return a_case.run_program(argc, argv, [&] {
    io::refuse_unused(line, {{{"--tolerance", "--max-iterations", "--output", "--plot"},
                              !options.check_jacobian,
                              "--check-jacobian"},
                             {{"--plot"}, options.model == "plane", "--model space"}});
    program::check_pictures(line, options.picture, options.plot);
    return options.model == "plane" ? run<2>(options, a_case) : run<3>(options, a_case);
  });
}
