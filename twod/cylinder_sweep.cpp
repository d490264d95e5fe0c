#include "twod/cylinder_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "common/program/checkpoint.hpp"

namespace talus::twod {
namespace {

constexpr const char* checkpoint_name = "checkpoint.bin";

std::string file_of(std::size_t number) {
  const std::string digits = std::to_string(number);
  return "flow_" + std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits + ".vtu";
}

// Whatever a run can leave, the program's tables and figures included.
std::vector<std::string> files() {
  std::vector<std::string> names = {"summary.json", "sweep.csv", "sweep.pvd", "path.csv",
                                    "perimeter.csv"};
  for (const char* figure : {"path", "perimeter", "drag"})
    for (const std::string& file : io::files_of(figure)) names.push_back(file);
  return names;
}

// What is solved, without how paths lead there: that may change from one run to the next.
nlohmann::json without_ways(nlohmann::json parameters) {
  for (const char* way : {"continuation", "route"}) parameters.erase(way);
  return parameters;
}

}  // namespace

CylinderSweep::CylinderSweep(const SweepOptions& options, const io::ResultFolder& folder)
    : options_(options), folder_(folder), cylinder_(options.scene) {
  parameters_ = as_json(options.scene);
  parameters_["loadings"] = options.loadings;
  parameters_["route"] = options.route == Route::loading ? "loading" : "lambda-r";
  parameters_["continuation"] = name_of(options.continuation);
}

bool CylinderSweep::run() {
  if (!options_.resume) start_anew();
  if (options_.resume && !resume()) return false;
  for (; reached() < options_.loadings.size(); finish_loading()) {
    const double target = options_.loadings[reached()];
    if (state_.size() == 0 || options_.route == Route::lambda_r) {
      const double first = options_.route == Route::lambda_r ? target : first_loading();
      progress_.show("F = " + io::rounded(first, 6) + ": from rest", share_reached());
      if (!accept(solve_from_rest(cylinder_, first, options_.continuation, path_options(),
                                  observer("lambda_r", first))))
        return false;
    }
    if (loading_ == target) continue;
    const int direction = target > loading_ ? 1 : -1;
    if (!accept(follow_loading(
            cylinder_, {.state = state_, .parameter = loading_, .direction = direction}, target,
            options_.continuation, path_options(), observer("loading", target))))
      return false;
  }
  return true;
}

int CylinderSweep::folds() const {
  return static_cast<int>(std::ranges::count_if(
      records_, [](const PathRecord& record) { return record.point.is_fold_passed; }));
}

double CylinderSweep::share_reached() const {
  return static_cast<double>(reached()) / static_cast<double>(options_.loadings.size());
}

// Where the cylinder holds everything a path in λr has nothing to pass.
double CylinderSweep::first_loading() const {
  return std::min(options_.loadings.front(), held_loading(options_.scene));
}

solve::PathOptions CylinderSweep::path_options() const {
  solve::PathOptions path = cylinder_path_options();
  path.max_points = options_.max_points;
  return path;
}

CylinderObserver CylinderSweep::observer(const std::string& stage, double target) {
  return [this, stage, target](const auto& state, const auto& measures, const auto& point) {
    if (!std::exchange(has_start_, false)) records_.push_back({point, measures});
    progress_.show("F = " + io::rounded(measures.loading, 6) +
                       ", λr = " + io::rounded(measures.lambda_r, 3) +
                       ", U = " + io::rounded(measures.mean_velocity, 4),
                   share_reached());
    save(stage, target, program::start_from(state, point));
    return true;
  };
}

void CylinderSweep::save(const std::string& stage, double target,
                         const solve::PathStart<CylinderFlow::State>& start) const {
  nlohmann::json notes = {{"parameters", parameters_},
                          {"stage", stage},
                          {"target", target},
                          {"sweep", nlohmann::json::array()},
                          {"path", nlohmann::json::array()}};
  for (const auto& measures : sweep_) notes["sweep"].push_back(as_json(measures));
  for (const auto& record : records_) notes["path"].push_back(as_json(record));
  program::write_checkpoint(folder_, checkpoint_name, {notes, start});
}

void CylinderSweep::start_anew() const {
  folder_.remove_older(files());
  folder_.remove_older({checkpoint_name, "flow_[0-9][0-9][0-9][0-9].vtu"});
}

// Goes on with the path that was interrupted; false if it does not reach its target either.
bool CylinderSweep::resume() {
  const auto file = folder_.path() / checkpoint_name;
  auto checkpoint = program::read_checkpoint(file);
  if (!checkpoint) {
    start_anew();
    return true;
  }
  const nlohmann::json& notes = checkpoint->notes;
  const nlohmann::json& parameters = notes.at("parameters");
  if (without_ways(parameters) != without_ways(parameters_))
    throw io::UserError("--resume: '" + file.string() +
                        "' belongs to a run with other options; give those, or another --output");
  folder_.remove_older(files());
  for (const auto& each : notes.at("sweep")) {
    sweep_.push_back(measures_from(each));
    series_.push_back({sweep_.back().loading, file_of(sweep_.size())});
  }
  if (!sweep_.empty()) write_sweep();
  for (const auto& each : notes.at("path")) records_.push_back(record_from(each));
  const std::string stage = notes.at("stage");
  const double target = notes.at("target");
  const bool follows_lambda_r = stage == "lambda_r";
  const double end = follows_lambda_r ? std::log10(options_.scene.lambda_r) : target;
  bool arrived = stage == "reached" || checkpoint->start.parameter == end;
  if (arrived) {
    state_ = std::move(checkpoint->start.state);
    loading_ = target;
    cylinder_.flow().set_load_factor(loading_);
    cylinder_.flow().set_lambda_r(options_.scene.lambda_r);
  } else {
    has_start_ = true;
    auto& start = checkpoint->start;
    if (parameters.at("continuation") != parameters_.at("continuation"))  // its step and sense
      start = {.state = std::move(start.state),
               .parameter = start.parameter,
               .direction = end > start.parameter ? 1 : -1};
    arrived =
        accept(follows_lambda_r
                   ? follow_lambda_r(cylinder_, target, std::move(start), options_.continuation,
                                     path_options(), observer(stage, target))
                   : follow_loading(cylinder_, std::move(start), target, options_.continuation,
                                    path_options(), observer(stage, target)));
  }
  if (arrived && stage != "reached" && reached() < options_.loadings.size() &&
      loading_ == options_.loadings[reached()])
    finish_loading();
  return arrived;
}

// Takes over where a path ended; true if that is its target.
bool CylinderSweep::accept(CylinderPath path) {
  end_ = path.end;
  if (path.end == solve::PathEnd::start_failed) return false;
  state_ = std::move(path.next.state);
  loading_ = cylinder_.flow().load_factor();
  return end_ == solve::PathEnd::target_reached;
}

void CylinderSweep::write_sweep() const {
  folder_.write("sweep.csv", io::to_csv(sweep_table(sweep_, options_.confining_pressures)));
}

// A loading is reached: Newton down to round-off, measures and fields.
void CylinderSweep::finish_loading() {
  solve::newton(
      cylinder_.flow(), state_,
      {.tolerance = 1e-14, .max_iterations = 4, .line_search = solve::LineSearch::residual_norm});
  sweep_.push_back(measure(cylinder_, state_));
  const CylinderMeasures& m = sweep_.back();
  series_.push_back({m.loading, file_of(sweep_.size())});
  folder_.write(series_.back().file, io::to_vtu(grid(cylinder_, state_)));
  write_sweep();
  std::cout << "F = " << io::rounded(m.loading, 6) << ": U = " << io::rounded(m.mean_velocity, 6)
            << ", drag " << io::rounded(m.drag, 6) << " (traction "
            << io::rounded(m.drag_traction, 6) << "), smallest pressure "
            << io::rounded(m.min_pressure, 3) << std::endl;
  save("reached", m.loading, {.state = state_, .parameter = m.loading});
}

}  // namespace talus::twod
