// Flow on a heap between rough side walls, as the smallest model that holds it: its cross-section.
//
// Sample runs (the test suite runs them):
//   heap --elements 18x25 --angle 0.42
//   heap --elements 14x20 --flow-rate 39.71 --plot
//   heap --elements 14x20 --method newton --lambda-r 1e-6 --grading-to-wall 2
//   heap --elements 14x20 --wall friction
//   heap --elements 3x4 --method newton --wall friction --check-jacobian
#include <iostream>
#include <stdexcept>

#include "common/io/options.hpp"
#include "common/program/method_options.hpp"
#include "common/program/summary.hpp"
#include "twod/flow_rate_search.hpp"
#include "twod/section_report.hpp"

using namespace talus;

namespace {

struct Options {
  twod::Section section;
  twod::SectionMesh mesh;
  program::MethodOptions method;
  std::string model = "section", wall = "no-slip", elements = "70x100", output = "results/heap";
  double flow_rate = 0;  // 0: the angle is given instead
  bool plot = false, check_jacobian = false;
};

// "70x100": elements across and up.
void read_elements(Options& options) {
  const std::string& text = options.elements;
  const std::size_t cross = text.find('x');
  try {
    if (cross == std::string::npos) throw io::UserError("no x");
    options.mesh.across = io::whole_in_range("--elements", text.substr(0, cross), 1, 2000);
    options.mesh.up = io::whole_in_range("--elements", text.substr(cross + 1), 1, 2000);
  } catch (const io::UserError&) {
    throw io::UserError("--elements: '" + text +
                        "' is not ACROSSxUP, two whole numbers of 1 ... 2000 such as 70x100");
  }
}

nlohmann::json parameters(const Options& options, const flow::ShearOptions& method) {
  nlohmann::json all = {{"width", options.section.width},
                        {"height", options.section.height},
                        {"wall", options.wall},
                        {"elements", {options.mesh.across, options.mesh.up}},
                        {"grading_to_wall", options.mesh.grading_to_wall},
                        {"grading_to_surface", options.mesh.grading_to_surface},
                        {"friction", program::as_json(options.section.law)}};
  if (options.flow_rate > 0)
    all["flow_rate"] = options.flow_rate;
  else
    all["angle"] = options.section.angle;
  all.update(program::as_json(method));
  return all;
}

int run(Options& options) {
  // 1. The mesh of half the section.
  read_elements(options);
  options.section.law = program::friction_law(options.method);
  options.section.wall = options.wall == "friction" ? twod::Wall::friction : twod::Wall::no_slip;
  const flow::ShearOptions method = program::shear_options(options.method, twod::default_options());
  flow::CrossSection<2> space = twod::space_of(options.section, options.mesh);
  if (options.check_jacobian)
    return program::report("heap",
                           flow::check_jacobian(space, twod::load_of(options.section), method));
  const io::ResultFolder folder(options.output);

  nlohmann::json results = {
      {"scene", "heap"}, {"model", options.model}, {"parameters", parameters(options, method)}};

  // 2. The limits of existence come first.
  if (twod::regime(options.section) == rheology::Regime::no_steady_state) {
    results["status"] = solve::name_of(solve::End::no_steady_state);
    results["results"] = nlohmann::json::object();
    folder.write("summary.json", results.dump(2) + "\n");
    std::cerr << "heap: no_steady_state: no steady flow for angle >= "
              << io::rounded(std::atan(options.section.law.mu_2()), 6) << "; "
              << solve::advice_for(solve::End::no_steady_state) << '\n';
    return 1;
  }

  // 3. The solve, at the given angle or at the one that carries the given flow rate.
  const twod::SectionSolution solution =
      options.flow_rate > 0 ? twod::solve_for_flow_rate(options.flow_rate, options.section,
                                                        options.mesh, space, method)
                            : twod::solve(options.section, space, method);

  // 4. What came out.
  results.update(twod::summary(solution, space));
  std::cout << program::outcome_line(solution) << '\n'
            << "flow rate Q* = " << io::rounded(results["results"]["flow_rate"], 10)
            << " at an angle of " << io::rounded(solution.section.angle, 10)
            << ", surface velocity " << io::rounded(results["results"]["surface_velocity"], 7)
            << '\n';
  if (solution.interior_point.at_rest) std::cout << "The material is at rest.\n";

  // 5. The files.
  folder.write("summary.json", results.dump(2) + "\n");
  folder.write("surface.csv", io::to_csv(twod::surface_table(solution, space)));
  folder.write(program::iteration_file(solution), io::to_csv(program::iteration_table(solution)));
  folder.write("section.vtu", io::to_vtu(twod::grid(solution, space)));
  std::cout << "results in " << folder.path().string() << ": summary.json surface.csv section.vtu "
            << program::iteration_file(solution);
  if (options.plot) {
    const io::Figure figure = twod::figure(solution, space);
    const bool drawn =
        io::write_figure(folder, figure, "png") && io::write_figure(folder, figure, "svg");
    std::cout << (drawn ? " section.svg section.png" : " (no figure: gnuplot is missing)");
  }
  std::cout << '\n';
  if (solve::is_success(solution.end)) return 0;
  std::cerr << "heap: " << solve::name_of(solution.end) << ": " << solve::advice_for(solution.end)
            << '\n';
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Dense granular flow on a heap between side walls", "heap"};
  Options options;
  options.method.method = "interior-point";
  options.method.tangent = "primal-dual";
  options.method.lambda_r = twod::default_options().lambda_r;
  io::add_choice(app, "--model", options.model, "How much of the scene is modelled", {"section"});
  CLI::Option* angle =
      io::add_real(app, "--angle", options.section.angle, "Inclination α, in radians", 1e-3, 1.57);
  io::add_real(app, "--flow-rate", options.flow_rate,
               "Find the angle with this flow rate Q* instead", 1e-6, 1e6)
      ->default_str("")
      ->excludes(angle);
  io::add_choice(app, "--wall", options.wall,
                 "Side wall: without slip, or with friction mu_2 p where it slips",
                 {"no-slip", "friction"});
  app.add_option("--elements", options.elements, "Elements ACROSSxUP of half the section")
      ->capture_default_str();
  io::add_real(app, "--grading-to-wall", options.mesh.grading_to_wall,
               "Exponent of the mesh towards the side wall; 1 is uniform", 1, 10);
  io::add_real(app, "--grading-to-surface", options.mesh.grading_to_surface,
               "Exponent of the mesh towards the free surface; 1 is uniform", 1, 10);
  io::add_real(app, "--width", options.section.width, "Width of the channel W, in d", 1e-3, 1e6);
  io::add_real(app, "--height", options.section.height, "Depth H, in d", 1e-3, 1e6);
  program::add_method_options(app, options.method);
  app.add_option("--output", options.output, "Folder for the results")->capture_default_str();
  app.add_flag("--plot", options.plot, "Draw the profiles (data, gnuplot script, SVG and PNG)");
  app.add_flag("--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual (take few elements)");
  return io::run_program(app, argc, argv, [&] { return run(options); });
}
