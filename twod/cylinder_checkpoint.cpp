// What a run of the cylinder leaves behind to go on from, and how it does.
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "twod/cylinder_sweep.hpp"

namespace talus::twod {
namespace {

constexpr const char* checkpoint_name = "checkpoint.bin";

// Whatever a run can leave, the program's tables and figures included.
std::vector<std::string> files() {
  std::vector<std::string> names = {"summary.json", "sweep.csv", "sweep.pvd", "path.csv",
                                    "perimeter.csv"};
  for (const char* figure : {"path", "perimeter", "drag", "fields", "wake"})
    for (const std::string& file : io::files_of(figure)) names.push_back(file);
  return names;
}

// What is solved, without how paths lead there: that may change from one run to the next.
nlohmann::json without_ways(nlohmann::json parameters) {
  for (const char* way : {"continuation", "route", "tangent"}) parameters.erase(way);
  return parameters;
}

// The names and values of the parameters that differ, as the run and the checkpoint have them.
std::string differences(const nlohmann::json& here, const nlohmann::json& there) {
  std::string all;
  for (const auto& [name, value] : here.items())
    if (!there.contains(name) || there[name] != value)
      all += (all.empty() ? "" : ", ") + name + " " + value.dump() + ", not " +
             (there.contains(name) ? there[name].dump() : "any");
  return all;
}

}  // namespace

nlohmann::json as_json(const Arrival& arrival) {
  return {{"loading", arrival.loading},
          {"by", arrival.by},
          {"loads", arrival.loads},
          {"factorisations", arrival.factorisations}};
}

Arrival arrival_from(const nlohmann::json& json) {
  return {json.at("loading"), json.at("by"), json.at("loads"), json.at("factorisations")};
}

void CylinderSweep::save(const std::string& stage, double target,
                         const solve::PathStart<CylinderFlow::State>& start) const {
  nlohmann::json notes = {{"parameters", parameters_},
                          {"stage", stage},
                          {"target", target},
                          {"path_points", path_points_},
                          {"factorisations", factorisations()},
                          {"iterations", iterations()},
                          {"way", way_},
                          {"reached", nlohmann::json::array()},
                          {"sweep", nlohmann::json::array()},
                          {"path", nlohmann::json::array()}};
  for (const auto& arrival : arrivals_) notes["reached"].push_back(as_json(arrival));
  for (const auto& measures : sweep_) notes["sweep"].push_back(as_json(measures));
  for (const auto& record : records_) notes["path"].push_back(as_json(record));
  program::write_checkpoint(folder_, checkpoint_name,
                            {notes,
                             {start.state, start.parameter, start.direction, start.step,
                              start.reference_sign, start.secant},
                             mixed::numbers_of<2>(start.state.stress)});
}

// Takes over from a checkpoint what it knows of the run, and where it stood: with its stress only
// if it goes on in the same way. Throws io::UserError if it is of another run.
solve::PathStart<CylinderFlow::State> CylinderSweep::recall(const program::Checkpoint& checkpoint) {
  const auto other = [&](const std::string& what) {
    return io::UserError("--resume: '" + (folder_.path() / checkpoint_name).string() +
                         "' belongs to a run with other options (" + what +
                         "); give those, or another --output");
  };
  try {
    const nlohmann::json& notes = checkpoint.notes;
    const auto here = without_ways(parameters_), there = without_ways(notes.at("parameters"));
    if (here != there) throw other(differences(here, there));
    if (checkpoint.start.state.size() != cylinder_.space().size())
      throw other(std::to_string(cylinder_.space().size()) + " unknowns, not " +
                  std::to_string(checkpoint.start.state.size()));
    for (const auto& each : notes.at("sweep")) add_to_sweep(measures_from(each));
    for (const auto& each : notes.at("reached")) arrivals_.push_back(arrival_from(each));
    way_ = notes.at("way");
    if (reached() > options_.loadings.size()) throw other("fewer loadings");
    for (const auto& each : notes.at("path")) records_.push_back(record_from(each));
    path_points_ = notes.at("path_points");
    earlier_factorisations_ = notes.at("factorisations");
    earlier_iterations_ = notes.at("iterations");
    if (!notes.at("stage").is_string() || !notes.at("target").is_number())
      throw other("notes of another version");
    const auto& at = checkpoint.start;
    if (notes.at("parameters").at("continuation") != parameters_.at("continuation"))
      return {.state = CylinderFlow::State(at.state), .parameter = at.parameter, .direction = 0};
    CylinderFlow::State state(at.state, cylinder_.flow().stress_of(checkpoint.carried_stress));
    std::optional<CylinderFlow::State> secant;
    if (at.secant) secant.emplace(*at.secant);
    return {std::move(state), at.parameter,      at.direction,
            at.step,          at.reference_sign, std::move(secant)};
  } catch (const nlohmann::json::exception&) {
    throw other("notes of another version");
  } catch (const std::invalid_argument& error) {
    throw other(error.what());  // of a processor with other vectors
  }
}

void CylinderSweep::start_anew() const {
  folder_.remove_older(files());
  folder_.remove_older({checkpoint_name, "flow_[0-9][0-9][0-9][0-9].vtu"});
}

// Goes on with the path that was interrupted; false if it does not reach its target either.
bool CylinderSweep::resume() {
  auto checkpoint = program::read_checkpoint(folder_.path() / checkpoint_name);
  if (!checkpoint) {
    start_anew();
    std::cout << "no checkpoint in " << folder_.path().string() << ": from the start\n";
    return true;
  }
  auto start = recall(*checkpoint);
  folder_.remove_older(files());
  if (!sweep_.empty()) write_sweep();
  const nlohmann::json& notes = checkpoint->notes;
  const std::string stage = notes.at("stage");
  const double target = notes.at("target");
  const bool follows_lambda_r = stage == "lambda_r";
  const double end = follows_lambda_r ? std::log10(options_.scene.lambda_r) : target;
  bool arrived = stage == "reached" || start.parameter == end;
  if (arrived) {
    state_ = std::move(start.state);
    state_.stress.clear();
    loading_ = target;
    cylinder_.flow().set_load_factor(loading_);
    cylinder_.flow().set_lambda_r(options_.scene.lambda_r);
  } else {
    has_start_ = true;
    if (start.direction == 0) {  // of another way
      start.direction = end > start.parameter ? 1 : -1;
      path_points_ = 0;
    }
    arrived =
        accept(follows_lambda_r
                   ? follow_lambda_r(cylinder_, target, std::move(start), options_.continuation,
                                     path_options(), observer(stage, target))
                   : follow_loading(cylinder_, std::move(start), target, options_.continuation,
                                    path_options(), observer(stage, target)));
  }
  if (arrived && stage != "reached" && reached() < options_.loadings.size() &&
      loading_ == options_.loadings[reached()])
    return finish_path();
  return arrived;
}

}  // namespace talus::twod
