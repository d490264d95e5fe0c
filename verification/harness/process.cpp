#include "verification/harness/process.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/io/shell.hpp"

namespace talus::process {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment(const Command& command) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!command.path || std::strncmp(*variable, "PATH=", 5) != 0) variables.push_back(*variable);
  if (command.path) variables.push_back("PATH=" + *command.path);
  return variables;
}

void limit(int resource, rlim_t amount, rlim_t beyond = 0) {
  const rlimit soft_and_hard{amount, amount + beyond};
  setrlimit(static_cast<__rlimit_resource>(resource), &soft_and_hard);
}

}  // namespace

std::string shell_line(const Command& command) {
  std::string line = io::shell_word(command.program.string());
  for (const std::string& argument : command.arguments) line += " " + io::shell_word(argument);
  if (command.stdout_is_full) line += " >/dev/full";
  if (command.path) line = "PATH=" + io::shell_word(*command.path) + " " + line;
  if (command.file_size)
    line = "prlimit --fsize=" + std::to_string(*command.file_size) + " env --ignore-signal=XFSZ " +
           line;
  return line;
}

// Between fork and exec only what a program with threads may call there.
Process::Process(const Command& command) : time_limit_(command.time_limit) {
  std::vector<std::string> words{command.program.string()}, variables = environment(command);
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  const std::vector<char*> argv = pointers_to(words), envp = pointers_to(variables);
  const std::string folder = command.folder.string();
  const auto cpu_seconds =
      static_cast<rlim_t>(std::ceil(command.cpu_limit.value_or(command.time_limit)));
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe for a program");
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("no process for a program");
  if (id_ == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int in = open("/dev/null", O_RDONLY);
    dup2(in, STDIN_FILENO);
    dup2(command.stdout_is_full ? open("/dev/full", O_WRONLY) : out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, cpu_seconds, 5);  // SIGXCPU first, which says why
    if (command.file_size) {
      signal(SIGXFSZ, SIG_IGN);
      limit(RLIMIT_FSIZE, *command.file_size);
    }
    if (chdir(folder.c_str()) != 0) _exit(126);
    execve(argv[0], argv.data(), envp.data());
    _exit(127);
  }
  setpgid(id_, id_);  // here too: whoever comes first
  close(out[1]);
  close(err[1]);
  output_[0] = out[0];
  output_[1] = err[0];
  for (const int end : output_) fcntl(end, F_SETFL, O_NONBLOCK);
}

Process::~Process() {
  kill(-id_, SIGKILL);
  if (!ended_) waitpid(id_, nullptr, 0);
  for (const int end : output_) close(end);
}

void Process::read_output() {
  char buffer[65536];
  std::string* const texts[] = {&outcome_.out, &outcome_.err};
  for (int i = 0; i < 2; ++i)
    for (ssize_t count; (count = read(output_[i], buffer, sizeof buffer)) > 0;)
      texts[i]->append(buffer, static_cast<std::size_t>(count));
}

bool Process::ends_within(double seconds) {
  const auto start = Clock::now();
  for (auto pause = std::chrono::microseconds(200); !ended_;
       pause = std::min(2 * pause, std::chrono::microseconds(10000))) {
    ended_ = waitpid(id_, &status_, WNOHANG) == id_;
    read_output();  // a full pipe would stop it
    if (ended_) break;
    const double left = seconds - seconds_since(start);
    if (left <= 0) return false;
    std::this_thread::sleep_for(
        std::min<std::chrono::duration<double>>(pause, std::chrono::duration<double>(left)));
  }
  return true;
}

void Process::send(int signal, bool to_group) {
  if (!ended_) kill(to_group ? -id_ : id_, signal);
}

Outcome Process::outcome() {
  if (!ends_within(time_limit_)) {
    send(SIGKILL, true);
    ends_within(time_limit_);
    outcome_.hung = true;
  }
  if (WIFEXITED(status_)) outcome_.code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) outcome_.signal = WTERMSIG(status_);
  outcome_.hung = outcome_.hung || outcome_.signal == SIGXCPU;
  return outcome_;
}

bool Process::leaves_nothing_running() const {
  const auto start = Clock::now();
  while (kill(-id_, 0) == 0) {
    if (seconds_since(start) > time_limit_ / 40) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

Outcome run(const Command& command) {
  return Process(command).outcome();
}

}  // namespace talus::process
