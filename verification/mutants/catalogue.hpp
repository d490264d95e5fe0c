// The mutants: one-line mistakes in the product code, as data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus::mutants {

/// How the mistake is chosen at run time, where it and the code as it stands cannot just be the two
/// sides of a conditional expression.
enum class Form {
  conditional,  ///< of the smallest whole expression in which the two differ
  plain_object  ///< the same, for Eigen's expressions, whose types differ: both are evaluated
};

struct Mutant {
  std::string name;  ///< AREA/NAME, AREA the catalogue's file
  std::string what;  ///< what it stands for
  std::filesystem::path file;
  std::string original, mutated;  ///< whole lines, joined by newlines; mutated may be empty
  Form form = Form::conditional;
  std::string equivalent =
      {};  ///< why nothing can tell it from the code as it stands; empty if it can

  bool is_equivalent() const { return !equivalent.empty(); }
};

/// The mutants in every *.txt of a folder, by name:
///
///     == common/rheology/friction_law.cpp
///     friction-sign: the law with the wrong sign
///     - return a + b;
///     + return a - b;
///     = why it is equivalent (left out if it is not)
///
/// Several lines as several - or +; no + takes the statement out; * for + is Form::plain_object.
/// Throws io::UserError naming file and line.
std::vector<Mutant> read_catalogue(const std::filesystem::path& folder);

}  // namespace talus::mutants
