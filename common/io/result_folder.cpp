#include "common/io/result_folder.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <unistd.h>

namespace talus::io {
namespace {

const std::string part = ".part";

// The name that the file would have got, had it been finished.
std::string finished(const std::string& name) {
  const bool is_part = name.size() > 1 + part.size() && name[0] == '.' && name.ends_with(part);
  return is_part ? name.substr(1, name.size() - 1 - part.size()) : name;
}

// To a temporary name, then renamed.
void put(const std::string& option, const std::filesystem::path& target,
         const std::string& contents) {
  const auto unfinished = target.parent_path() / ("." + target.filename().string() + part);
  std::ofstream file(unfinished, std::ios::binary);
  file << contents;
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(unfinished, target, error);
  if (file && !error) return;
  std::filesystem::remove(unfinished, error);
  throw UserError(option + ": cannot write '" + target.string() + "'");
}

}  // namespace

ResultFolder::ResultFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!std::filesystem::is_directory(path_, error) || access(path_.c_str(), W_OK | X_OK) != 0)
    throw UserError("--output: '" + path_.string() + "' must be a folder that can be written to");
  // A lock on the folder itself needs no file in it, and the kernel gives it back.
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(lock_);
    throw UserError("--output: another run is writing to '" + path_.string() +
                    "'; give this one another folder");
  }
}

ResultFolder::~ResultFolder() {
  if (lock_ >= 0) close(lock_);
}

void ResultFolder::remove_older(const std::vector<std::string>& patterns) const {
  if (path_.empty()) return;
  std::error_code error;
  std::vector<std::filesystem::path> older;
  for (auto entry = std::filesystem::directory_iterator(path_, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    for (const std::string& pattern : patterns)
      if (fnmatch(pattern.c_str(), finished(entry->path().filename().string()).c_str(), 0) == 0) {
        older.push_back(entry->path());
        break;
      }
  for (const auto& file : older)
    if (!std::filesystem::is_directory(file, error) && !std::filesystem::remove(file, error))
      throw UserError("--output: cannot remove '" + file.string() + "', which an earlier run left");
}

void ResultFolder::write(const std::string& name, const std::string& contents) const {
  if (!path_.empty()) put("--output", path_ / name, contents);
}

void write_file(const std::string& option, const std::filesystem::path& file,
                const std::string& contents) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  put(option, file, contents);
}

void remove_file(const std::string& option, const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error) ||
      (!std::filesystem::remove(file, error) && error))
    throw UserError(option + ": '" + file.string() + "' is no file that can be replaced");
}

}  // namespace talus::io
