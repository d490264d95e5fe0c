// What a study was asked: a scene, and values of its options whose combinations are the cases.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace talus::study {

/// An option of a scene and the values it takes in a study.
struct Varied {
  std::string name;  ///< with its dashes
  std::vector<std::string> values;
};

/// The options of one case, in the order of the command line; flags have an empty value.
using Options = std::vector<std::pair<std::string, std::string>>;

/// A program that solves a scene, and what it says of itself with --describe.
struct Program {
  std::filesystem::path path;
  nlohmann::json description;

  std::string name() const { return description.at("scene"); }
  /// Null if there is no such option.
  const nlohmann::json* option(const std::string& name) const;
  /// Null if there is no such quantity.
  const nlohmann::json* quantity(const std::string& name) const;
};

/// Every program beside this one that describes a scene. Throws io::UserError, with the names
/// there are, if none is called `scene`.
Program program_of(const std::string& scene);

/// The options of a scene among the words of a command line, every one with its values. Throws
/// io::UserError for what is no option of the scene, or is given twice or without a value.
std::vector<Varied> varied_options(const Program& program, const std::vector<std::string>& words);

/// All combinations, the first option varying slowest. Throws io::UserError beyond 10000.
std::vector<Options> combinations(const std::vector<Varied>& varied);

/// The words of a command line for these options.
std::vector<std::string> words_of(const Options& options);

/// The cases, on one thread unless `combinations` say otherwise. Leaves out of each what its method
/// has no use for, and then what is there twice. Throws io::UserError with what the scene's program
/// says of any other impossible combination, or of an option that no case uses.
std::vector<Options> possible(const Program& program, const std::vector<Options>& combinations);

}  // namespace talus::study
