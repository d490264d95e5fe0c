#include "verification/mutants/catalogue.hpp"

#include <algorithm>
#include <fstream>
#include <set>

#include "common/io/result_folder.hpp"

namespace talus::mutants {
namespace {

namespace fs = std::filesystem;

void append_line(std::string& lines, const std::string& line) {
  lines += (lines.empty() ? "" : "\n") + line;
}

class Reader {
 public:
  Reader(const fs::path& path, std::vector<Mutant>& mutants) : path_(path), mutants_(mutants) {}

  void read() {
    std::ifstream in(path_);
    for (std::string line; std::getline(in, line);) {
      ++number_;
      if (line.empty() || line[0] == '#') continue;
      if (line.starts_with("== ")) {
        file_ = line.substr(3);
        is_open_ = false;
      } else if (line.size() > 1 && line[1] == ' ' &&
                 std::string("-+*=").find(line[0]) != std::string::npos) {
        continue_mutant(line[0], line.substr(2));
      } else {
        begin(line);
      }
    }
    for (const Mutant& mutant : mutants_)
      if (mutant.original.empty()) refuse(mutant.name + " has no line that starts with '-'");
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw io::UserError(path_.string() + ":" + std::to_string(number_) + ": " + why);
  }

  void begin(const std::string& line) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos || file_.empty())
      refuse("'" + line + "' is no 'name: what it stands for' below a '== file'");
    Mutant mutant;
    mutant.name = path_.stem().string() + "/" + line.substr(0, colon);
    mutant.what = line.substr(colon + 2);
    mutant.file = file_;
    mutants_.push_back(mutant);
    is_open_ = true;
  }

  void continue_mutant(char mark, const std::string& text) {
    if (!is_open_) refuse("a line of no mutant");
    Mutant& mutant = mutants_.back();
    if (mark == '=') {
      mutant.equivalent = text;
      return;
    }
    if (mark == '*') mutant.form = Form::plain_object;
    append_line(mark == '-' ? mutant.original : mutant.mutated, text);
  }

  fs::path path_, file_;
  std::vector<Mutant>& mutants_;
  int number_ = 0;
  bool is_open_ = false;
};

}  // namespace

std::vector<Mutant> read_catalogue(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".txt") files.push_back(entry.path());
  if (files.empty()) throw io::UserError("no mutants (*.txt) in " + folder.string());
  std::ranges::sort(files);
  std::vector<Mutant> mutants;
  for (const fs::path& file : files) Reader(file, mutants).read();
  std::set<std::string> names;
  for (const Mutant& mutant : mutants)
    if (!names.insert(mutant.name).second)
      throw io::UserError("two mutants are called " + mutant.name);
  return mutants;
}

}  // namespace talus::mutants
