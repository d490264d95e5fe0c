// The parts of the paper study, one scene each.
#pragma once

#include <string>

#include "verification/harness/chapter.hpp"
#include "verification/harness/methods.hpp"

namespace talus::verification {

/// Where a check fails that a verdict rests on.
inline const std::string open_verdict = "open: a check of it fails";

/// A row of the table that compares the paper's statements with our numbers: `verdict` if the
/// checks that it rests on hold.
inline void add_finding(io::Table& findings, const std::string& item, const std::string& paper,
                        const std::string& ours, bool holds, const std::string& verdict) {
  findings.rows.push_back({item, paper, ours, holds ? verdict : open_verdict});
}

/// The paper's six meshes. Its b/h counts elements on the full width of the chute; we solve half.
inline const std::vector<int> paper_meshes = {5, 10, 20, 40, 80, 160};

/// On a uniform mesh; NaN if it fails.
inline oned::Solution solve_uniform(const oned::ShearScene& scene, int elements,
                                    const NamedMethod& method) {
  return solve_or_nan(scene, oned::boundaries(scene, {.elements = elements}), method.options);
}

/// Figs 2 to 5.
void add_chute(Chapter& chapter, io::Table& findings, const oned::ShearScene& chute,
               const Context& context);
/// Figs 6 to 8 and Table 1.
void add_bagnold(Chapter& chapter, io::Table& findings, const oned::ShearScene& bagnold,
                 const Context& context);
/// Fig. 7 and Table 1, and the chute, on the paper's three-dimensional meshes.
void add_space(Chapter& chapter, io::Table& findings, const oned::ShearScene& chute,
               const oned::ShearScene& bagnold);

/// The study of these scenes, in a chapter that is empty.
void paper_of(Chapter& chapter, const oned::ShearScene& chute, const oned::ShearScene& bagnold,
              const Context& context);

/// That of the paper's own.
void paper_study(Chapter& chapter, const Context& context);

}  // namespace talus::verification
