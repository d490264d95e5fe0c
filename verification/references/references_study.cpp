// What other codes find, scene by scene: each row a command of ours, and who found the other
// number.
#include "verification/references/references_study.hpp"

#include <cmath>

#include "common/io/options.hpp"
#include "twod/section.hpp"
#include "verification/harness/methods.hpp"
#include "verification/study/question.hpp"

namespace talus::verification {
namespace {

using references::KnownCase, references::KnownSurface;

io::Table empty_table(const std::string& title) {
  return {title, {"result", "ours", "theirs", "apart, relative", "room", "source", "command"}, {}};
}

void add_row(io::Table& table, const std::string& name, double ours, const Reference& theirs,
             const std::string& command) {
  table.rows.push_back({name, io::rounded(ours, 10), io::rounded(theirs.value, 10),
                        io::rounded(ours / theirs.value - 1, 2),
                        io::rounded(theirs.uncertainty / std::abs(theirs.value), 2), theirs.source,
                        command});
}

// The surface of a section, solved here: a case keeps its middle only.
void check_surface(Chapter& chapter, io::Table& table, const KnownSurface& known) {
  twod::Section section;
  section.angle = known.angle;
  auto space = twod::space_of(section, {35, 50});
  const auto solution = twod::solve(section, space, twod::newton_options(1e-5));
  const twod::SurfaceProfile profile = twod::surface_profile(solution, space);
  const std::string command =
      "./run heap --elements 35x50 --method newton --lambda-r 1e-5 --angle " +
      io::rounded(known.angle) + " # surface.csv";
  for (const KnownSurface::At& at : known.points) {
    const auto node = std::ranges::find_if(
        profile.y, [&](double y) { return std::abs(y - at.y) < 1e-9 * section.width; });
    const bool is_there = node != profile.y.end() && solve::is_success(solution.end);
    const auto check = [&](const std::string& name, const std::vector<double>& values,
                           const Reference& theirs) {
      const std::string what = name + " at y = " + io::rounded(at.y);
      const double ours =
          is_there ? values[static_cast<std::size_t>(node - profile.y.begin())] : std::nan("");
      chapter.check("heap's surface, α = " + io::rounded(known.angle) + ": " + what, ours, theirs);
      add_row(table, what, ours, theirs, command);
    };
    check("velocity", profile.velocity, KnownSurface::velocity(at));
    check("depth, 1%", profile.depth_1, KnownSurface::depth_1(at));
    check("depth, 5%", profile.depth_5, KnownSurface::depth_5(at));
  }
}

}  // namespace

void check_known(Chapter& chapter, const std::vector<KnownCase>& cases, const Context& context) {
  io::Table table = empty_table("Ours beside theirs");
  std::size_t done = 0;
  for (const KnownCase& known : cases) {
    ++done;
    if (known.full_only && !context.full) continue;
    study::Table answer = study::asked(known.scene, io::split(known.words, ' '));
    study::solve(answer);
    const std::string command = known.scene + " " + known.words;
    for (const auto& [name, theirs] : known.results) {
      const double ours = answer.rows.size() == 1 ? answer.rows.front().number(name) : std::nan("");
      chapter.check(name + " of " + command, ours, theirs);
      add_row(table, name, ours, theirs, "./run " + command);
    }
    context.progress(static_cast<double>(done) / static_cast<double>(cases.size()));
  }
  chapter.table(std::move(table));
}

void references_of_lines(Chapter& chapter, const Context& context) {
  chapter.text(
      "Numbers that were found for these scenes with other tools, and where. “Room” is what the "
      "other "
      "number is good for: its printed digits where the elements are the same, what the meshes "
      "leave "
      "open where they are not.");
  check_known(chapter, references::known_cases({"chute", "bagnold"}), context);
}

void references_of_heap(Chapter& chapter, const Context& context) {
  check_known(chapter, references::known_cases({"heap"}), context);
  io::Table table = empty_table("The heap's surface, 35x50 elements, eq. (12), λr = 1e-5");
  for (const KnownSurface& known : references::known_surfaces())
    check_surface(chapter, table, known);
  chapter.table(std::move(table));
}

void references_of_cylinder(Chapter& chapter, const Context& context) {
  check_known(chapter, references::known_cases({"cylinder"}), context);
}

}  // namespace talus::verification
