#include "verification/fuzz/campaign.hpp"

#include <mutex>
#include <ostream>

#include "common/io/progress.hpp"
#include "common/testing/temporary_folder.hpp"
#include "verification/harness/workers.hpp"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;

struct Task {
  const Kind* kind;
  int number;
};

std::vector<Task> tasks_of(const CampaignOptions& options) {
  std::vector<Task> tasks;
  for (const Kind& kind : options.kinds) {
    if (options.only) {
      tasks.push_back({&kind, *options.only});
      continue;
    }
    const int count = options.count.value_or(options.full ? kind.many : kind.few);
    for (int i = 0; i < count; ++i) tasks.push_back({&kind, i});
  }
  return tasks;
}

}  // namespace

io::Table Findings::table() const {
  io::Table table{"", {"kind", "outcome", "trials"}, {}};
  for (const auto& [kind, outcomes] : counts)
    for (const auto& [outcome, count] : outcomes)
      table.rows.push_back({kind, outcome, std::to_string(count)});
  return table;
}

Findings campaign(const CampaignOptions& options, const fs::path& folder, std::ostream& out) {
  const testing::TemporaryFolder scratch;
  const Programs programs(folder, scratch.path(), options.time_limit);
  const std::vector<Task> tasks = tasks_of(options);
  Findings findings;
  io::Progress progress;
  std::mutex mutex;
  std::size_t done = 0;

  const auto note = [&](const Task& task, const Trial& trial) {
    const std::lock_guard lock(mutex);
    ++findings.counts[task.kind->name][trial.outcome()];
    for (const std::string& fault : trial.faults()) {
      findings.faults.push_back({task.kind->name, trial.script(), fault, task.number});
      out << "FAULT " << fault << " | ./run fuzz --seed " << options.seed << " --kinds "
          << task.kind->name << " --only " << task.number << " | " << trial.script() << std::endl;
    }
    progress.show(task.kind->name + " " + std::to_string(task.number) + ", " +
                      std::to_string(findings.faults.size()) + " faults",
                  static_cast<double>(++done) / static_cast<double>(tasks.size()));
  };
  const bool is_done = process::in_parallel(options.jobs, tasks.size(), [&](std::size_t i) {
    const Task& task = tasks[i];
    const std::string name = task.kind->name + "_" + std::to_string(task.number);
    fs::create_directory(scratch.path() / name);
    Trial trial(programs, Random(options.seed, task.kind->name, task.number),
                scratch.path() / name);
    try {
      task.kind->run(trial);
    } catch (const std::exception& error) {
      trial.expect(false, std::string("the fuzz itself: ") + error.what());
    }
    std::error_code ignored;
    fs::remove_all(trial.folder, ignored);
    note(task, trial);
  });
  findings.interrupted = !is_done;
  return findings;
}

}  // namespace talus::fuzz
