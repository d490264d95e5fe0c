// A folder of results, looked at from outside.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace talus::fuzz {

struct FileMark {
  std::filesystem::file_time_type written;
  std::uintmax_t size = 0;
  bool operator==(const FileMark&) const = default;
};

/// Files under the folder by their relative names; none if there is no such folder.
std::map<std::string, FileMark> listing(const std::filesystem::path& folder);

std::string contents_of(const std::filesystem::path& file);

/// The object in the file; null if it is none.
nlohmann::json json_in(const std::filesystem::path& file);

/// What is wrong with the files under the folder, as of a run that was not interrupted: torn files,
/// and temporary ones left behind.
std::vector<std::string> torn_files(const std::filesystem::path& folder);
std::vector<std::string> files_left_behind(const std::filesystem::path& folder);

/// Numbers that are none: null in results of a summary, nan or inf in tables and grids.
std::vector<std::string> numbers_that_are_none(const std::filesystem::path& folder);

/// Whether a text has nan or inf as a word.
bool has_no_number(const std::string& text);

/// Files in which two folders of results differ; times and memory aside.
std::vector<std::string> differences(const std::filesystem::path& a,
                                     const std::filesystem::path& b);

/// Whether a summary's parameter is what was meant: numbers to rounding, of an object the keys
/// meant.
bool is_same(const nlohmann::json& meant, const nlohmann::json& recorded);

}  // namespace talus::fuzz
