// Flow on a heap between rough side walls: as the smallest model that holds it, its cross-section;
// in three dimensions as the paper solves it; or on a line, averaged over the width, which is less
// than it needs.
//
// Sample runs (the test suite runs them):
//   heap --model line --wall-friction 0.45 --plot
//   heap --model line --elements 40 --grading-to-surface 2 --method newton --width 20
//   heap --model line --elements 10 --check-jacobian
//   heap --elements 18x25 --angle 0.42
//   heap --elements 14x20 --flow-rate 39.71 --plot
//   heap --elements 14x20 --method newton --lambda-r 1e-6 --grading-to-wall 2
//   heap --elements 18x16 --method newton --start nested
//   heap --elements 14x20 --wall friction
//   heap --elements 3x4 --method newton --wall friction --check-jacobian
//   heap --model space --elements 1x16x16 --angle 0.42
//   heap --model space --elements 1x7x10 --flow-rate 39.71 --start section --plot
//   heap --model space --elements 2x7x10 --start rest
//   heap --model space --elements 2x7x10 --outflow open
//   heap --model space --elements 1x2x2 --lambda-r 1e-4 --check-jacobian
#include <iostream>
#include <optional>

#include "common/mixed/mixed_jacobian.hpp"
#include "common/program/summary.hpp"
#include "common/scene/case.hpp"
#include "common/solve/parallel.hpp"
#include "common/solve/stopwatch.hpp"
#include "threed/heap_program.hpp"
#include "threed/heap_report.hpp"
#include "threed/unidirectional_program.hpp"
#include "twod/flow_rate_search.hpp"
#include "twod/section_report.hpp"

using namespace talus;

namespace {

using Options = threed::ProgramOptions;

int check_jacobian(const Options& options) {
  if (!options.is_space()) {
    shear::CrossSection<2> space = twod::space_of(options.section, options.mesh.section);
    return program::report("heap", shear::check_jacobian(space, twod::load_of(options.section),
                                                         section_options(options)));
  }
  threed::HeapFlow heap(heap_of(options), options.mesh);
  mixed::set_tangent(heap.flow(), program::tangent_named(options.method.tangent));
  const double pressure = 0.5 * options.section.height * std::cos(options.section.angle);
  return program::report("heap", mixed::check_jacobian(heap.flow(), pressure));
}

// Solves the section at the given angle or at the one that carries the given flow rate.
twod::SectionSolution solve_section(const Options& options, shear::CrossSection<2>& space) {
  const shear::ShearOptions method = section_options(options);
  const solve::Stopwatch watch;
  const twod::SectionMesh& mesh = options.mesh.section;
  twod::SectionSolution solution =
      options.flow_rate > 0 ? twod::solve_for_flow_rate(options.flow_rate, options.section, mesh,
                                                        space, method, section_start(options))
      : section_start(options) == twod::Start::nested
          ? twod::solve_nested(options.section, mesh, space, method)
          : twod::solve(options.section, space, method);
  if (options.is_space()) solution.seconds = watch.seconds();  // the search for the angle included
  return solution;
}

std::string advice_for(const Options& options, solve::End end) {
  return options.is_space() ? "try --start section, or a larger --lambda-r"
                            : solve::advice_for(end);
}

// What was found, by the model asked for: the section itself, or the one in the middle of the heap.
struct Found {
  std::unique_ptr<shear::CrossSection<2>> space;  // of the section
  std::optional<twod::SectionSolution> section;
  std::optional<threed::HeapSolution> heap;

  const twod::SectionSolution& solution() const { return heap ? heap->middle : *section; }
};

// At the given angle, or at the one that carries the given flow rate. The angle of the
// three-dimensional model is that of its cross-section: both have the same flow rate.
Found solve(Options& options) {
  Found found{std::make_unique<shear::CrossSection<2>>(
                  twod::space_of(options.section, options.mesh.section)),
              {},
              {}};
  if (!options.is_space() || options.start == "section" || options.flow_rate > 0)
    found.section = solve_section(options, *found.space);
  if (!options.is_space()) return found;
  if (found.section) options.section.angle = found.section->section.angle;
  found.heap = threed::solve(heap_of(options), options.mesh, heap_options(options),
                             found.section ? &*found.section : nullptr);
  return found;
}

void print(const Found& found, const nlohmann::json& results) {
  const auto& [_, section, heap] = found;
  const twod::SectionSolution& solution = found.solution();
  std::cout << (heap ? threed::mesh_lines(*heap) : twod::mesh_lines(solution))
            << program::outcome_line(solution) << '\n';
  if (!solve::is_success(solution.end)) return;
  std::cout << "flow rate Q* = " << io::rounded(results["results"]["flow_rate"], 10)
            << " at an angle of " << io::rounded(solution.section.angle, 10)
            << ", surface velocity " << io::rounded(results["results"]["surface_velocity"], 7)
            << '\n';
  if (solution.interior_point.at_rest) std::cout << "The material is at rest.\n";
  if (heap) std::cout << threed::comparison_lines(*heap, section ? &*section : nullptr);
}

// Whatever a run can leave, of any model.
std::vector<std::string> files() {
  std::vector<std::string> names = threed::files_of_line();
  names.push_back("surface.csv");
  for (const char* model : {"section", "heap"}) {
    names.push_back(std::string(model) + ".vtu");
    for (const char* figure : {"", "_fields"})
      for (const std::string& file : io::files_of(std::string(model) + figure))
        names.push_back(file);
  }
  return names;
}

// What was solved, in a line.
std::string title_of(const Options& options, const twod::SectionSolution& solution) {
  const bool has_law = solution.is_of_newton();
  return "heap, " +
         (options.is_space() ? "space, " + options.elements : "section, " + options.elements) +
         ", α = " + io::rounded(solution.section.angle) + ", " +
         (has_law ? options.method.regularisation + ", λr = " + io::rounded(options.method.lambda_r)
                  : "interior point, no λr");
}

std::vector<io::Figure> figures_of(const Options& options, const Found& found) {
  const auto& [space, section, heap] = found;
  const twod::SectionSolution& solution = found.solution();
  const std::string title = title_of(options, solution);
  if (heap) return {threed::figure(*heap, *space), threed::picture(*heap, title, options.picture)};
  rheology::Rheology rheology(options.section.law, program::limiting_law(options.method),
                              options.method.lambda_r);
  rheology.regularises_pressure = solution.is_of_newton();
  return {twod::figure(solution, *space),
          twod::picture(solution, *space, rheology, title, options.picture)};
}

// The summary last: where it is, the others are. Of a failed solve it says how it went, and there
// is no flow to show.
void write_files(const io::ResultFolder& folder, const Found& found, const nlohmann::json& results,
                 const Options& options) {
  const auto& heap = found.heap;
  const shear::CrossSection<2>& space = *found.space;
  const twod::SectionSolution& solution = found.solution();
  const std::string iterations = program::iteration_file(solution);
  std::string written = " summary.json " + iterations;
  folder.write(iterations, io::to_csv(program::iteration_table(solution)));
  if (solve::is_success(solution.end)) {
    const std::string fields = heap ? "heap.vtu" : "section.vtu";
    folder.write("surface.csv", io::to_csv(twod::surface_table(solution, space)));
    folder.write(fields,
                 heap ? io::to_vtu(threed::grid(*heap)) : io::to_vtu(twod::grid(solution, space)));
    written += " surface.csv " + fields;
    if (options.plot) written += io::draw(folder, figures_of(options, found));
  }
  folder.write("summary.json", results.dump(2) + "\n");
  if (!folder.is_nowhere())
    std::cout << "results in " << folder.path().string() << ":" << written << '\n';
}

// No solution, and why: the summary says so too.
int refuse(const scene::Case& a_case, const io::ResultFolder& folder, nlohmann::json results,
           solve::End end, const std::string& why) {
  results["status"] = solve::name_of(end);
  results["results"] = nlohmann::json::object();
  a_case.complete(results);
  a_case.write(results);
  folder.write("summary.json", results.dump(2) + "\n");
  std::cerr << "heap: " << solve::name_of(end) << ": " << why << '\n';
  return 1;
}

// Elements of the mesh, and how large they are in the section, in d.
void add_size(nlohmann::json& results, const Options& options) {
  const auto& [across, up, to_wall, to_surface] = options.mesh.section;
  const int along = options.is_space() ? options.mesh.along : 1;
  results["elements"] = along * across * up;
  results["element_size"] =
      std::sqrt(options.section.width / 2 * options.section.height / (across * up));
}

int run(const io::CommandLine& line, Options& options, scene::Case& a_case) {
  // 1. What the options mean together.
  threed::interpret(line, options);
  if (options.is_line()) return threed::run_on_line(line, options, files(), a_case);
  threed::admit(options);
  solve::set_threads(options.threads);
  if (a_case.is_dry_run()) return 0;
  if (options.check_jacobian) return check_jacobian(options);
  const io::ResultFolder folder = a_case.folder(options.output);
  folder.remove_older(files());

  nlohmann::json results = {
      {"scene", "heap"}, {"model", options.model}, {"parameters", parameters(options)}};
  add_size(results, options);

  // 2. The limits of existence come first.
  const bool searches = options.flow_rate > 0;
  if (!searches && twod::regime(options.section) == rheology::Regime::no_steady_state)
    return refuse(
        a_case, folder, results, solve::End::no_steady_state,
        "no steady flow for angle >= " + io::rounded(std::atan(options.section.law.mu_2()), 6) +
            "; " + solve::advice_for(solve::End::no_steady_state));

  // 3. The solve, what came out, and the files.
  Found found;
  try {
    found = a_case.timed([&] { return solve(options); });
  } catch (const twod::FlowRateError& error) {
    return refuse(a_case, folder, results, error.end, error.what());
  }
  const twod::SectionSolution& solution = found.solution();
  results["unknowns"] = found.space->node_count();  // of the section, as on a line
  results.update(found.heap ? threed::summary(*found.heap, *found.space)
                            : twod::summary(solution, *found.space));
  if (found.heap && found.section && solve::is_success(solution.end))
    threed::add_comparison(results, *found.heap, *found.section);
  a_case.complete(results);
  print(found, results);
  write_files(folder, found, results, options);
  a_case.write(results);
  if (solve::is_success(solution.end)) return 0;
  std::cerr << "heap: " << solve::name_of(solution.end) << ": " << advice_for(options, solution.end)
            << '\n';
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{"Dense granular flow on a heap between side walls", "heap"};
  Options options;
  threed::add_options(line, options);
  scene::Case a_case(line, threed::description());
  return a_case.run_program(argc, argv, [&] { return run(line, options, a_case); });
}
