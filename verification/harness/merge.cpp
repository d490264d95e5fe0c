#include "verification/harness/merge.hpp"

#include <algorithm>

namespace talus::verification {
namespace {

namespace fs = std::filesystem;

// A folder and those within it.
std::vector<fs::path> with_those_in(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw io::UserError("--merge: '" + folder.string() + "' is no folder");
  std::vector<fs::path> all = {folder};
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory()) all.push_back(entry.path());
  std::ranges::sort(all);
  return all;
}

// Of a part that was killed before it left a whole chapter nothing is known.
void refuse_mixture(Found& found) {
  std::string name_of[2];  // of a quick part, of a full one
  for (const auto& [name, folder] : found.folders)
    if (const auto record = read_chapter(folder)) name_of[record->is_full ? 1 : 0] = name;
  found.is_full = !name_of[1].empty();
  if (!name_of[0].empty() && found.is_full)
    throw io::UserError("--merge: " + name_of[1] + " was run with --full, " + name_of[0] +
                        " without");
}

}  // namespace

Found find_parts(const std::vector<Study>& studies, const std::vector<fs::path>& folders) {
  Found found;
  for (const fs::path& folder : folders) {
    const std::size_t before = found.folders.size();
    for (const fs::path& place : with_those_in(folder))
      for (const Study& study : studies)
        for (const Part& part : study.parts) {
          const std::string name = study.name_of(part);
          if (!has_chapter(place / name)) continue;
          const auto [other, is_new] = found.folders.emplace(name, place / name);
          if (!is_new)
            throw io::UserError("--merge: " + name + " is there twice, '" + other->second.string() +
                                "' and '" + (place / name).string() + "'");
        }
    if (found.folders.size() == before)
      throw io::UserError("--merge: '" + folder.string() + "' holds no part of a study");
  }
  refuse_mixture(found);
  return found;
}

std::vector<Written> merge_studies(const std::vector<Study>& studies, const Found& found,
                                   const io::ResultFolder& folder) {
  return chapters_of(studies, [&](const Study& study, const Part& part) {
    const std::string name = study.name_of(part);
    const auto place = found.folders.find(name);
    const bool is_found = place != found.folders.end();
    const auto record = is_found ? read_chapter(place->second) : std::nullopt;
    const io::ResultFolder ours(folder.path() / name);
    if (is_found)
      copy_chapter(place->second, ours);
    else
      remove_chapter(ours);
    if (record) return record->written;
    return write_chapter(
        chapter_of_failure(study, part, is_found ? "did not end: it is torn" : "was not run"),
        ours.path());
  });
}

}  // namespace talus::verification
