// What a scene says of itself, once: to --help, to the records of its cases, and to the studies.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/command_line.hpp"

namespace talus::scene {

/// A number that a solution is measured by, as it is named in the results.
struct Quantity {
  std::string name, unit, meaning;
};

struct Description {
  std::string name, title;
  std::vector<std::string> models;  ///< from poor to rich: values of --model; one if no choice
  std::string mesh_option;          ///< the option whose values are ever finer meshes
  std::vector<std::string> problem_options;  ///< those that say what is solved, not how
  std::string main_quantity;                 ///< what a study asks for if nothing else is said
  std::string main_error = {};               ///< the same of errors; empty where nothing is exact
  std::vector<Quantity> quantities;  ///< all that results can hold, errors (error_...) included

  /// Null if there is none of that name. "error_NAME" of a quantity is one too: its distance from
  /// a reference, relative.
  const Quantity* find(const std::string& quantity) const;
  /// Throws std::logic_error unless results, by name, are all described.
  void check(const nlohmann::json& results) const;
};

/// Name, type and default of every option of a program, and the description: what --describe
/// prints.
nlohmann::json as_json(const Description& description, const io::CommandLine& line);

}  // namespace talus::scene
