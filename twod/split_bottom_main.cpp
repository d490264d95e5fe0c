// The shear zone in a cell whose bottom is split: a disc that rests, and around it a ring that
// turns with the outer wall.
//
// Sample runs (the test suite runs them):
//   split-bottom --elements 20
//   split-bottom --height 0.7 --elements 20 --plot
//   split-bottom --height 0.2 --rate 0.1 --elements 20 --method newton
//   split-bottom --elements 4 --check-jacobian
//   split-bottom --elements 4 --method newton --check-jacobian
#include <iostream>

#include "common/io/options.hpp"
#include "common/program/grading.hpp"
#include "common/program/method_options.hpp"
#include "common/program/summary.hpp"
#include "common/program/work.hpp"
#include "common/scene/case.hpp"
#include "twod/split_bottom_report.hpp"

using namespace talus;

namespace {

struct Options {
  twod::SplitBottom cell;
  twod::SplitBottomMesh mesh;
  program::MethodOptions method;
  std::string output = "results/split-bottom";
  bool plot = false, check_jacobian = false;
};

void add_options(io::CommandLine& line, Options& options) {
  options.method.method = "interior-point";
  options.method.tangent = "primal-dual";
  options.method.lambda_r = twod::default_options(options.cell).lambda_r;
  io::add_real(line, "--height", options.cell.height, "Height H of the layer, in Rs", 0.01, 2);
  io::add_real(line, "--outer-radius", options.cell.outer_radius,
               "Radius Ro of the outer wall, in Rs", 1.01, 10);
  io::add_real(line, "--rate", options.cell.rate, "Rate of rotation d* Ω, in sqrt(g/Rs)", 1e-9, 1);
  io::add_integer(line, "--elements", options.mesh.elements,
                  "Quadratic elements along a radius of the split, in proportion elsewhere", 2,
                  1000);
  io::add_real(line, "--grading", options.mesh.grading,
               "Exponent of the mesh towards the split; 1 is uniform", 1, 10);
  program::add_method_options(line, options.method);
  io::add_text(line, "--output", options.output, "Folder for the results");
  io::add_flag(line, "--plot", options.plot,
               "Draw the zone and the surface (data, gnuplot script, SVG and PNG)");
  io::add_flag(line, "--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual (take few elements)");
}

shear::ShearOptions shear_options(const io::CommandLine& line, const Options& options) {
  program::MethodOptions method = options.method;
  const shear::ShearOptions defaults = twod::default_options(options.cell);
  if (!line.is_given("--lambda-r")) method.lambda_r = defaults.lambda_r;  // goes with the rate
  return program::shear_options(method, defaults);
}

void admit(const Options& options) {
  const bool is_interior_point = options.method.method == "interior-point";
  program::admit("split-bottom", "--elements", [&](double share) {
    const int n = std::max(2, static_cast<int>(share * options.mesh.elements));
    const auto along = [&](double length) {
      return std::max(1, static_cast<int>(std::lround(n * length)));
    };
    return program::Task{std::to_string(n), program::section_work({along(options.cell.outer_radius),
                                                                   along(options.cell.height)},
                                                                  is_interior_point, 40)};
  });
}

std::vector<std::string> files() {
  std::vector<std::string> names = io::files_of("zone");
  for (const char* name :
       {"summary.json", "zone.csv", "surface.csv", "newton.csv", "interior_point.csv"})
    names.emplace_back(name);
  return names;
}

void print(const twod::SplitBottomSolution& solution, const nlohmann::json& results) {
  std::cout << program::outcome_line(solution) << '\n';
  if (!solve::is_success(solution.end)) return;
  const auto with_curve = [&](const char* name, const char* of_curve) {
    return (results.contains(name) ? io::rounded(results[name], 7) : "none") +
           (results.contains(of_curve)
                ? " (curve of least resistance " + io::rounded(results[of_curve], 7) + ")"
                : "");
  };
  std::cout << "zone at the surface at " << with_curve("zone_radius", "least_resistance_radius")
            << "\ntorque integral " << with_curve("torque_integral", "least_resistance_integral")
            << ", the middle of the surface turns with "
            << io::rounded(results["turning_centre"], 3) << " Ω\n";
}

void write_files(const io::ResultFolder& folder, const Options& options,
                 const twod::SplitBottomSolution& solution, const shear::CrossSection<2>& space,
                 const nlohmann::json& summary) {
  const std::string iterations = program::iteration_file(solution);
  std::string written = " summary.json " + iterations;
  folder.write(iterations, io::to_csv(program::iteration_table(solution)));
  if (solve::is_success(solution.end)) {
    folder.write("zone.csv", io::to_csv(zone_table(solution, space)));
    folder.write("surface.csv", io::to_csv(surface_table(solution, space)));
    written += " zone.csv surface.csv";
    if (options.plot) written += io::draw(folder, {figure(solution, space)});
  }
  folder.write("summary.json", summary.dump(2) + "\n");
  if (!folder.is_nowhere())
    std::cout << "results in " << folder.path().string() << ":" << written << '\n';
}

int run(const io::CommandLine& line, Options& options, scene::Case& a_case) {
  // 1. What the options mean together.
  io::refuse_unused(line, program::used_options(options.method, options.check_jacobian));
  program::check_grading("--grading", options.mesh.grading, options.mesh.elements);
  options.cell.law = program::friction_law(options.method);
  admit(options);
  if (a_case.is_dry_run()) return 0;
  const shear::ShearOptions method = shear_options(line, options);
  shear::CrossSection<2> space = twod::space_of(options.cell, options.mesh);
  if (options.check_jacobian)
    return program::report("split-bottom",
                           shear::check_jacobian(space, twod::load_of(options.cell), method));
  const io::ResultFolder folder = a_case.folder(options.output);
  folder.remove_older(files());

  // 2. The solve. A cell that is driven by its walls flows at any rate.
  const twod::SplitBottomSolution solution =
      a_case.timed([&] { return twod::solve(options.cell, space, method); });

  // 3. What came out, and the files.
  nlohmann::json results = {{"scene", "split-bottom"},
                            {"model", "section"},
                            {"parameters",
                             {{"height", options.cell.height},
                              {"outer_radius", options.cell.outer_radius},
                              {"rate", options.cell.rate},
                              {"grading", options.mesh.grading},
                              {"friction", program::as_json(options.cell.law)}}},
                            {"elements", space.element_count()},
                            {"element_size", 1. / options.mesh.elements},
                            {"unknowns", space.node_count()}};
  results["parameters"].update(program::as_json(method));
  results.update(summary(solution, space));
  a_case.complete(results);
  print(solution, results["results"]);
  write_files(folder, options, solution, space, results);
  a_case.write(results);
  if (solve::is_success(solution.end)) return 0;
  std::cerr << "split-bottom: " << solve::name_of(solution.end) << ": "
            << (options.mesh.grading > 1  ? "try a smaller --grading"
                : solution.is_of_newton() ? solve::advice_for(solution.end)
                                          : "try --method newton, or more --max-iterations")
            << '\n';
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{"Dense granular flow in a split-bottom cell", "split-bottom"};
  Options options;
  add_options(line, options);
  scene::Case a_case(line, twod::split_bottom_description());
  return a_case.run_program(argc, argv, [&] { return run(line, options, a_case); });
}
