#include "common/scene/reference.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include "common/io/options.hpp"

namespace talus::scene {
namespace {

using nlohmann::json;

json stated(const std::string& text) {
  constexpr double most = std::numeric_limits<double>::max();
  json values;
  for (const std::string& part : io::split(text, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw io::UserError("--reference: '" + part + "' is not NAME=VALUE, nor '" + text +
                          "' a file");
    values[part.substr(0, equals)] =
        io::real_in_range("--reference", part.substr(equals + 1), -most, most);
  }
  return values;
}

}  // namespace

json reference_values(const std::string& text) {
  std::ifstream file(text);
  if (!file) return stated(text);
  const json record = json::parse(file, nullptr, false);
  const auto refuse = [&](const std::string& why) {
    return io::UserError("--reference: '" + text + "' " + why);
  };
  if (!record.is_object() || !record.contains("results") || !record.contains("status"))
    throw refuse("is no record of a case");
  if (record["results"].empty())
    throw refuse("holds no results: its solve ended in " + record["status"].dump());
  return record["results"];
}

json errors_against(const json& reference, const json& results) {
  json errors = json::object();
  for (const auto& [name, value] : results.items()) {
    if (!value.is_number() || name.rfind("error_", 0) == 0) continue;
    if (!reference.contains(name) || !reference[name].is_number()) continue;
    const double known = reference[name], off = std::abs(value.get<double>() - known);
    errors["error_" + name] = known == 0 ? off : off / std::abs(known);
  }
  if (errors.empty())
    throw io::UserError("--reference: it has none of the quantities of this scene");
  return errors;
}

}  // namespace talus::scene
