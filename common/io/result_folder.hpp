// The folder a run writes to. Files appear whole or not at all.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace talus::io {

/// An input only the user can mend; programs report it in one line and exit with 2.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ResultFolder {
 public:
  /// Creates the folder and its parents if need be. Throws UserError if it cannot be written to.
  explicit ResultFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// Writes to a temporary name, then renames. Throws UserError, e.g. on a full disk.
  void write(const std::string& name, const std::string& contents) const;

 private:
  std::filesystem::path path_;
};

}  // namespace talus::io
