// The page of the paper, and its part of one dimension: Figs 2 to 8 and Table 1.
#include "verification/paper/paper_parts.hpp"

namespace talus::verification {

PaperPage::PaperPage(Chapter& chapter, const Context& context, std::string lead)
    : chapter_(chapter), context_(context) {
  chapter_.text(std::move(lead));
  findings_ = chapter_.blocks.size();
  chapter_.table(
      {"What the paper states and what we find", {"item", "the paper", "ours", "verdict"}, {}});
}

void PaperPage::item(const std::string& name, const std::string& paper, const std::string& ours,
                     bool holds, const std::string& verdict) {
  const std::string found = holds ? verdict : open_verdict;
  std::get<io::Table>(chapter_.blocks[findings_]).rows.push_back({name, paper, ours, found});
  chapter_.text(name + ". The paper: " + paper + ". Here: " + ours + ". Verdict: " + found + ".");
  std::string& names = found.starts_with("agrees") ? agreeing_ : differing_;
  names += (names.empty() ? "" : ", ") + name;
}

void PaperPage::conclude() {
  if (!agreeing_.empty()) chapter_.answer("Agree with the paper: " + agreeing_ + ".");
  if (!differing_.empty())
    chapter_.answer("Agree in part, differ or have no numbers to compare: " + differing_ + ".");
}

void PaperPage::figure(io::Figure figure, const std::string& number,
                       const std::vector<Awaited>& awaited) {
  if (figure.panels.size() > 1)
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
      figure.panels[i].title = name_of_panel(i) + ": " + figure.panels[i].title;
  chapter_.figure(with_given_curves(std::move(figure), number, context_.given, awaited));
}

std::vector<OpenFigure> open_figures_of_the_paper() {
  return {{"2", 4}, {"3", 2},  {"4", 4},  {"5", 2},  {"6", 3}, {"7", 1},
          {"8", 1}, {"10", 2}, {"11", 3}, {"12", 4}, {"15", 2}};
}

void paper_lines_of(Chapter& chapter, const oned::ShearScene& chute,
                    const oned::ShearScene& bagnold, const Context& context) {
  PaperPage page(
      chapter, context,
      "Chauchat & Médale's figures and table, in their order, with their parameters and in their "
      "layout. First what they solve along one line: in one dimension here, Fig. 7 and Table 1 in "
      "three as well, on meshes one element thick in the other directions as theirs are. (Fig. 9 "
      "is "
      "a sketch, as is Fig. 1.)");
  add_chute(page, chute);
  context.progress(0.5);
  add_bagnold(page, bagnold);
  add_space(page, chute, bagnold);
  context.progress(0.9);
  add_onset(page);
  page.conclude();
}

void paper_lines(Chapter& chapter, const Context& context) {
  paper_lines_of(chapter, scene_of(oned::Chute{}), scene_of(oned::Bagnold{}), context);
}

}  // namespace talus::verification
