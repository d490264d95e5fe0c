#include "verification/runner.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <thread>

#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/solve/stopwatch.hpp"

namespace talus::verification {
namespace {

constexpr const char* chapter_file = "chapter.json";
constexpr int user_error = 2;  // exit status, as of the programs

// Figures, tables and checks of a chapter, as files.
void write_files(const io::ResultFolder& folder, const Chapter& chapter) {
  io::Table checks{"", {"check", "value", "lower", "upper", "holds"}, {}};
  for (const auto& check : chapter.checks)
    checks.rows.push_back({check.what, io::exact(check.value), io::exact(check.lower),
                           io::exact(check.upper), check.passed() ? "yes" : "no"});
  folder.write("checks.csv", io::to_csv(checks));
  int tables = 0;
  for (const auto& block : chapter.blocks) {
    if (const auto* table = std::get_if<io::Table>(&block))
      folder.write("table" + std::to_string(++tables) + ".csv", io::to_csv(*table));
    else if (const auto* figure = std::get_if<io::Figure>(&block))
      io::write_figure(folder, *figure, "svg");
  }
}

void run(const Study& study, const Context& context, const io::ResultFolder& folder) {
  const solve::Stopwatch watch;
  const Chapter chapter = study.run(context);
  const double seconds = watch.seconds();
  write_files(folder, chapter);
  const Written written = write_chapter(chapter, folder.path());
  const nlohmann::json contents = {{"title", written.title},       {"html", written.html},
                                   {"checks", written.checks},     {"held", written.held},
                                   {"failures", written.failures}, {"seconds", seconds}};
  folder.write(chapter_file, contents.dump());
}

Written read(const std::string& name, const std::filesystem::path& folder) {
  std::ifstream file(folder / chapter_file);
  const auto contents = nlohmann::json::parse(file);
  return {name,
          contents.at("title"),
          contents.at("html"),
          contents.at("checks"),
          contents.at("held"),
          contents.at("failures"),
          contents.at("seconds")};
}

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
  double mean() const {
    return std::accumulate(values_.begin(), values_.end(), 0.0) /
           static_cast<double>(values_.size());
  }

 private:
  std::size_t bytes_;
  std::span<double> values_;
};

}  // namespace

std::vector<Written> run_studies(const std::vector<Study>& studies, bool full,
                                 const io::ResultFolder& folder, const Report& report) {
  SharedFractions fractions(studies.size());
  std::map<pid_t, std::size_t> running;
  const auto folder_of = [&](std::size_t i) { return folder.path() / studies[i].name; };

  const auto start = [&](std::size_t i) {
    std::cout.flush();
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("no process for study " + studies[i].name);
    if (process > 0) {
      running[process] = i;
      return;
    }
    std::signal(SIGTERM, SIG_DFL);  // whatever handler the parent has
    int status = 0;
    try {
      run(studies[i], {full, [&](double fraction) { fractions[i] = fraction; }},
          io::ResultFolder(folder_of(i)));
    } catch (const std::exception& error) {
      std::cerr << "study " << studies[i].name << ": " << error.what() << '\n';
      status = dynamic_cast<const io::UserError*>(&error) ? user_error : 1;
    }
    _exit(status);
  };

  // None is left to write into the folder after we have given up.
  const auto give_up = [&](std::size_t i, int status) {
    for (const auto& [process, _] : running) {
      kill(process, SIGTERM);
      waitpid(process, nullptr, 0);
    }
    const std::string message = "study " + studies[i].name + " did not end well";
    if (WIFEXITED(status) && WEXITSTATUS(status) == user_error) throw io::UserError(message);
    throw std::runtime_error(message);
  };

  const auto wait_for_one = [&] {
    for (;;) {
      int status = 0;
      const pid_t process = waitpid(-1, &status, WNOHANG);
      if (process > 0) {
        const std::size_t i = running.at(process);
        running.erase(process);
        fractions[i] = 1;
        if (status != 0) give_up(i, status);
        return;
      }
      std::string names;
      for (const auto& [_, i] : running) names += (names.empty() ? "" : ", ") + studies[i].name;
      report(names, fractions.mean());
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  };

  const std::size_t cores = std::clamp(std::thread::hardware_concurrency(), 1U, 2U);
  for (const bool timing : {false, true})
    for (std::size_t i = 0; i < studies.size(); ++i) {
      if (studies[i].is_timing != timing) continue;
      while (running.size() >= (timing ? 1 : cores)) wait_for_one();
      start(i);
    }
  while (!running.empty()) wait_for_one();

  std::vector<Written> chapters;
  for (std::size_t i = 0; i < studies.size(); ++i)
    chapters.push_back(read(studies[i].name, folder_of(i)));
  return chapters;
}

}  // namespace talus::verification
