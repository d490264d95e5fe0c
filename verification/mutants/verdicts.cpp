#include "verification/mutants/verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>

#include "common/io/checksum.hpp"
#include "common/io/options.hpp"
#include "common/io/result_folder.hpp"
#include "common/testing/temporary_folder.hpp"
#include "verification/harness/workers.hpp"
#include "verification/mutants/verifier_run.hpp"

namespace talus::mutants {
namespace {

bool is_study(const std::string& verifier) {
  return Verifier{verifier, {}, {}}.is_study();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// Those that come by it and take no longer than is wanted.
std::vector<Verifier> verifiers_of(int number, const Campaign& campaign,
                                   const std::vector<Verifier>& verifiers) {
  std::vector<Verifier> some;
  for (const Verifier& verifier : verifiers)
    if (verifier.reached.contains(number) && verifier.seconds <= campaign.longest)
      some.push_back(verifier);
  return some;
}

// `verifiers`: those that come by it.
Verdict pursue_one(const Mutant& mutant, int number, Pursuit pursuit,
                   const std::vector<Verifier>& verifiers) {
  Verdict verdict{mutant.name};
  bool has_study = false, has_test = false;
  for (const Verifier& verifier : verifiers) {
    bool& is_noticed = verifier.is_study() ? has_study : has_test;
    if (pursuit == Pursuit::first_kill && verdict.is_killed()) break;
    if (pursuit == Pursuit::both && is_noticed) continue;
    const Run run = run_verifier(verifier, {"TALUS_MUTANT=" + std::to_string(number)},
                                 20 + 6 * verifier.seconds);
    ++verdict.tried;
    verdict.seconds += run.seconds;
    if (run.outcome.is_success()) continue;
    is_noticed = true;
    verdict.killers.push_back(verifier.name);
  }
  return verdict;
}

// The table of verdicts on disk: a first line that says of what code and how far pursued, then
// name, verifiers tried, seconds, killers. A survivor of the quicker verifiers is pursued anew when
// longer ones are wanted.
class Memory {
 public:
  Memory(const Campaign& campaign, const std::vector<Verifier>& verifiers) : path_(campaign.table) {
    std::string names;
    for (const Verifier& verifier : verifiers) names += verifier.name + " ";
    const std::string head =
        fingerprint(campaign.copy) + "," + std::to_string(static_cast<int>(campaign.pursuit)) +
        "," + (campaign.pursuit == Pursuit::first_kill ? "" : io::exact(campaign.longest)) + "," +
        io::checksum(names);
    std::ifstream in(path_);
    std::string line;
    if (std::getline(in, line) && line == head) {
      while (std::getline(in, line)) {
        const std::vector<std::string> cells = io::split(line, ',');
        if (cells.size() != 4) continue;  // cut short
        Verdict verdict{cells[0], {}, std::stoi(cells[1]), io::number_in(cells[2])};
        if (!cells[3].empty()) verdict.killers = io::split(cells[3], ' ');
        known_[cells[0]] = verdict;
      }
      return;
    }
    in.close();
    io::write_file("--output", path_, head + "\n");
  }

  // Nothing if so many verifiers say more than those that were tried.
  std::optional<Verdict> verdict(const std::string& name, std::size_t verifiers) const {
    const auto found = known_.find(name);
    if (found == known_.end()) return std::nullopt;
    const bool is_final =
        found->second.is_killed() || static_cast<std::size_t>(found->second.tried) >= verifiers;
    return is_final ? std::optional(found->second) : std::nullopt;
  }

  void add(const Verdict& verdict) const {
    std::ofstream(path_, std::ios::app)
        << verdict.name << ',' << verdict.tried << ',' << io::exact(verdict.seconds) << ','
        << joined(verdict.killers) << std::endl;
  }

 private:
  std::filesystem::path path_;
  std::map<std::string, Verdict> known_;
};

}  // namespace

bool Verdict::is_killed_by_a_study() const {
  return std::ranges::any_of(killers, is_study);
}

std::vector<std::optional<Verdict>> pursue(const Campaign& campaign,
                                           const std::vector<Mutant>& mutants,
                                           const std::vector<std::size_t>& chosen,
                                           const std::vector<Verifier>& verifiers,
                                           const std::function<void(const Verdict&)>& tell) {
  const Memory memory(campaign, verifiers);
  std::vector<std::optional<Verdict>> verdicts(mutants.size());
  std::vector<std::size_t> left;
  for (const std::size_t i : chosen) {
    const auto some = verifiers_of(static_cast<int>(i), campaign, verifiers);
    verdicts[i] = memory.verdict(mutants[i].name, some.size());
    if (!verdicts[i]) left.push_back(i);
  }
  std::mutex mutex;
  process::in_parallel(campaign.jobs, left.size(), [&](std::size_t k) {
    const std::size_t i = left[k];
    const Verdict verdict = pursue_one(mutants[i], static_cast<int>(i), campaign.pursuit,
                                       verifiers_of(static_cast<int>(i), campaign, verifiers));
    const std::lock_guard lock(mutex);
    if (process::interrupted()) return;
    verdicts[i] = verdict;
    memory.add(verdict);
    tell(verdict);
  });
  return verdicts;
}

double Score::share() const {
  return not_run > 0 || mutants == 0 ? std::numeric_limits<double>::quiet_NaN()
                                     : static_cast<double>(killed) / mutants;
}

std::vector<Score> scores(const std::vector<Mutant>& mutants,
                          const std::vector<std::size_t>& chosen,
                          const std::vector<std::optional<Verdict>>& verdicts) {
  std::map<std::string, Score> areas;
  Score whole{"all"};
  for (const std::size_t i : chosen) {
    const std::string area = mutants[i].name.substr(0, mutants[i].name.find('/'));
    areas[area].area = area;
    for (Score* score : {&areas[area], &whole}) {
      ++(mutants[i].is_equivalent() ? score->equivalent : score->mutants);
      if (!verdicts[i]) ++score->not_run;
      if (!verdicts[i] || mutants[i].is_equivalent()) continue;
      score->killed += verdicts[i]->is_killed();
      score->killed_by_studies += verdicts[i]->is_killed_by_a_study();
    }
  }
  std::vector<Score> all;
  for (const auto& [area, score] : areas) all.push_back(score);
  all.push_back(whole);
  return all;
}

io::Table score_table(const std::vector<Score>& scores, Pursuit pursuit) {
  io::Table table{"", {"area", "mutants", "killed", "share", "equivalent", "not run"}, {}};
  const bool has_studies = pursuit != Pursuit::first_kill;
  if (has_studies) table.header.emplace_back("by studies");
  for (const Score& score : scores) {
    table.rows.push_back(
        {score.area, std::to_string(score.mutants), std::to_string(score.killed),
         std::isnan(score.share()) ? "-" : io::fixed(100 * score.share(), 1) + " %",
         std::to_string(score.equivalent), std::to_string(score.not_run)});
    if (has_studies) table.rows.back().push_back(std::to_string(score.killed_by_studies));
  }
  return table;
}

io::Table survivor_table(const std::vector<Mutant>& mutants,
                         const std::vector<std::optional<Verdict>>& verdicts) {
  io::Table table{"", {"mutant", "what it stands for", "file", "verifiers tried"}, {}};
  for (std::size_t i = 0; i < mutants.size(); ++i)
    if (verdicts[i] && verdicts[i]->is_killed() == mutants[i].is_equivalent())
      table.rows.push_back({mutants[i].name, mutants[i].what, mutants[i].file.string(),
                            std::to_string(verdicts[i]->tried)});
  return table;
}

io::Table mutant_table(const std::vector<Mutant>& mutants,
                       const std::vector<std::optional<Verdict>>& verdicts) {
  io::Table table{
      "", {"mutant", "what it stands for", "file", "killed by", "equivalent because"}, {}};
  for (std::size_t i = 0; i < mutants.size(); ++i)
    if (verdicts[i])
      table.rows.push_back({mutants[i].name, mutants[i].what, mutants[i].file.string(),
                            joined(verdicts[i]->killers), mutants[i].equivalent});
  return table;
}

}  // namespace talus::mutants
