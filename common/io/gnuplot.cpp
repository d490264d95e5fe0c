#include "common/io/gnuplot.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <regex>
#include <sstream>
#include <thread>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/io/table.hpp"

namespace talus::io {
namespace {

using Clock = std::chrono::steady_clock;

// A file without a name, in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : file_(memfd_create(name, MFD_CLOEXEC)) {}
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return file_; }
  bool holds(const std::string& text) const {
    return ::write(file_, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
           lseek(file_, 0, SEEK_SET) == 0;
  }
  std::string contents() const {
    struct stat about {};
    if (fstat(file_, &about) != 0) return {};
    std::string all(static_cast<std::size_t>(about.st_size), '\0');
    std::size_t have = 0;
    while (have < all.size()) {
      const ssize_t more =
          pread(file_, all.data() + have, all.size() - have, static_cast<off_t>(have));
      if (more <= 0) return {};
      have += static_cast<std::size_t>(more);
    }
    return all;
  }

 private:
  int file_;
};

// Of the child: becomes gnuplot, leader of a group of processes.
[[noreturn]] void become_gnuplot(const std::filesystem::path& folder, const MemoryFile& script,
                                 const MemoryFile& output, const MemoryFile& complaint) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (dup2(complaint.descriptor(), STDERR_FILENO) >= 0 &&
      dup2(output.descriptor(), STDOUT_FILENO) >= 0 &&
      dup2(script.descriptor(), STDIN_FILENO) >= 0 && chdir(folder.c_str()) == 0)
    execlp("gnuplot", "gnuplot", static_cast<char*>(nullptr));
  const char* const why = std::strerror(errno);
  [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, why, std::strlen(why));
  _exit(127);
}

// Gnuplot repeats the line it stumbled over first.
std::string reason_in(const std::string& complaint) {
  std::istringstream lines(complaint);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos) continue;
    line.erase(0, start);
    if (std::regex_search(line, std::regex("line [0-9]+: "))) return line;
    if (first.empty()) first = line;
  }
  return first;
}

}  // namespace

bool gnuplot_is_available() {
  return std::system("command -v gnuplot >/dev/null 2>&1") == 0;
}

GnuplotRun run_gnuplot(const std::filesystem::path& folder, const std::string& script,
                       std::chrono::milliseconds limit) {
  if (!gnuplot_is_available()) return {"gnuplot is missing", ""};
  const MemoryFile input("script"), output("output"), complaint("complaint");
  if (!input.holds(script)) return {"no memory for gnuplot's script", ""};
  const pid_t process = fork();
  if (process < 0) return {"no process for gnuplot", ""};
  if (process == 0) become_gnuplot(folder, input, output, complaint);
  const auto end = Clock::now() + limit;
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    if (Clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    kill(-process, SIGKILL);
    kill(process, SIGKILL);  // had it not become a leader yet
    waitpid(process, &status, 0);
    return {"gnuplot took longer than " + rounded(std::chrono::duration<double>(limit).count(), 3) +
                " s",
            ""};
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {"", output.contents()};
  const std::string reason = reason_in(complaint.contents());
  return {"gnuplot failed" + (reason.empty() ? "" : ": " + reason), ""};
}

}  // namespace talus::io
