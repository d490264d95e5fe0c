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
#include "verification/harness/merge.hpp"

namespace talus::verification {
namespace {

// Fractions done, written by the processes of the parts and read by ours.
class SharedFractions {
 public:
  explicit SharedFractions(std::size_t count)
      : bytes_(std::max<std::size_t>(count, 1) * sizeof(double)) {
    void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share between parts");
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

// A part and the study it is of.
struct Job {
  const Study& study;
  const Part& part;

  std::string name() const { return study.name_of(part); }
};

// In the order of the report.
std::vector<Job> jobs_of(const std::vector<Study>& studies) {
  std::vector<Job> jobs;
  for (const Study& study : studies)
    for (const Part& part : study.parts) jobs.push_back({study, part});
  return jobs;
}

// The order in which parts start: the longest first, those that measure time after all others.
std::vector<std::size_t> order_of_start(const std::vector<Job>& jobs, bool full) {
  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const Part &one = jobs[a].part, &other = jobs[b].part;
    if (one.is_timing != other.is_timing) return other.is_timing;
    return one.minutes.of(full) > other.minutes.of(full);
  });
  return order;
}

// The process of a part. Its exit status is 0 if it left a chapter, be it that of a failure.
[[noreturn]] void run_here(const Job& job, const Context& context,
                           const std::filesystem::path& folder) {
  int status = 0;
  try {
    const solve::Stopwatch watch;
    Chapter chapter{job.name(), job.study.question, {}, {}};
    try {
      job.part.run(chapter, context);
    } catch (const std::exception& error) {
      chapter =
          chapter_of_failure(job.study, job.part, std::string("did not end: ") + error.what());
    }
    write_chapter_files(io::ResultFolder(folder), chapter, context.full, watch.seconds());
  } catch (const std::exception& error) {
    std::cerr << job.name() << ": " << error.what() << '\n';
    status = 1;
  }
  _exit(status);
}

// Forks a process for the part, which ends with ours, however that ends.
pid_t start(const Job& job, const Context& context, const std::filesystem::path& folder) {
  std::cout.flush();
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process for " + job.name());
  if (process > 0) return process;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it ended before it could be asked for
  // No handler of the parent: what ends a part shall be seen.
  for (const int each : {SIGTERM, SIGINT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(each, SIG_DFL);
  run_here(job, context, folder);
}

std::string reason_of(int status) {
  if (WIFSIGNALED(status)) return "killed by signal " + std::to_string(WTERMSIG(status));
  return "exit status " + std::to_string(WEXITSTATUS(status));
}

// Of the minutes that the parts say they take.
double fraction_done(const std::vector<Job>& jobs, const SharedFractions& fractions, bool full) {
  double done = 0, all = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const double minutes = std::max(jobs[i].part.minutes.of(full), 1e-3);
    done += minutes * fractions[i];
    all += minutes;
  }
  return done / all;
}

// Parts that run; none is left when it goes.
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
  void add(pid_t process, std::size_t part) { processes_[process] = part; }
  /// The part that has ended and how, if one has.
  std::optional<std::pair<std::size_t, int>> take_ended() {
    for (const auto& [process, part] : processes_) {
      int status = 0;
      if (waitpid(process, &status, WNOHANG) != process) continue;
      const std::pair ended(part, status);
      processes_.erase(process);
      return ended;
    }
    return std::nullopt;
  }
  std::vector<std::size_t> parts() const {
    std::vector<std::size_t> all;
    for (const auto& [_, part] : processes_) all.push_back(part);
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
  const std::vector<Job> jobs = jobs_of(studies);
  SharedFractions fractions(jobs.size());
  Running running;
  const auto folder_of = [&](const Job& job) { return folder.path() / job.name(); };
  // What stands where a part leaves no chapter of its own.
  const auto write_failure = [&](const Job& job, const std::string& reason) {
    write_chapter_files(io::ResultFolder(folder_of(job)),
                        chapter_of_failure(job.study, job.part, "did not end: " + reason),
                        options.full, 0);
  };
  for (const Job& job : jobs) {
    remove_chapter(io::ResultFolder(folder_of(job)));
    write_failure(job, "it left no chapter");
  }
  const auto wait_for_one = [&] {
    for (;;) {
      if (const auto ended = running.take_ended()) {
        const auto [i, status] = *ended;
        fractions[i] = 1;
        if (status != 0) write_failure(jobs[i], reason_of(status));
        return;
      }
      std::string names;
      for (const std::size_t i : running.parts())
        names += (names.empty() ? "" : ", ") + jobs[i].name();
      report(names, fraction_done(jobs, fractions, options.full));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  };

  for (const std::size_t i : order_of_start(jobs, options.full)) {
    const std::size_t beside =
        jobs[i].part.is_timing ? 0 : static_cast<std::size_t>(options.jobs) - 1;
    while (running.count() > beside) wait_for_one();
    const Context context{
        options.full, [&fractions, i](double fraction) { fractions[i] = fraction; }, options.given};
    running.add(start(jobs[i], context, folder_of(jobs[i])), i);
  }
  while (running.count() > 0) wait_for_one();
  Found parts;
  for (const Job& job : jobs) parts.folders[job.name()] = folder_of(job);
  return merge_studies(studies, parts, folder);
}

double expected_minutes(const std::vector<Study>& studies, const RunOptions& options) {
  const std::vector<Job> jobs = jobs_of(studies);
  std::vector<double> busy_until(static_cast<std::size_t>(options.jobs), 0);
  for (const std::size_t i : order_of_start(jobs, options.full)) {
    const double minutes = jobs[i].part.minutes.of(options.full);
    if (jobs[i].part.is_timing)  // alone: after all, before all
      std::ranges::fill(busy_until, std::ranges::max(busy_until) + minutes);
    else
      *std::ranges::min_element(busy_until) += minutes;
  }
  return std::ranges::max(busy_until);
}

}  // namespace talus::verification
