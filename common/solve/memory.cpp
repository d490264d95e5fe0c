#include "common/solve/memory.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

namespace talus::solve {
namespace {

namespace fs = std::filesystem;
constexpr double unlimited = std::numeric_limits<double>::infinity();

// The number after a key in a file of keys and numbers, such as /proc/meminfo.
std::optional<double> number_after(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  std::string word;
  double number = 0;
  while (in >> word)
    if (word == key && in >> number) return number;
  return std::nullopt;
}

// "max" and other words are no numbers.
std::optional<double> number_in(const fs::path& file) {
  std::ifstream in(file);
  double number = 0;
  if (in >> number) return number;
  return std::nullopt;
}

double free_in_machine() {
  const auto kibibytes = number_after("/proc/meminfo", "MemAvailable:");
  return kibibytes ? 1024 * *kibibytes : unlimited;
}

// What a group and those above it leave. Pages of files count as used there, but can be dropped.
double free_in_groups(const fs::path& root, const fs::path& group, const char* limit_file,
                      const char* usage_file, const char* cache_key) {
  double least = unlimited;
  for (fs::path path = group.relative_path();; path = path.parent_path()) {
    const fs::path folder = root / path;
    const auto limit = number_in(folder / limit_file), usage = number_in(folder / usage_file);
    if (limit && usage)
      least = std::min(
          least, *limit - *usage + number_after(folder / "memory.stat", cache_key).value_or(0));
    if (path.empty()) return least;
  }
}

double free_in_control_groups() {
  double least = unlimited;
  std::ifstream groups("/proc/self/cgroup");  // number:controllers:path
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path path = line.substr(second + 1);
    if (controllers.empty())
      least = std::min(
          least, free_in_groups("/sys/fs/cgroup", path, "memory.max", "memory.current", "file"));
    else if (("," + controllers + ",").find(",memory,") != std::string::npos)
      least = std::min(least, free_in_groups("/sys/fs/cgroup/memory", path, "memory.limit_in_bytes",
                                             "memory.usage_in_bytes", "total_cache"));
  }
  return least;
}

double left_of(int resource, const char* used_key) {
  rlimit limit{};
  if (getrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit) != 0 ||
      limit.rlim_cur == RLIM_INFINITY)
    return unlimited;
  return static_cast<double>(limit.rlim_cur) -
         1024 * number_after("/proc/self/status", used_key).value_or(0);
}

}  // namespace

double available_memory() {
  return std::max(0.0, std::min({free_in_machine(), free_in_control_groups(),
                                 left_of(RLIMIT_AS, "VmSize:"), left_of(RLIMIT_DATA, "VmData:")}));
}

std::string in_gigabytes(double bytes) {
  const double gigabytes = bytes / 1e9;
  std::ostringstream text;
  text.setf(std::ios::fixed);
  const double decimals = 1 - std::floor(std::log10(std::max(gigabytes, 1e-3)));
  text.precision(decimals > 0 ? static_cast<int>(std::min(decimals, 4.0)) : 0);  // 0 of no number
  text << gigabytes << " GB";
  return text.str();
}

OutOfMemory::OutOfMemory(const std::string& purpose, double bytes)
    : message_(purpose + " need about " + in_gigabytes(bytes) + " of memory, " +
               in_gigabytes(available_memory()) + " are available") {}

void require_memory(const std::string& purpose, double bytes) {
  constexpr double small = 1e8;  // not worth looking up what there is
  if (bytes > small && bytes > available_memory()) throw OutOfMemory(purpose, bytes);
}

}  // namespace talus::solve
