#include "common/scene/description.hpp"

#include <stdexcept>

#include <CLI/CLI.hpp>

namespace talus::scene {
namespace {

using nlohmann::json;

json options_as_json(const CLI::App& app) {
  json options = json::array();
  for (const CLI::Option* option : app.get_options()) {
    if (option == app.get_help_ptr() || option->get_lnames().empty()) continue;
    const bool is_flag = option->get_items_expected_max() == 0;
    options.push_back({{"name", "--" + option->get_lnames().front()},
                       {"type", is_flag ? "FLAG" : option->get_type_name()},
                       {"default", option->get_default_str()},
                       {"description", option->get_description()}});
  }
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

json as_json(const Description& description, const CLI::App& app) {
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
          {"options", options_as_json(app)}};
}

}  // namespace talus::scene
