#include "common/scene/description.hpp"

#include <stdexcept>

namespace talus::scene {
namespace {

using nlohmann::json;

json options_as_json(const io::CommandLine& line) {
  json options = json::array();
  for (const io::GivenOption& option : line.options())
    options.push_back({{"name", option.name},
                       {"type", option.is_flag ? "FLAG" : option.type},
                       {"default", option.standard},
                       {"description", option.description}});
  return options;
}

}  // namespace

const Quantity* Description::find(const std::string& quantity) const {
  for (const Quantity& each : quantities)
    if (each.name == quantity) return &each;
  return nullptr;
}

void Description::check(const nlohmann::json& results) const {
  for (const auto& [quantity, _] : results.items())
    if (!find(quantity))
      throw std::logic_error("the scene " + name + " does not describe its result " + quantity);
}

json as_json(const Description& description, const io::CommandLine& line) {
  json quantities = json::array();
  for (const auto& [name, unit, meaning] : description.quantities)
    quantities.push_back({{"name", name}, {"unit", unit}, {"meaning", meaning}});
  return {{"scene", description.name},
          {"title", description.title},
          {"models", description.models},
          {"mesh_option", description.mesh_option},
          {"problem_options", description.problem_options},
          {"main_quantity", description.main_quantity},
          {"main_error", description.main_error},
          {"quantities", quantities},
          {"options", options_as_json(line)}};
}

}  // namespace talus::scene
