// The folder a run writes to: one run at a time, and nothing in it that is older. Files appear
// whole or not at all.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus::io {

/// An input only the user can mend; programs report it in one line and exit with 2.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ResultFolder {
 public:
  /// Creates the folder and its parents if need be, and holds it against other runs until it is
  /// destroyed or the process (with those forked from it) ends. Throws UserError if it cannot be
  /// written to or another run holds it. Where the file system knows no locks it is not held.
  explicit ResultFolder(std::filesystem::path path);
  /// Nowhere: what is written is lost. For a run of which only a record is wanted.
  ResultFolder() = default;
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  bool is_nowhere() const { return path_.empty(); }

  /// Removes what an earlier run left: the files whose names match one of `patterns` (as in a
  /// shell), and what it was killed writing of them. To be called when the input is known to be
  /// good, with all the names that the program ever writes. Throws UserError.
  void remove_older(const std::vector<std::string>& patterns) const;

  /// Writes to a temporary name, then renames. Throws UserError, e.g. on a full disk.
  void write(const std::string& name, const std::string& contents) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// Writes a file that an option names, whole or not at all, its folder too. Throws UserError.
void write_file(const std::string& option, const std::filesystem::path& file,
                const std::string& contents);

/// Removes it if it is there. Throws UserError.
void remove_file(const std::string& option, const std::filesystem::path& file);

}  // namespace talus::io
