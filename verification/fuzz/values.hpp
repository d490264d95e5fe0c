// Values of options, drawn with the knowledge what is to become of them.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "verification/fuzz/grammar.hpp"
#include "verification/fuzz/random.hpp"

namespace talus::fuzz {

enum class Standing {
  fair,  ///< to be taken, unless other options do not go with it
  odd,   ///< "0100", "1e2": to be refused, or taken for what it means
  wrong  ///< to be refused
};

struct Value {
  std::string text;
  Standing standing = Standing::fair;
  nlohmann::json meaning = nullptr;  ///< as summary.json is to record it; null: it does not
};

/// What a number, a mesh, a folder ... may look like; `option` is not a flag. `model` is that of
/// the line so far, empty where it has not said.
Value draw_value(const Option& option, const Program& program, Standing standing,
                 const std::string& model, Random& random);

/// `option` with one mistake in its name.
std::string misspelt(const std::string& option, const Program& program, Random& random);

}  // namespace talus::fuzz
