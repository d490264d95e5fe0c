// Which verifiers notice which mutants.
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "common/io/table.hpp"
#include "verification/mutants/copy.hpp"

namespace talus::mutants {

/// How far a mutant is pursued.
enum class Pursuit {
  first_kill,  ///< until a verifier notices it
  both,        ///< until a study and another test do
  all          ///< by every verifier that comes by it
};

/// What became of a mutant.
struct Verdict {
  std::string name;
  std::vector<std::string> killers = {};  ///< names of the verifiers that failed
  int tried = 0;                          ///< verifiers that came by it and were run
  double seconds = 0;
  bool is_killed() const { return !killers.empty(); }
  bool is_killed_by_a_study() const;
};

struct Campaign {
  std::filesystem::path copy, table;  ///< table: verdicts.csv, taken up again if it is of this code
  Pursuit pursuit = Pursuit::first_kill;
  double longest = std::numeric_limits<double>::infinity();  ///< verifiers of more seconds rest
  int jobs = 2;
};

/// A verdict for each mutant chosen, in their order, missing where the run was interrupted. A
/// verifier that fails, crashes or takes more than six times its time and 20 s kills. `tell` is
/// called with each verdict.
std::vector<std::optional<Verdict>> pursue(const Campaign& campaign,
                                           const std::vector<Mutant>& mutants,
                                           const std::vector<std::size_t>& chosen,
                                           const std::vector<Verifier>& verifiers,
                                           const std::function<void(const Verdict&)>& tell);

/// Of an area of the catalogue (or all): the mutants chosen that are not equivalent.
struct Score {
  std::string area;
  int mutants = 0, equivalent = 0, killed = 0, killed_by_studies = 0;
  int not_run = 0;  ///< without a verdict, equivalent or not
  /// Killed of all; NaN of none, and while some have no verdict: those left are the slow ones.
  double share() const;
};
std::vector<Score> scores(const std::vector<Mutant>& mutants,
                          const std::vector<std::size_t>& chosen,
                          const std::vector<std::optional<Verdict>>& verdicts);

/// Scores by area, the whole last.
io::Table score_table(const std::vector<Score>& scores, Pursuit pursuit);
/// What was not killed although it is not said to be equivalent, and what was although it is.
io::Table survivor_table(const std::vector<Mutant>& mutants,
                         const std::vector<std::optional<Verdict>>& verdicts);
/// A row a mutant.
io::Table mutant_table(const std::vector<Mutant>& mutants,
                       const std::vector<std::optional<Verdict>>& verdicts);

}  // namespace talus::mutants
