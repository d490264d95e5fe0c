#include "verification/harness/runner.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <thread>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/solve/stopwatch.hpp"
#include "verification/harness/chapter_file.hpp"

namespace talus::verification {
namespace {

// Fractions done, written by the processes of the studies and read by ours.
class SharedFractions {
 public:
  explicit SharedFractions(std::size_t count)
      : bytes_(std::max<std::size_t>(count, 1) * sizeof(double)) {
    void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share between studies");
    values_ = {static_cast<double*>(memory), count};
  }
  ~SharedFractions() { munmap(values_.data(), bytes_); }
  SharedFractions(const SharedFractions&) = delete;
  SharedFractions& operator=(const SharedFractions&) = delete;

  double& operator[](std::size_t i) { return values_[i]; }
  double operator[](std::size_t i) const { return values_[i]; }

 private:
  std::size_t bytes_;
  std::span<double> values_;
};

// The order in which studies start: the longest first, those that measure time after all others.
std::vector<std::size_t> order_of_start(const std::vector<Study>& studies, bool full) {
  std::vector<std::size_t> order(studies.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    if (studies[a].is_timing != studies[b].is_timing) return studies[b].is_timing;
    return studies[a].minutes.of(full) > studies[b].minutes.of(full);
  });
  return order;
}

// The process of a study. Its exit status is 0 if it left a chapter, be it that of a failure.
[[noreturn]] void run_here(const Study& study, const Context& context,
                           const std::filesystem::path& folder) {
  int status = 0;
  try {
    const solve::Stopwatch watch;
    Chapter chapter;
    try {
      chapter = study.run(context);
    } catch (const std::exception& error) {
      chapter = chapter_of_failure(study, error.what());
    }
    write_chapter_files(io::ResultFolder(folder), chapter, watch.seconds());
  } catch (const std::exception& error) {
    std::cerr << "study " << study.name << ": " << error.what() << '\n';
    status = 1;
  }
  _exit(status);
}

// Forks a process for the study, which ends with ours, however that ends.
pid_t start(const Study& study, const Context& context, const std::filesystem::path& folder) {
  std::cout.flush();
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process for study " + study.name);
  if (process > 0) return process;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it ended before it could be asked for
  // No handler of the parent: what ends a study shall be seen.
  for (const int each : {SIGTERM, SIGINT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(each, SIG_DFL);
  run_here(study, context, folder);
}

std::string reason_of(int status) {
  if (WIFSIGNALED(status)) return "killed by signal " + std::to_string(WTERMSIG(status));
  return "exit status " + std::to_string(WEXITSTATUS(status));
}

// Studies that run; none is left when it goes.
class Running {
 public:
  Running() = default;
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    for (const auto& [process, _] : processes_) {
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
  }

  std::size_t count() const { return processes_.size(); }
  void add(pid_t process, std::size_t study) { processes_[process] = study; }
  /// The study that has ended and how, if one has.
  std::optional<std::pair<std::size_t, int>> take_ended() {
    for (const auto& [process, study] : processes_) {
      int status = 0;
      if (waitpid(process, &status, WNOHANG) != process) continue;
      const std::pair ended(study, status);
      processes_.erase(process);
      return ended;
    }
    return std::nullopt;
  }
  std::vector<std::size_t> studies() const {
    std::vector<std::size_t> all;
    for (const auto& [_, study] : processes_) all.push_back(study);
    return all;
  }

 private:
  std::map<pid_t, std::size_t> processes_;
};

}  // namespace

int default_jobs() {
  return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 2U));
}

std::vector<Written> run_studies(const std::vector<Study>& studies, const RunOptions& options,
                                 const io::ResultFolder& folder, const Report& report) {
  SharedFractions fractions(studies.size());
  Running running;
  std::vector<std::string> failures(studies.size());  // why a study left no chapter
  const auto folder_of = [&](std::size_t i) { return folder.path() / studies[i].name; };
  for (std::size_t i = 0; i < studies.size(); ++i) remove_chapter(io::ResultFolder(folder_of(i)));

  // Of the minutes that the studies say they take.
  const auto fraction_done = [&] {
    double done = 0, all = 0;
    for (std::size_t i = 0; i < studies.size(); ++i) {
      const double minutes = std::max(studies[i].minutes.of(options.full), 1e-3);
      done += minutes * fractions[i];
      all += minutes;
    }
    return done / all;
  };
  const auto wait_for_one = [&] {
    for (;;) {
      if (const auto ended = running.take_ended()) {
        const auto [i, status] = *ended;
        fractions[i] = 1;
        if (status != 0) failures[i] = reason_of(status);
        return;
      }
      std::string names;
      for (const std::size_t i : running.studies())
        names += (names.empty() ? "" : ", ") + studies[i].name;
      report(names, fraction_done());
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  };

  for (const std::size_t i : order_of_start(studies, options.full)) {
    const std::size_t beside =
        studies[i].is_timing ? 0 : static_cast<std::size_t>(options.jobs) - 1;
    while (running.count() > beside) wait_for_one();
    const Context context{options.full,
                          [&fractions, i](double fraction) { fractions[i] = fraction; }};
    running.add(start(studies[i], context, folder_of(i)), i);
  }
  while (running.count() > 0) wait_for_one();

  std::vector<Written> chapters;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    if (failures[i].empty() && !has_chapter(folder_of(i))) failures[i] = "it left no chapter";
    if (!failures[i].empty())
      write_chapter_files(io::ResultFolder(folder_of(i)),
                          chapter_of_failure(studies[i], failures[i]), 0);
    chapters.push_back(read_chapter(studies[i].name, folder_of(i)));
  }
  return chapters;
}

double expected_minutes(const std::vector<Study>& studies, const RunOptions& options) {
  std::vector<double> busy_until(static_cast<std::size_t>(options.jobs), 0);
  for (const std::size_t i : order_of_start(studies, options.full)) {
    if (studies[i].is_timing)  // alone: after all, before all
      std::ranges::fill(busy_until,
                        std::ranges::max(busy_until) + studies[i].minutes.of(options.full));
    else
      *std::ranges::min_element(busy_until) += studies[i].minutes.of(options.full);
  }
  return std::ranges::max(busy_until);
}

}  // namespace talus::verification
