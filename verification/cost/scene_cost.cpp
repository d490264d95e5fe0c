// Work and precision of every scene in every model it has, by the programs themselves: one table of
// the same columns, and every row a command line.
#include "verification/cost/scene_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/io/options.hpp"
#include "common/rheology/regularisation.hpp"
#include "common/solve/extremes.hpp"
#include "verification/cost/cost_parts.hpp"
#include "verification/harness/fit.hpp"
#include "verification/study/kinds.hpp"
#include "verification/study/question.hpp"

namespace talus::verification {
namespace {

// Every law of the registry, as the values of an option.
std::string all_laws() {
  std::string laws;
  for (const auto& law : rheology::regularisations())
    laws += (laws.empty() ? "" : ",") + rheology::name_of(law);
  return laws;
}

// How far the error of a curve falls from its coarsest to its finest mesh; NaN if it is not known
// of two meshes, or a case did not arrive.
double decrease(const study::Curve& curve, const std::string& error) {
  std::vector<double> errors;
  for (const study::Row* row : curve.rows) {
    if (!row->is_success()) return std::numeric_limits<double>::quiet_NaN();
    if (std::isfinite(row->number(error))) errors.push_back(row->number(error));
  }
  return errors.size() > 1 ? errors.back() / errors.front()
                           : std::numeric_limits<double>::quiet_NaN();
}

void add_rows(io::Table& table, const WorkQuestion& question, const study::Table& answer,
              const std::string& error, const study::Findings& found) {
  for (const auto& curve : study::curves_of(answer, {answer.mesh_option()}))
    for (const study::Row* row : curve.rows) {
      const bool on_front =
          std::ranges::any_of(found.front, [&](const auto& each) { return each.second == row; });
      const double reached = row->number(error);
      table.rows.push_back(
          {question.title, curve.label, row->option(answer.mesh_option()), row->status(),
           io::rounded(row->number("unknowns"), 7), io::rounded(row->number("factorisations")),
           io::rounded(row->number("cpu_seconds"), 3), io::rounded(row->number("peak_memory"), 3),
           std::isfinite(reached) ? io::rounded(reached, 3) : "", error, on_front ? "yes" : "",
           row->record.at("command")});
    }
}

// Of Newton's method the law, else the method: what a case on a front is known by.
std::string way_of(const std::pair<std::string, const study::Row*>& on_front) {
  const auto& [way, row] = on_front;
  if (way.empty()) return row->option("--regularisation");
  constexpr const char* newton = "newton, ";
  return way.rfind(newton, 0) == 0 ? way.substr(std::string(newton).size()) : way;
}

// The cases of a question that no other beats in both time and error, under the name of the most
// accurate: its way and its mesh.
io::Curve front_curve(const WorkQuestion& question, const study::Table& answer,
                      const std::string& error, const study::Findings& found) {
  io::Curve curve{question.title, {}, {}};
  for (const auto& [way, row] : found.front) {
    curve.x.push_back(row->number("cpu_seconds"));
    curve.y.push_back(row->number(error));
    curve.commands.push_back(row->record.at("command"));
  }
  if (found.front.empty()) return curve;
  const study::Row* const best = found.front.back().second;
  curve.label += ": " + way_of(found.front.back()) + ", " + best->option(answer.mesh_option());
  return curve;
}

// What a tenth of the error costs on a front, in times the CPU time; NaN where the error does not
// fall by a factor of two, from which nothing can be told.
double price_of_a_digit(const io::Curve& front) {
  if (!(front.y.front() > 2 * front.y.back())) return std::numeric_limits<double>::quiet_NaN();
  return std::pow(front.x.back() / front.x.front(),
                  1 / std::log10(front.y.front() / front.y.back()));
}

// Whose method is on the front at its most accurate end, and what accuracy costs there.
void add_headline(Chapter& chapter, io::Panel panel, const std::map<std::string, int>& best) {
  Range prices;
  for (const io::Curve& front : panel.curves)
    if (const double price = price_of_a_digit(front); std::isfinite(price)) prices.add(price);
  std::string methods_named;
  for (const auto& [way, count] : best)
    methods_named += (methods_named.empty() ? "" : ", ") + way + " in " + std::to_string(count);
  const std::string scenes = std::to_string(panel.curves.size());
  chapter.headline(
      Question::speed_against_accuracy,
      {"fronts",
       "The fronts of all scenes and models, every law of the registry, one thread: of "
       "each the cases that no other beats in time and error. The name is of the most "
       "accurate: its law, or its method if it has none, and its mesh. Errors are those of the "
       "panels "
       "below, relative or in the units of the scene.",
       {panel},
       1},
      "Of " + scenes + " scenes and models the most accurate case is by " + methods_named +
          "; a tenth of the error takes " + prices.text(3) + " times the CPU time.");
}

}  // namespace

std::vector<WorkQuestion> work_questions(bool full) {
  const std::string laws = " --regularisation " + all_laws();
  const auto sized = [&](const char* quick, const char* whole) {
    return std::string(full ? whole : quick);
  };
  const std::string line = " --method newton,interior-point --lambda-r 1e-8 --elements " +
                           sized("10,40", "10:640:x2") + laws;
  const std::string plane = " --lambda-r 1e-8 --elements " + sized("4,8", "4:16:x2") + laws;
  const std::string space = " --lambda-r 1e-8 --elements " + sized("2,4", "2:8:x2") + laws;
  const std::string around = " --lambda-r 1e-4 --around " + sized("16,32,40", "16:96:+16");
  return {
      {"chute, line", "chute", "--model line" + line, 0.2},
      {"chute, plane", "chute", "--model plane" + plane},
      {"chute, space", "chute", "--model space" + space},
      {"bagnold, line", "bagnold", "--model line" + line, 0.2},
      {"bagnold, plane", "bagnold", "--model plane" + plane},
      {"bagnold, space", "bagnold", "--model space" + space},
      {"heap, section", "heap",
       "--model section --method newton,interior-point --lambda-r 1e-7 --elements " +
           sized("5x7,10x14,20x28", "9x13,18x25,35x50,70x100") + laws},
      {"heap, space", "heap",
       "--model space --elements " + sized("1x3x4,1x5x7,1x9x13", "1x5x7,1x9x13,1x18x25,1x35x50") +
           laws},
      {"manufactured, plane", "manufactured",
       "--model plane --elements " + sized("4,8", "4:32:x2") + laws},
      {"manufactured, space", "manufactured",
       "--model space --elements " + sized("2,4", "2:8:x2") + laws},
      // U of a creep is proportional to λr: of each law its own. The drag falls with its order 1.
      {"cylinder, creep", "cylinder", "--loading 0.03" + around + laws, 0.7},
      {"cylinder, above yield", "cylinder", "--loading 0.052 --regularisation barker-gray" + around,
       0.7}};
}

void add_work_precision(Chapter& chapter, const std::vector<WorkQuestion>& questions,
                        const std::function<void(double)>& progress) {
  io::Table table{"Work and precision of every scene in every model, one thread",
                  {"scene and model", "method", "mesh", "end", "unknowns", "factorisations",
                   "CPU s", "memory, MB", "error", "of", "on the front", "command"},
                  {}};
  io::Figure figure{"work_precision",
                    "Error against CPU time of every scene in every model, every law of the "
                    "registry, one thread, at the λr and on the meshes of the commands; every "
                    "point is a mesh. Rings: no other case is both faster and better. A law "
                    "without a yield stress is measured against its own flow.",
                    {},
                    2};
  io::Panel fronts{"", "CPU seconds", "error, relative or in g and d", true, true, {}};
  std::map<std::string, int> best;  // way of the most accurate case, and how often
  std::size_t done = 0;
  for (const WorkQuestion& question : questions) {
    study::Table answer = study::asked(question.scene, io::split(question.words, ' '));
    study::solve(answer);
    study::Findings found = study::cost(answer);
    auto& panel = std::get<io::Figure>(found.chapter.blocks.front()).panels.front();
    const std::string error = study::errors_to_show(answer, {}).front();
    panel.title = question.title;
    panel.y_label = error + " " + panel.y_label;
    std::ranges::replace(panel.y_label, '_', ' ');
    // Where nothing varies but the mesh, the law tells the curve.
    for (io::Curve& curve : panel.curves)
      if (curve.label.empty()) curve.label = answer.rows.front().option("--regularisation");
    figure.panels.push_back(panel);
    const io::Curve front = front_curve(question, answer, error, found);
    if (!front.x.empty()) {
      ++best[way_of(found.front.back())];
      fronts.curves.push_back(front);
    }
    add_rows(table, question, answer, error, found);
    double worst = 0;
    for (const auto& curve : study::curves_of(answer, {answer.mesh_option()}))
      worst = solve::nan_max(worst, decrease(curve, error));
    chapter.check(Kind::self_consistency,
                  "work and precision, " + question.title +
                      ": error on the finest mesh over that on the coarsest, any method",
                  worst, 0, question.most_left);
    progress(static_cast<double>(++done) / static_cast<double>(questions.size()));
  }
  if (!fronts.curves.empty()) add_headline(chapter, std::move(fronts), best);
  chapter.figure(std::move(figure));
  chapter.table(std::move(table));
}

void scene_costs(Chapter& chapter, const Context& context) {
  add_work_precision(chapter, work_questions(context.full), context.progress);
}

}  // namespace talus::verification
