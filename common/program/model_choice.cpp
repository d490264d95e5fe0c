#include "common/program/model_choice.hpp"

#include <algorithm>
#include <cmath>

#include "common/io/table.hpp"

namespace talus::program {
namespace {

// Two digits, without an exponent.
std::string times(double factor) {
  if (!(factor >= 10)) return io::rounded(factor, 2);
  const double unit = std::pow(10, std::floor(std::log10(factor)) - 1);
  return io::fixed(unit * std::round(factor / unit), 0);
}

}  // namespace

int digits(double apart) {
  if (!(apart < 1)) return 0;  // NaN too
  return static_cast<int>(std::clamp(std::floor(-std::log10(apart)), 0.0, 16.0));
}

std::string recommendation(const std::string& scene, const std::string& poorer,
                           const std::vector<RicherModel>& richer, int needed) {
  const auto differs = std::find_if(richer.begin(), richer.end(), [&](const RicherModel& model) {
    return digits(model.apart) < needed;
  });
  const std::string use = "For the " + scene + " use ";
  if (differs != richer.end())
    return use + differs->name + ", because " + poorer + " agrees with it to only " +
           std::to_string(digits(differs->apart)) + " digits.";
  std::string reasons;
  for (const RicherModel& model : richer)
    reasons += (reasons.empty() ? "" : ", and ") + model.name + " gives the same flow to " +
               std::to_string(digits(model.apart)) + " digits for " + times(model.times_cpu) +
               " times the CPU time and " + times(model.times_memory) + " times the memory";
  return use + poorer + ", because " + reasons + ".";
}

std::string hint_of_poorer_model(const std::string& scene, const std::string& asked_for,
                                 const std::string& poorer, const std::string& how_to_ask) {
  return "hint: for the " + scene + " " + poorer + " gives the same flow as " + asked_for +
         " at a fraction of the cost: " + how_to_ask + " (./run verify ladder measures both)";
}

}  // namespace talus::program
