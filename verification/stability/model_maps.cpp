#include "verification/stability/model_maps.hpp"

#include <algorithm>

#include "common/io/options.hpp"
#include "verification/stability/stability_parts.hpp"
#include "verification/study/kinds.hpp"
#include "verification/study/question.hpp"

namespace talus::verification {
namespace {

double share_of_arrivals(const std::vector<const study::Row*>& rows) {
  return static_cast<double>(std::ranges::count_if(rows, &study::Row::is_success)) /
         static_cast<double>(rows.size());
}

// The term η' dropped, or of the wrong sign.
bool has_broken_tangent(const study::Row* row) {
  const std::string tangent = row->option("--tangent");
  return tangent == "frozen" || tangent == "wrong-sign";
}

void add_map(Chapter& chapter, const MapQuestion& question) {
  study::Table answer = study::asked(question.scene, io::split(question.words, ' '));
  study::solve(answer);
  study::Findings found = study::stability(answer);
  for (auto& block : found.chapter.blocks) {
    if (auto* figure = std::get_if<io::Figure>(&block)) {
      figure->name = "map_" + question.name;
      figure->caption = question.title + ", by `./run study stability " + question.scene + " " +
                        question.words + "`. " + figure->caption;
    } else if (auto* table = std::get_if<io::Table>(&block)) {
      table->title = question.title + ": " + table->title;
    }
    chapter.blocks.push_back(std::move(block));
  }
  std::vector<const study::Row*> all = study::all_rows(answer), broken;
  std::ranges::copy_if(all, std::back_inserter(broken), has_broken_tangent);
  const bool is_recommended = question.least == 1;
  Ends ends{question.title.substr(0, question.title.find(", ", question.title.find(", ") + 1)),
            is_recommended};
  for (const study::Row* row : all) ++ends.counts[row->is_success() ? arrival : row->status()];
  chapter.ends.push_back(std::move(ends));
  chapter.check(Kind::self_consistency, question.title + ": share of the cases that arrives",
                share_of_arrivals(all), question.least, question.most);
  if (!broken.empty())
    chapter.check(Kind::control, question.title + ": share that arrives with a broken tangent",
                  share_of_arrivals(broken), 0, question.most_broken);
}

}  // namespace

std::vector<MapQuestion> map_questions(bool full) {
  const std::string section = full ? "5x7,10x14,20x28,40x56" : "5x7,10x14";
  const std::string space = full ? "1x3x4,1x5x7,1x10x14,2x5x7" : "1x3x4,1x5x7";
  const std::string down = std::string(" --lambda-r ") + (full ? "1e-2:1e-8:/10" : "1e-2,1e-8");
  const std::string tangents = " --tangent primal-dual,full,frozen,wrong-sign";
  const std::string direct = " --no-continuation --max-iterations 100";
  return {{"section", "heap, section, Newton from rest", "heap",
           "--model section --method newton --elements " + section + down + tangents +
               " --line-search energy-slope,residual-norm,none" + direct,
           0.2, 0.8, 0.2},
          {"section_works", "heap, section, primal-dual", "heap",
           "--model section --method newton --elements " + section + down, 1, 1},
          {"section_point", "heap, section, interior point", "heap",
           "--model section --method interior-point --elements " + section, 1, 1},
          {"space", "heap, space, Newton from rest", "heap",
           "--model space --start rest --elements " + space + down + tangents +
               " --line-search residual-norm,none" + direct,
           0.1, 0.8, 0.2},
          {"space_works", "heap, space, primal-dual in full steps", "heap",
           "--model space --start rest --elements " + space + down +
               " --line-search none --no-continuation",
           1, 1},
          {"space_nested", "heap, space, nested meshes, coming down in λr", "heap",
           "--model space --start nested --elements " + space + down, 1, 1}};
}

void add_model_maps(Chapter& chapter, const std::vector<MapQuestion>& questions,
                    const std::function<void(double)>& progress) {
  chapter.text(
      "The heap as its section and in space, every cell one run of its program. At λr directly, "
      "with the tangent as it is, in primal-dual form, without η' and with its sign turned, and by "
      "each line search; below it what then works.");
  std::size_t done = 0;
  for (const MapQuestion& question : questions) {
    add_map(chapter, question);
    progress(static_cast<double>(++done) / static_cast<double>(questions.size()));
  }
}

void model_maps(Chapter& chapter, const Context& context) {
  add_model_maps(chapter, map_questions(context.full), context.progress);
}

}  // namespace talus::verification
