#include "verification/fuzz/folder.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool ends_with(std::string text, const std::string& end) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  return text.ends_with(end);
}

// Rows of as many cells as the header has, the last one ended.
bool is_whole_table(const std::string& text) {
  const auto cells = [](const std::string& row) {
    bool quoted = false;
    std::ptrdiff_t count = 1;
    for (const char c : row) {
      quoted = quoted != (c == '"');
      count += c == ',' && !quoted;
    }
    return count;
  };
  std::istringstream in(text);
  std::string header, row;
  if (!text.ends_with('\n') || !std::getline(in, header)) return false;
  while (std::getline(in, row))
    if (cells(row) != cells(header)) return false;
  return true;
}

bool is_whole(const fs::path& file) {
  const std::string text = contents_of(file), ending = file.extension().string();
  if (ending == ".json") return json_in(file).is_object();
  if (ending == ".csv") return is_whole_table(text);
  if (ending == ".png")
    return text.starts_with("\x89PNG\r\n\x1a\n") &&
           text.ends_with(std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12));
  if (ending == ".svg") return text.starts_with("<?xml") && ends_with(text, "</svg>");
  if (ending == ".vtu" || ending == ".pvd") return ends_with(text, "</VTKFile>");
  if (ending == ".html") return ends_with(text, "</html>");
  if (ending == ".gp") return ends_with(text, "set output");
  if (ending == ".dat") return ends_with(text, "") && text.ends_with('\n');
  return true;
}

bool has_null(const json& value) {
  if (value.is_structured())
    return std::any_of(value.begin(), value.end(), [](const json& each) { return has_null(each); });
  return value.is_null();
}

// What the same flow, asked for in other words, may differ in.
json without_times_and_words(json value) {
  for (const char* each_run : {"seconds", "section_seconds", "cpu_seconds", "wall_seconds",
                               "peak_memory", "command", "case", "options"})
    if (value.is_object()) value.erase(each_run);
  if (value.is_structured())
    for (json& each : value) each = without_times_and_words(each);
  return value;
}

}  // namespace

std::map<std::string, FileMark> listing(const fs::path& folder) {
  std::map<std::string, FileMark> files;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = {entry.last_write_time(),
                                                            entry.file_size()};
  return files;
}

std::string contents_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

json json_in(const fs::path& file) {
  json value = json::parse(contents_of(file), nullptr, false);
  return value.is_object() ? value : json();
}

std::vector<std::string> torn_files(const fs::path& folder) {
  std::vector<std::string> torn;
  for (const auto& [name, mark] : listing(folder))
    if (!fs::path(name).filename().string().starts_with('.') && !is_whole(folder / name))
      torn.push_back(name);
  return torn;
}

std::vector<std::string> files_left_behind(const fs::path& folder) {
  std::vector<std::string> left;
  for (const auto& [name, mark] : listing(folder))
    if (fs::path(name).filename().string().starts_with('.') && mark.size > 0) left.push_back(name);
  return left;
}

bool has_no_number(const std::string& text) {
  static const std::regex none(R"((^|[\s,=(\[>"-])(nan|inf|infinity)($|[\s,;:.)\]<"]))",
                               std::regex::icase);
  // The machine's regex walks slowly through large files.
  std::string lower;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if ((text[at] | 32) != 'n' && (text[at] | 32) != 'i') continue;
    lower = text.substr(at == 0 ? 0 : at - 1, 12);
    if (std::regex_search(lower, none)) return true;
  }
  return false;
}

std::vector<std::string> numbers_that_are_none(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& [name, mark] : listing(folder)) {
    const std::string ending = fs::path(name).extension().string();
    if (ending == ".json") {
      json summary = json_in(folder / name);
      if (summary.is_object()) summary.erase("parameters");  // null: not asked for
      if (has_null(summary)) found.push_back("null in " + name);
    } else if ((ending == ".csv" || ending == ".vtu" || ending == ".pvd") &&
               has_no_number(contents_of(folder / name))) {
      found.push_back("nan or inf in " + name);
    }
  }
  return found;
}

std::vector<std::string> differences(const fs::path& a, const fs::path& b) {
  std::vector<std::string> different;
  const auto in_a = listing(a), in_b = listing(b);
  for (const auto& [name, mark] : in_a)
    if (!in_b.contains(name)) different.push_back(name + " (only once)");
  for (const auto& [name, mark] : in_b) {
    if (!in_a.contains(name)) {
      different.push_back(name + " (only once)");
    } else if (name.ends_with(".json")) {
      if (without_times_and_words(json_in(a / name)) != without_times_and_words(json_in(b / name)))
        different.push_back(name);
    } else if (contents_of(a / name) != contents_of(b / name)) {
      different.push_back(name);
    }
  }
  return different;
}

bool is_same(const json& meant, const json& recorded) {
  if (meant.is_number() && recorded.is_number()) {
    const double a = meant, b = recorded;
    return std::abs(a - b) <= 1e-11 * std::abs(a);
  }
  if (meant.is_array() && recorded.is_array())
    return std::equal(meant.begin(), meant.end(), recorded.begin(), recorded.end(), is_same);
  if (meant.is_object() && recorded.is_object())
    return std::ranges::all_of(meant.items(), [&](const auto& item) {
      return recorded.contains(item.key()) && is_same(item.value(), recorded[item.key()]);
    });
  return meant == recorded;
}

}  // namespace talus::fuzz
