// Errors where nothing exact is known: against another solve, or against stated values.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace talus::scene {

/// The numbers that --reference names, by quantity: those of a record or summary.json, or the text
/// itself if it is NAME=VALUE, several joined by commas. Throws io::UserError if there are none, or
/// if they are of a solve that did not succeed.
nlohmann::json reference_values(const std::string& text);

/// error_NAME of every quantity that both have: |value - reference| over |reference|, absolute
/// where that is 0. Throws io::UserError if they have none in common.
nlohmann::json errors_against(const nlohmann::json& reference, const nlohmann::json& results);

}  // namespace talus::scene
