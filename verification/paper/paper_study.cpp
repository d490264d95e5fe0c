// The paper's one-dimensional figures and table with its own parameters, and what became of them.
#include "verification/paper/paper_parts.hpp"

namespace talus::verification {

void paper_of(Chapter& chapter, const oned::ShearScene& chute, const oned::ShearScene& bagnold,
              const Context& context) {
  chapter.text(
      "Chauchat & Médale's one-dimensional results with their parameters, in one dimension; Fig. 7 "
      "and Table 1 in three as well, on meshes one element thick in the other directions as "
      "theirs are.");
  io::Table findings{
      "What the paper states and what we find", {"item", "the paper", "ours", "verdict"}, {}};
  add_chute(chapter, findings, chute, context);
  add_bagnold(chapter, findings, bagnold, context);
  context.progress(0.9);
  add_space(chapter, findings, chute, bagnold);
  chapter.blocks.insert(chapter.blocks.begin() + 1, findings);
}

void paper_study(Chapter& chapter, const Context& context) {
  paper_of(chapter, scene_of(oned::Chute{}), scene_of(oned::Bagnold{}), context);
}

}  // namespace talus::verification
