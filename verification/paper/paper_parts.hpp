// The parts of the paper study, one scene each.
#pragma once

#include <string>

#include "twod/section.hpp"
#include "verification/harness/chapter.hpp"
#include "verification/harness/methods.hpp"

namespace talus::verification {

/// Where a check fails that a verdict rests on.
inline const std::string open_verdict = "open: a check of it fails";

/// A part of the page on which the paper stands beside us, item by item in its order: first a table
/// with a row for each, then what the paper states, what we find, the verdict, and the figure.
class PaperPage {
 public:
  /// The chapter and the context must outlive the page.
  PaperPage(Chapter& chapter, const Context& context, std::string lead);

  Chapter& chapter() { return chapter_; }
  const Context& context() const { return context_; }
  /// `verdict` is that of checks that hold.
  void item(const std::string& name, const std::string& paper, const std::string& ours, bool holds,
            const std::string& verdict);
  /// Answers the question of the study with the items that agree and with those that do not.
  void conclude();
  /// The paper's figure of that number, with what the user gave for it.
  void figure(io::Figure figure, const std::string& number,
              const std::vector<Awaited>& awaited = {});

 private:
  Chapter& chapter_;
  const Context& context_;
  std::size_t findings_;  // block of the table
  std::string agreeing_, differing_;
};

/// The paper's six meshes. Its b/h counts elements on the full width of the chute; we solve half.
inline const std::vector<int> paper_meshes = {5, 10, 20, 40, 80, 160};

/// On a uniform mesh; NaN if it fails.
inline oned::Solution solve_uniform(const oned::ShearScene& scene, int elements,
                                    const NamedMethod& method) {
  return solve_or_nan(scene, oned::boundaries(scene, {.elements = elements}), method.options);
}

/// Figs 2 to 5.
void add_chute(PaperPage& page, const oned::ShearScene& chute);
/// Figs 6 and 7, Table 1.
void add_bagnold(PaperPage& page, const oned::ShearScene& bagnold);
/// Fig. 7 and Table 1, and the chute, on the paper's three-dimensional meshes.
void add_space(PaperPage& page, const oned::ShearScene& chute, const oned::ShearScene& bagnold);
/// Fig. 8.
void add_onset(PaperPage& page);

/// Figs 2 to 8 and Table 1 of these scenes, in a chapter that is empty.
void paper_lines_of(Chapter& chapter, const oned::ShearScene& chute,
                    const oned::ShearScene& bagnold, const Context& context);
/// Figs 10 and 11 of such a section.
void paper_heap_of(Chapter& chapter, const twod::Section& section, const Context& context);

/// The parts of the study, with the paper's own scenes: Figs 2 to 8, 10 and 11, 12 to 16.
void paper_lines(Chapter& chapter, const Context& context);
void paper_heap(Chapter& chapter, const Context& context);
void paper_cylinder(Chapter& chapter, const Context& context);

/// The figures in which curves of others are drawn, with their panels as the paper has them.
std::vector<OpenFigure> open_figures_of_the_paper();

}  // namespace talus::verification
