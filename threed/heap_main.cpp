// Flow on a heap between rough side walls: as the smallest model that holds it, its cross-section,
// or in three dimensions as the paper solves it.
//
// Sample runs (the test suite runs them):
//   heap --elements 18x25 --angle 0.42
//   heap --elements 14x20 --flow-rate 39.71 --plot
//   heap --elements 14x20 --method newton --lambda-r 1e-6 --grading-to-wall 2
//   heap --elements 18x16 --method newton --start nested
//   heap --elements 14x20 --wall friction
//   heap --elements 3x4 --method newton --wall friction --check-jacobian
//   heap --model 3d --elements 1x16x16 --angle 0.42
//   heap --model 3d --elements 1x7x10 --flow-rate 39.71 --start section --plot
//   heap --model 3d --elements 2x7x10 --start rest
//   heap --model 3d --elements 2x7x10 --outflow open
//   heap --model 3d --elements 1x2x2 --lambda-r 1e-4 --check-jacobian
#include <iostream>
#include <optional>

#include "common/flow/dense_jacobian.hpp"
#include "common/io/options.hpp"
#include "common/program/method_options.hpp"
#include "common/program/summary.hpp"
#include "common/solve/stopwatch.hpp"
#include "threed/heap_report.hpp"
#include "twod/flow_rate_search.hpp"
#include "twod/section_report.hpp"

using namespace talus;

namespace {

struct Options {
  twod::Section section;
  threed::HeapMesh mesh;
  program::MethodOptions method;
  std::string model = "section", wall = "no-slip", elements = "70x100", output = "results/heap";
  std::string start = "rest", outflow = "fully-developed";
  double flow_rate = 0;  // 0: the angle is given instead
  bool plot = false, check_jacobian = false;

  bool is_3d() const { return model == "3d"; }
};

// Options that one of the models has no use for.
void refuse_options_of_the_other_model(const CLI::App& app, Options& options) {
  const auto refuse = [&](const char* name, const std::string& allowed) {
    if (app.count(name) > 0)
      throw io::UserError(std::string(name) + ": '" + app.get_option(name)->as<std::string>() +
                          "' is not for --model " + options.model + "; " + allowed);
  };
  if (!options.is_3d()) {
    refuse("--outflow", "it takes --model 3d");
    if (options.start == "section") refuse("--start", "rest and nested are");
    if (options.method.method != "newton") refuse("--start", "it takes --method newton");
    return;
  }
  if (options.method.method != "newton") refuse("--method", "only newton is");
  options.method.method = "newton";
  if (app.count("--start") == 0) options.start = "nested";
  if (options.wall != "no-slip") refuse("--wall", "only no-slip is");
  if (options.method.precision != "compensated") refuse("--precision", "only compensated is");
  refuse("--line-search", "its own is on the residual");
  refuse("--no-continuation", "it takes --model section");
  if (options.method.tangent != "wrong-sign" || !options.check_jacobian)
    refuse("--tangent", "only wrong-sign is, with --check-jacobian");
}

// "70x100": elements across and up; in three dimensions those along the stream before them.
void read_elements(const CLI::App& app, Options& options) {
  constexpr long most_elements = 100000;  // of three dimensions: beyond, memory runs out
  if (options.is_3d() && app.count("--elements") == 0) options.elements = "1x70x100";
  auto& [along, section, length] = options.mesh;
  std::vector<int*> counts{&section.across, &section.up};
  if (options.is_3d()) counts.insert(counts.begin(), &along);
  try {
    std::string rest = options.elements;
    for (int*& count : counts) {
      const std::size_t cross = &count == &counts.back() ? rest.size() : rest.find('x');
      if (cross == std::string::npos) throw io::UserError("too few");
      *count = io::whole_in_range("--elements", rest.substr(0, cross), 1, 2000);
      rest.erase(0, cross + 1);
    }
    if (options.is_3d() && 1L * along * section.across * section.up > most_elements)
      throw io::UserError("too many");
  } catch (const io::UserError&) {
    throw io::UserError(
        "--elements: '" + options.elements + "' is not " +
        (options.is_3d() ? "ALONGxACROSSxUP, three whole numbers of 1 ... 2000, 100000 elements "
                           "in all, such as 1x70x100"
                         : "ACROSSxUP, two whole numbers of 1 ... 2000 such as 70x100"));
  }
}

threed::Heap heap_of(const Options& options) {
  threed::Heap heap{options.section, *rheology::regularisation_named(options.method.regularisation),
                    options.method.lambda_r};
  heap.open_outlet = options.outflow == "open"           ? flow::Open::all
                     : options.outflow == "open-viscous" ? flow::Open::viscous
                                                         : flow::Open::no;
  return heap;
}

threed::HeapOptions heap_options(const Options& options) {
  threed::HeapOptions all;
  all.start = options.start == "rest"     ? threed::Start::rest
              : options.start == "nested" ? threed::Start::nested
                                          : threed::Start::section;
  if (options.method.tolerance > 0) all.newton.tolerance = options.method.tolerance;
  if (options.method.max_iterations > 0) all.newton.max_iterations = options.method.max_iterations;
  return all;
}

flow::ShearOptions section_options(const Options& options) {
  return options.is_3d() ? threed::section_options(heap_of(options), heap_options(options))
                         : program::shear_options(options.method, twod::default_options());
}

// In three dimensions the section is only wanted quickly.
twod::Start section_start(const Options& options) {
  return options.is_3d() || options.start == "nested" ? twod::Start::nested : twod::Start::rest;
}

nlohmann::json parameters(const Options& options) {
  const auto& [along, section, length] = options.mesh;
  nlohmann::json all = {{"width", options.section.width},
                        {"height", options.section.height},
                        {"wall", options.wall},
                        {"elements", {section.across, section.up}},
                        {"grading_to_wall", section.grading_to_wall},
                        {"grading_to_surface", section.grading_to_surface},
                        {"friction", program::as_json(options.section.law)}};
  if (options.method.method == "newton") all["start"] = options.start;
  if (options.is_3d()) {
    all["elements"] = {along, section.across, section.up};
    all["outflow"] = options.outflow;
  }
  if (options.flow_rate > 0)
    all["flow_rate"] = options.flow_rate;
  else
    all["angle"] = options.section.angle;
  all.update(program::as_json(section_options(options)));
  return all;
}

int check_jacobian(const Options& options, flow::CrossSection<2>& space) {
  if (!options.is_3d())
    return program::report("heap", flow::check_jacobian(space, twod::load_of(options.section),
                                                        section_options(options)));
  threed::HeapOptions from_rest = heap_options(options);
  from_rest.start = threed::Start::rest;
  const auto solution = threed::solve(heap_of(options), options.mesh, from_rest);
  threed::HeapFlow heap(heap_of(options), options.mesh);
  if (options.method.tangent == "wrong-sign")
    heap.flow().set_tangent_factors({.shear_rate = -1, .pressure = -1});
  const auto check = [&](const char* name, double share) -> flow::NamedCheck {
    const auto state = heap.space().start().moved(share, solution.state);
    const double scale = std::max(1e-3, state.value().lpNorm<Eigen::Infinity>());
    return {name, solve::check_jacobian(flow::jacobian_problem(heap.flow(), state), scale)};
  };
  return program::report("heap", {check("half way", 0.5), check("solution", 1)});
}

// Solves the section at the given angle or at the one that carries the given flow rate.
twod::SectionSolution solve_section(const Options& options, flow::CrossSection<2>& space) {
  const flow::ShearOptions method = section_options(options);
  const solve::Stopwatch watch;
  const twod::SectionMesh& mesh = options.mesh.section;
  twod::SectionSolution solution =
      options.flow_rate > 0 ? twod::solve_for_flow_rate(options.flow_rate, options.section, mesh,
                                                        space, method, section_start(options))
      : section_start(options) == twod::Start::nested
          ? twod::solve_nested(options.section, mesh, space, method)
          : twod::solve(options.section, space, method);
  if (options.is_3d()) solution.seconds = watch.seconds();  // the search for the angle included
  return solution;
}

std::string advice_for(const Options& options, solve::End end) {
  return options.is_3d() ? "try --start section, or a larger --lambda-r" : solve::advice_for(end);
}

int run(const CLI::App& app, Options& options) {
  // 1. The mesh of half the section.
  refuse_options_of_the_other_model(app, options);
  read_elements(app, options);
  options.section.law = program::friction_law(options.method);
  options.section.wall = options.wall == "friction" ? twod::Wall::friction : twod::Wall::no_slip;
  flow::CrossSection<2> space = twod::space_of(options.section, options.mesh.section);
  if (options.check_jacobian) return check_jacobian(options, space);
  const io::ResultFolder folder(options.output);

  nlohmann::json results = {
      {"scene", "heap"}, {"model", options.model}, {"parameters", parameters(options)}};

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

  // 3. The solve, at the given angle or at the one that carries the given flow rate. The angle of
  // the three-dimensional model is that of its cross-section: both have the same flow rate.
  std::optional<twod::SectionSolution> section;
  if (!options.is_3d() || options.start == "section" || options.flow_rate > 0)
    section = solve_section(options, space);
  std::optional<threed::HeapSolution> heap;
  if (options.is_3d()) {
    if (section) options.section.angle = section->section.angle;
    heap = threed::solve(heap_of(options), options.mesh, heap_options(options),
                         section ? &*section : nullptr);
  }
  const twod::SectionSolution& solution = heap ? heap->middle : *section;

  // 4. What came out.
  results.update(heap ? threed::summary(*heap, space) : twod::summary(solution, space));
  std::cout << (heap ? threed::mesh_lines(*heap) : twod::mesh_lines(solution))
            << program::outcome_line(solution) << '\n'
            << "flow rate Q* = " << io::rounded(results["results"]["flow_rate"], 10)
            << " at an angle of " << io::rounded(solution.section.angle, 10)
            << ", surface velocity " << io::rounded(results["results"]["surface_velocity"], 7)
            << '\n';
  if (solution.interior_point.at_rest) std::cout << "The material is at rest.\n";
  if (heap && solve::is_success(solution.end)) {
    if (section) threed::add_comparison(results, *heap, *section);
    std::cout << threed::comparison_lines(*heap, section ? &*section : nullptr);
  }

  // 5. The files.
  const std::string name = heap ? "heap" : "section";
  folder.write("summary.json", results.dump(2) + "\n");
  folder.write("surface.csv", io::to_csv(twod::surface_table(solution, space)));
  folder.write(program::iteration_file(solution), io::to_csv(program::iteration_table(solution)));
  folder.write(name + ".vtu",
               heap ? io::to_vtu(threed::grid(*heap)) : io::to_vtu(twod::grid(solution, space)));
  std::cout << "results in " << folder.path().string() << ": summary.json surface.csv " << name
            << ".vtu " << program::iteration_file(solution);
  if (options.plot) {
    const io::Figure figure = heap ? threed::figure(*heap, space) : twod::figure(solution, space);
    const bool drawn =
        io::write_figure(folder, figure, "png") && io::write_figure(folder, figure, "svg");
    std::cout << (drawn ? " " + name + ".svg " + name + ".png"
                        : " (no figure: gnuplot is missing)");
  }
  std::cout << '\n';
  if (solve::is_success(solution.end)) return 0;
  std::cerr << "heap: " << solve::name_of(solution.end) << ": " << advice_for(options, solution.end)
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
  io::add_choice(app, "--model", options.model,
                 "How much of the scene is modelled: its cross-section, or velocity and pressure "
                 "in three dimensions (by Newton)",
                 {"section", "3d"});
  CLI::Option* angle =
      io::add_real(app, "--angle", options.section.angle, "Inclination α, in radians", 1e-3, 1.57);
  io::add_real(app, "--flow-rate", options.flow_rate,
               "Find the angle with this flow rate Q* instead", 1e-6, 1e6)
      ->default_str("")
      ->excludes(angle);
  io::add_choice(app, "--wall", options.wall,
                 "Side wall: without slip, or with friction mu_2 p where it slips",
                 {"no-slip", "friction"});
  app.add_option("--elements", options.elements,
                 "Elements ACROSSxUP of half the section; in 3d ALONGxACROSSxUP, default 1x70x100")
      ->capture_default_str();
  io::add_choice(
      app, "--start", options.start,
      "Where Newton starts: at rest, on ever finer meshes (default in 3d), or in 3d from "
      "the section",
      {"rest", "nested", "section"});
  io::add_choice(app, "--outflow", options.outflow,
                 "At the outlet in 3d: developed, or open with or without their pressure",
                 {"fully-developed", "open-viscous", "open"});
  io::add_real(app, "--grading-to-wall", options.mesh.section.grading_to_wall,
               "Exponent of the mesh towards the side wall; 1 is uniform", 1, 10);
  io::add_real(app, "--grading-to-surface", options.mesh.section.grading_to_surface,
               "Exponent of the mesh towards the free surface; 1 is uniform", 1, 10);
  io::add_real(app, "--width", options.section.width, "Width of the channel W, in d", 1e-3, 1e6);
  io::add_real(app, "--height", options.section.height, "Depth H, in d", 1e-3, 1e6);
  program::add_method_options(app, options.method);
  app.add_option("--output", options.output, "Folder for the results")->capture_default_str();
  app.add_flag("--plot", options.plot, "Draw the profiles (data, gnuplot script, SVG and PNG)");
  app.add_flag("--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual (take few elements)");
  return io::run_program(app, argc, argv, [&] { return run(app, options); });
}
