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

// Ours beside theirs, as checks, rows, and points: how much of its room each distance takes.
class Comparison {
 public:
  Comparison(Chapter& chapter, const std::string& name, const std::string& title)
      : chapter_(chapter),
        name_(name),
        table_{title,
               {"row", "result", "ours", "theirs", "apart, relative", "room", "source", "command"},
               {}} {}

  void add(const std::string& result, double ours, const Reference& theirs,
           const std::string& command) {
    chapter_.check(result + " of " + command, ours, theirs);
    const auto row = table_.rows.size() + 1;
    table_.rows.push_back({std::to_string(row), result, io::rounded(ours, 10),
                           io::rounded(theirs.value, 10), io::rounded(ours / theirs.value - 1, 2),
                           io::rounded(theirs.uncertainty / std::abs(theirs.value), 2),
                           theirs.source, "./run " + command});
    auto curve = std::ranges::find(curves_, theirs.source, &io::Curve::label);
    if (curve == curves_.end())
      curve = curves_.insert(curve, {theirs.source, {}, {}, io::Style::points});
    curve->x.push_back(static_cast<double>(row));
    curve->y.push_back(std::abs(ours - theirs.value) / theirs.uncertainty);
    curve->commands.push_back("./run " + command);
  }

  void show() {
    io::Panel panel{table_.title, "row of the table", "distance / room", false, true, curves_};
    chapter_.figure(
        {"references_" + name_,
         "How far ours is from theirs, scene, law, mesh and λr as in the commands of the "
         "table, in units of what theirs is good for: at 1 a "
         "check fails.",
         {panel},
         1});
    chapter_.table(std::move(table_));
  }

 private:
  Chapter& chapter_;
  std::string name_;
  io::Table table_;
  std::vector<io::Curve> curves_;  // by source
};

// The surface of a section, solved here: a case keeps its middle only.
void check_surface(Comparison& comparison, const KnownSurface& known) {
  twod::Section section;
  section.angle = known.angle;
  auto space = twod::space_of(section, {35, 50});
  const auto solution = twod::solve(section, space, twod::newton_options(1e-5));
  const twod::SurfaceProfile profile = twod::surface_profile(solution, space);
  const std::string command = "heap --elements 35x50 --method newton --lambda-r 1e-5 --angle " +
                              io::rounded(known.angle) + " # surface.csv";
  for (const KnownSurface::At& at : known.points) {
    const auto node = std::ranges::find_if(
        profile.y, [&](double y) { return std::abs(y - at.y) < 1e-9 * section.width; });
    const bool is_there = node != profile.y.end() && solve::is_success(solution.end);
    const auto check = [&](const std::string& name, const std::vector<double>& values,
                           const Reference& theirs) {
      const double ours =
          is_there ? values[static_cast<std::size_t>(node - profile.y.begin())] : std::nan("");
      comparison.add(name + " at y = " + io::rounded(at.y), ours, theirs, command);
    };
    check("velocity", profile.velocity, KnownSurface::velocity(at));
    check("depth, 1%", profile.depth_1, KnownSurface::depth_1(at));
    check("depth, 5%", profile.depth_5, KnownSurface::depth_5(at));
  }
}

}  // namespace

void check_known(Chapter& chapter, const std::string& name, const std::vector<KnownCase>& cases,
                 const Context& context) {
  Comparison comparison(chapter, name, "Ours beside theirs: " + name);
  std::size_t done = 0;
  for (const KnownCase& known : cases) {
    ++done;
    if (known.full_only && !context.full) continue;
    study::Table answer = study::asked(known.scene, io::split(known.words, ' '));
    study::solve(answer);
    for (const auto& [result, theirs] : known.results) {
      const double ours =
          answer.rows.size() == 1 ? answer.rows.front().number(result) : std::nan("");
      comparison.add(result, ours, theirs, known.scene + " " + known.words);
    }
    context.progress(static_cast<double>(done) / static_cast<double>(cases.size()));
  }
  comparison.show();
}

void references_of_lines(Chapter& chapter, const Context& context) {
  chapter.text(
      "Numbers that were found for these scenes with other tools, and where. The room of a number "
      "is what it is good for: its printed digits where the elements are the same, what the meshes "
      "leave open where they are not.");
  check_known(chapter, "lines", references::known_cases({"chute", "bagnold"}), context);
}

void references_of_heap(Chapter& chapter, const Context& context) {
  check_known(chapter, "heap", references::known_cases({"heap"}), context);
  Comparison surface(chapter, "surface", "The heap's surface, 35x50 elements, eq. (12), λr = 1e-5");
  for (const KnownSurface& known : references::known_surfaces()) check_surface(surface, known);
  surface.show();
}

void references_of_cylinder(Chapter& chapter, const Context& context) {
  check_known(chapter, "cylinder", references::known_cases({"cylinder"}), context);
}

}  // namespace talus::verification
