#include "threed/heap_program.hpp"

#include <vector>

#include "common/program/grading.hpp"
#include "common/program/summary.hpp"
#include "common/program/work.hpp"

namespace talus::threed {
namespace {

// A value that the model has no use for, though the option has.
void refuse_values_of_the_other_model(const io::CommandLine& line, const ProgramOptions& options) {
  const auto refuse = [&](const char* option, const std::string& value, const std::string& advice) {
    if (line.is_given(option))
      throw io::UserError(std::string(option) + ": '" + value + "' is not for --model " +
                          options.model + "; " + advice);
  };
  const program::MethodOptions& method = options.method;
  if (options.is_line()) {
    if (options.flow_rate > 0)
      refuse("--flow-rate", io::rounded(options.flow_rate), "give --angle");
    return;
  }
  if (!options.is_space()) {
    if (options.start == "section") refuse("--start", options.start, "it takes --model space");
    return;
  }
  if (method.method != "newton") refuse("--method", method.method, "only newton is");
  if (options.wall != "no-slip") refuse("--wall", options.wall, "only no-slip is");
  if (method.precision != "compensated")
    refuse("--precision", method.precision, "only compensated is");
  if (method.line_search == "energy-slope")
    refuse("--line-search", method.line_search, "only residual-norm and none are");
}

// Which options a run uses.
std::vector<io::Use> used_options(const ProgramOptions& options) {
  const std::string model = "--model " + options.model;
  std::vector<io::Use> table = {
      {{"--outflow", "--penalty", "--lambda-p", "--threads"},
       options.is_space(),
       model + "; add --model space"},
      {{"--wall-friction"}, options.is_line(), model + "; add --model line"},
      {{"--wall", "--start", "--grading-to-wall", "--fields", "--window"},
       !options.is_line(),
       model + "; add --model section or --model space"},
      {{"--start", "--flow-rate"}, !options.check_jacobian, "--check-jacobian"},
      {{"--start"},
       options.method.method == "newton",
       "--method interior-point; add --method newton"}};
  for (const io::Use& use : program::used_options(options.method, options.check_jacobian))
    table.push_back(use);
  return table;
}

// "70x100": elements across and up; in three dimensions those along the stream before them, on a
// line only those up.
void read_elements(const io::CommandLine& line, ProgramOptions& options) {
  constexpr long most_elements = 100000;  // of three dimensions: beyond, memory runs out
  if (!line.is_given("--elements"))
    options.elements = options.is_line() ? "100" : options.is_space() ? "1x70x100" : "70x100";
  auto& [along, section, length] = options.mesh;
  std::vector<int*> counts{&section.across, &section.up};
  if (options.is_line()) counts.erase(counts.begin());
  if (options.is_space()) counts.insert(counts.begin(), &along);
  try {
    std::string rest = options.elements;
    for (int*& count : counts) {
      const std::size_t cross = &count == &counts.back() ? rest.size() : rest.find('x');
      if (cross == std::string::npos) throw io::UserError("too few");
      *count = io::whole_in_range("--elements", rest.substr(0, cross), 1, 2000);
      rest.erase(0, cross + 1);
    }
    if (options.is_space() && 1L * along * section.across * section.up > most_elements)
      throw io::UserError("too many");
  } catch (const io::UserError&) {
    throw io::UserError(
        "--elements: '" + options.elements + "' is not " +
        (options.is_space() ? "ALONGxACROSSxUP, three whole numbers of 1 ... 2000, 100000 elements "
                              "in all, such as 1x70x100"
         : options.is_line() ? "UP, a whole number of 1 ... 2000"
                             : "ACROSSxUP, two whole numbers of 1 ... 2000 such as 70x100"));
  }
}

}  // namespace

void add_options(io::CommandLine& line, ProgramOptions& options) {
  options.method.method = "interior-point";
  options.method.tangent = "primal-dual";
  options.method.lambda_r = twod::default_options().lambda_r;
  io::add_choice(line, "--model", options.model,
                 "How much of the scene is modelled: a line, averaged over the width; its "
                 "cross-section; or velocity and pressure in space (by Newton)",
                 {"line", "section", "space"}, {{"3d", "space"}});
  const io::Option angle =
      io::add_angle(line, "--angle", options.section.angle, "Inclination α", 1e-3, 1.57);
  io::add_real(line, "--flow-rate", options.flow_rate,
               "Find the angle with this flow rate Q* instead", 1e-6, 1e6)
      .without_default()
      .excludes(angle);
  io::add_choice(line, "--wall", options.wall,
                 "Side wall: without slip, or with friction mu_2 p where it slips",
                 {"no-slip", "friction"});
  io::add_real(line, "--wall-friction", options.wall_friction,
               "Friction μw at the side walls, on a line; between μs and μ2 where they slip", 1e-3,
               10);
  io::add_text(
      line, "--elements", options.elements,
      "Elements ACROSSxUP of half the section; in space ALONGxACROSSxUP, default 1x70x100; "
      "on a line UP, default 100")
      .of_type("MESH");
  io::add_choice(line, "--start", options.start,
                 "Where Newton starts: at rest, on ever finer meshes (default in space), or "
                 "there from the section",
                 {"rest", "nested", "section"});
  io::add_choice(line, "--outflow", options.outflow,
                 "At the outlet in space: developed, or open with or without their pressure",
                 {"fully-developed", "open-viscous", "open"});
  io::add_real(line, "--grading-to-wall", options.mesh.section.grading_to_wall,
               "Exponent of the mesh towards the side wall; 1 is uniform", 1, 10);
  io::add_real(line, "--grading-to-surface", options.mesh.section.grading_to_surface,
               "Exponent of the mesh towards the free surface; 1 is uniform", 1, 10);
  io::add_real(line, "--width", options.section.width, "Width of the channel W, in d", 1e-3, 1e6);
  io::add_real(line, "--height", options.section.height, "Depth H, in d", 1e-3, 1e6);
  program::add_method_options(line, options.method);
  program::add_penalty(line, options.penalty);
  program::add_threads(line, options.threads);
  io::add_text(line, "--output", options.output, "Folder for the results");
  io::add_flag(line, "--plot", options.plot,
               "Draw profiles and fields (data, gnuplot script, SVG and PNG)");
  program::add_pictures(line, options.picture);
  io::add_flag(line, "--check-jacobian", options.check_jacobian,
               "Only compare the tangent with differences of the residual (take few elements)");
}

void interpret(const io::CommandLine& line, ProgramOptions& options) {
  refuse_values_of_the_other_model(line, options);
  if (options.is_space()) {
    options.method.method = "newton";
    if (!line.is_given("--start")) options.start = "nested";
    if (!line.is_given("--line-search")) options.method.line_search = "residual-norm";
  }
  io::refuse_unused(line, used_options(options));
  program::check_pictures(line, options.picture, options.plot);
  read_elements(line, options);
  const auto& section = options.mesh.section;
  program::check_grading("--grading-to-wall", section.grading_to_wall, section.across);
  program::check_grading("--grading-to-surface", section.grading_to_surface, section.up);
  options.section.law = program::friction_law(options.method);
  options.section.wall = options.wall == "friction" ? twod::Wall::friction : twod::Wall::no_slip;
}

namespace {

// At a share of its size in every direction. Factorisations as they were counted from the default
// starts (docs/heap.md); a search for the flow rate takes some solves of the section.
program::Task task_at(const ProgramOptions& options, double share) {
  const auto scaled = [&](int count) { return std::max(1, static_cast<int>(share * count)); };
  const std::array<int, 2> section{scaled(options.mesh.section.across),
                                   scaled(options.mesh.section.up)};
  const bool is_interior_point = options.method.method == "interior-point";
  const int searches = options.flow_rate > 0 ? 5 : 1;
  program::Task task{
      std::to_string(section[0]) + "x" + std::to_string(section[1]),
      program::section_work(section, is_interior_point, searches * (is_interior_point ? 35 : 20))};
  if (!options.is_space()) return task;
  const int along = scaled(options.mesh.along);
  // In the first and the last layer of nodes only the velocity along the stream is free.
  const double unknowns_per_node = 3 - 4. / (2 * along + 1);
  task.value = std::to_string(along) + "x" + task.value;
  task.work += program::mixed_work({along, section[0], section[1]}, unknowns_per_node, 12);
  return task;
}

}  // namespace

void admit(const ProgramOptions& options) {
  program::admit("heap", "--elements", [&](double share) { return task_at(options, share); });
}

Heap heap_of(const ProgramOptions& options) {
  Heap heap{options.section, *rheology::regularisation_named(options.method.regularisation),
            options.method.lambda_r};
  heap.open_outlet = options.outflow == "open"           ? mixed::Open::all
                     : options.outflow == "open-viscous" ? mixed::Open::viscous
                                                         : mixed::Open::no;
  heap.penalty = program::penalty_of(options.penalty);
  return heap;
}

HeapOptions heap_options(const ProgramOptions& options) {
  HeapOptions all;
  all.start = options.start == "rest"     ? Start::rest
              : options.start == "nested" ? Start::nested
                                          : Start::section;
  if (options.method.tolerance > 0)
    all.newton.tolerance = all.newton.distance = options.method.tolerance;
  if (options.method.max_iterations > 0) all.newton.max_iterations = options.method.max_iterations;
  all.newton.line_search = program::line_search_named(options.method.line_search);
  all.tangent = program::tangent_named(options.method.tangent);
  all.comes_down = !options.method.no_continuation;
  return all;
}

shear::ShearOptions section_options(const ProgramOptions& options) {
  return options.is_space() ? section_options(heap_of(options), heap_options(options))
                            : program::shear_options(options.method, twod::default_options());
}

twod::Start section_start(const ProgramOptions& options) {
  return options.is_space() || options.start == "nested" ? twod::Start::nested : twod::Start::rest;
}

nlohmann::json parameters(const ProgramOptions& options) {
  const auto& [along, section, length] = options.mesh;
  nlohmann::json all = {{"width", options.section.width},
                        {"height", options.section.height},
                        {"wall", options.wall},
                        {"elements", {section.across, section.up}},
                        {"grading_to_wall", section.grading_to_wall},
                        {"grading_to_surface", section.grading_to_surface},
                        {"friction", program::as_json(options.section.law)}};
  if (options.method.method == "newton") all["start"] = options.start;
  if (options.is_space()) {
    all["elements"] = {along, section.across, section.up};
    all["outflow"] = options.outflow;
    all.update(program::as_json(program::penalty_of(options.penalty)));
  }
  if (options.flow_rate > 0)
    all["flow_rate"] = options.flow_rate;
  else
    all["angle"] = options.section.angle;
  all.update(program::as_json(section_options(options)));
  return all;
}

}  // namespace talus::threed
