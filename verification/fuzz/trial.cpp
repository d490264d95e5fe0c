#include "verification/fuzz/trial.hpp"

#include <cstring>
#include <stdexcept>

namespace talus::fuzz {
namespace fs = std::filesystem;

Programs::Programs(const fs::path& folder, const fs::path& scratch, double seconds)
    : time_limit(seconds), scratch_(scratch) {
  for (const char* name : {"chute", "bagnold", "heap", "cylinder", "manufactured", "verify"})
    programs_.push_back(read_program(fs::canonical(folder) / name));
}

const Program& Programs::named(const std::string& name) const {
  for (const Program& program : programs_)
    if (program.name == name) return program;
  throw std::runtime_error("no program " + name);
}

Command Programs::earlier_run(const std::string& name) const {
  std::vector<std::string> arguments = {"--plot"};
  if (name == "heap") arguments = {"--plot", "--elements", "3x4"};
  if (name == "manufactured") arguments = {"--elements", "4"};
  if (name == "cylinder")
    arguments = {"--plot", "--around", "16", "--loading", "0.01,0.02", "--lambda-r", "1e-2"};
  return {named(name).path, arguments, scratch_ / ("earlier_" + name)};
}

fs::path Programs::earlier_results(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const Command command = earlier_run(name);
  if (fs::create_directories(command.folder)) process::run(command);
  return command.folder / "results" / name;
}

Trial::Trial(const Programs& shared, Random draws, fs::path scratch)
    : programs(shared), random(draws), folder(std::move(scratch)) {}

Command Trial::command(const std::string& program, std::vector<std::string> arguments,
                       const std::string& subfolder) const {
  fs::create_directories(folder / subfolder);
  Command command{programs.named(program).path, std::move(arguments), folder / subfolder};
  command.time_limit = programs.time_limit;
  command.cpu_limit = programs.time_limit / 4;  // others may be computing too
  return command;
}

Outcome Trial::run(const Command& command) {
  const std::string subfolder = fs::relative(command.folder, folder).string();
  note(subfolder == "."
           ? shell_line(command)
           : "(mkdir -p " + subfolder + "; cd " + subfolder + "; " + shell_line(command) + ")");
  const Outcome outcome = process::run(command);
  look_at(outcome);
  return outcome;
}

void Trial::place_earlier_results(const std::string& program, const fs::path& results) {
  const fs::path earlier = programs.earlier_results(program);
  fs::create_directories(results);
  for (const auto& entry : fs::directory_iterator(earlier)) {
    const fs::path copy = results / entry.path().filename();
    fs::copy_file(entry.path(), copy);
    fs::last_write_time(copy, entry.last_write_time() - std::chrono::hours(1));
  }
  Command command = programs.earlier_run(program);
  command.arguments.push_back("--output=" + fs::relative(results, folder).string());
  note(shell_line(command));
}

void Trial::look_at(const Outcome& outcome) {
  if (expect(!outcome.hung, "did not end within the time limit"))
    expect(outcome.signal == 0, "crashed: " + std::string(strsignal(outcome.signal)));
  expect(outcome.code != 126 && outcome.code != 127, "could not be run");
}

void Trial::note(const std::string& line) {
  script_ += (script_.empty() ? "" : "; ") + line;
}

bool Trial::expect(bool holds, const std::string& fault) {
  if (!holds) faults_.push_back(fault);
  return holds;
}

std::string Trial::script() const {
  return "cd $(mktemp -d); " + script_;
}

}  // namespace talus::fuzz
