#include "common/io/result_folder.hpp"

#include <fstream>
#include <system_error>

#include <unistd.h>

namespace talus::io {

ResultFolder::ResultFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!std::filesystem::is_directory(path_) || access(path_.c_str(), W_OK | X_OK) != 0)
    throw UserError("--output: '" + path_.string() + "' must be a folder that can be written to");
}

void ResultFolder::write(const std::string& name, const std::string& contents) const {
  const auto target = path_ / name;
  const auto temporary = path_ / ("." + name + ".part");
  {
    std::ofstream file(temporary, std::ios::binary);
    file << contents;
    file.close();
    if (!file) {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      throw UserError("--output: cannot write '" + target.string() + "'");
    }
  }
  std::filesystem::rename(temporary, target);
}

}  // namespace talus::io
