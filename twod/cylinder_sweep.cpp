#include "twod/cylinder_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <utility>

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

// The names and values of the parameters that differ, as the run and the checkpoint have them.
std::string differences(const nlohmann::json& here, const nlohmann::json& there) {
  std::string all;
  for (const auto& [name, value] : here.items())
    if (!there.contains(name) || there[name] != value)
      all += (all.empty() ? "" : ", ") + name + " " + value.dump() + ", not " +
             (there.contains(name) ? there[name].dump() : "any");
  return all;
}

// Whether a loading moves the material. A regularised law creeps under any load, hardly slower than
// a fluid as stiff as its plug would in the empty channel; where nothing but rounding moves, the
// boundary conditions hold the material up.
bool flows(const CylinderFlow& cylinder, const CylinderMeasures& measures) {
  constexpr double hardly = 1e-3;
  const double stiffest = cylinder.flow().rheology().evaluate(0, 1).eta;
  const double half_width = cylinder.scene().mesh.half_width;
  const double creep = measures.loading * half_width * half_width / (3 * stiffest);
  return measures.mean_velocity > hardly * creep;
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
  while (reached() < options_.loadings.size()) {
    const double target = options_.loadings[reached()];
    path_points_ = 0;
    if (state_.size() == 0 || options_.route == Route::lambda_r) {
      const double first = options_.route == Route::lambda_r ? target : first_loading();
      progress_.show("F = " + io::rounded(first, 6) + ": from rest", share_reached());
      if (!accept(solve_from_rest(cylinder_, first, options_.continuation, path_options(),
                                  observer("lambda_r", first))))
        return false;
    }
    if (loading_ != target) {
      path_points_ = 0;
      const int direction = target > loading_ ? 1 : -1;
      if (!accept(follow_loading(
              cylinder_, {.state = state_, .parameter = loading_, .direction = direction}, target,
              options_.continuation, path_options(), observer("loading", target))))
        return false;
    }
    if (!finish_loading()) return false;
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
  // What a path that goes on has behind it counts, its start once only.
  path.max_points = options_.max_points - std::max(0, path_points_ - 1);
  return path;
}

CylinderObserver CylinderSweep::observer(const std::string& stage, double target) {
  return [this, stage, target](const auto& at, const auto& measures, const auto& point) {
    if (std::exchange(has_start_, false)) {
      earlier_factorisations_ -= cylinder_.flow().factorisations();  // for the start once more
    } else {
      records_.push_back({point, measures});
      ++path_points_;
    }
    progress_.show("F = " + io::rounded(measures.loading, 6) +
                       ", λr = " + io::rounded(measures.lambda_r, 3) +
                       ", U = " + io::rounded(measures.mean_velocity, 4),
                   share_reached());
    save(stage, target, at);
    return true;
  };
}

void CylinderSweep::save(const std::string& stage, double target,
                         const solve::PathStart<CylinderFlow::State>& start) const {
  nlohmann::json notes = {{"parameters", parameters_},
                          {"stage", stage},
                          {"target", target},
                          {"path_points", path_points_},
                          {"factorisations", factorisations()},
                          {"sweep", nlohmann::json::array()},
                          {"path", nlohmann::json::array()}};
  for (const auto& measures : sweep_) notes["sweep"].push_back(as_json(measures));
  for (const auto& record : records_) notes["path"].push_back(as_json(record));
  program::write_checkpoint(folder_, checkpoint_name,
                            {notes, start, cylinder_.flow().carried_stress()});
}

// Takes over from a checkpoint what it knows of the run. Throws io::UserError if it is of another.
void CylinderSweep::recall(const program::Checkpoint& checkpoint) {
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
    for (const auto& each : notes.at("sweep")) {
      sweep_.push_back(measures_from(each));
      series_.push_back({sweep_.back().loading, file_of(sweep_.size())});
    }
    if (reached() > options_.loadings.size()) throw other("fewer loadings");
    for (const auto& each : notes.at("path")) records_.push_back(record_from(each));
    path_points_ = notes.at("path_points");
    earlier_factorisations_ = notes.at("factorisations");
    if (!notes.at("stage").is_string() || !notes.at("target").is_number())
      throw other("notes of another version");
    const bool is_same_way =
        notes.at("parameters").at("continuation") == parameters_.at("continuation");
    if (is_same_way && options_.continuation == Continuation::primal_dual)
      cylinder_.flow().carry_stress(checkpoint.carried_stress);
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
  recall(*checkpoint);
  folder_.remove_older(files());
  if (!sweep_.empty()) write_sweep();
  const nlohmann::json& notes = checkpoint->notes;
  const std::string stage = notes.at("stage");
  const double target = notes.at("target");
  const bool follows_lambda_r = stage == "lambda_r";
  const double end = follows_lambda_r ? std::log10(options_.scene.lambda_r) : target;
  bool arrived = stage == "reached" || checkpoint->start.parameter == end;
  if (arrived) {
    state_ = std::move(checkpoint->start.state);
    loading_ = target;
    cylinder_.flow().stop_carrying_stress();
    cylinder_.flow().set_load_factor(loading_);
    cylinder_.flow().set_lambda_r(options_.scene.lambda_r);
  } else {
    has_start_ = true;
    auto& start = checkpoint->start;
    if (notes.at("parameters").at("continuation") != parameters_.at("continuation")) {
      start = {.state = std::move(start.state),  // without the step and sense of the other
               .parameter = start.parameter,
               .direction = end > start.parameter ? 1 : -1};
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
    return finish_loading();
  return arrived;
}

bool CylinderSweep::fail(const std::string& status) {
  status_ = status;
  return false;
}

// Takes over where a path ended; true if that is its target.
bool CylinderSweep::accept(CylinderPath path) {
  state_ = std::move(path.next.state);
  loading_ = cylinder_.flow().load_factor();
  return path.end == solve::PathEnd::target_reached || fail(solve::name_of(path.end));
}

void CylinderSweep::write_sweep() const {
  folder_.write("sweep.csv", io::to_csv(sweep_table(sweep_, options_.confining_pressures)));
}

// A loading is reached by a path, whose points are rough: Newton to the solution, measures and
// fields. False if there is none, or if it is rest.
bool CylinderSweep::finish_loading() {
  cylinder_.flow().set_load_factor(loading_);
  cylinder_.flow().set_lambda_r(options_.scene.lambda_r);
  const solve::NewtonSummary newton = solve::newton(
      cylinder_.flow(), state_,
      {.tolerance = 1e-13, .distance = 1e-10, .line_search = solve::LineSearch::residual_norm});
  if (!solve::is_success(newton.end)) return fail(solve::name_of(newton.end));
  const CylinderMeasures m = measure(cylinder_, state_);
  if (!flows(cylinder_, m)) return fail(solve::name_of(solve::End::stagnated));
  sweep_.push_back(m);
  series_.push_back({m.loading, file_of(sweep_.size())});
  folder_.write(series_.back().file, io::to_vtu(grid(cylinder_, state_)));
  write_sweep();
  std::cout << "F = " << io::rounded(m.loading, 6) << ": U = " << io::rounded(m.mean_velocity, 6)
            << ", drag " << io::rounded(m.drag, 6) << " (traction "
            << io::rounded(m.drag_traction, 6) << "), smallest pressure "
            << io::rounded(m.min_pressure, 3) << std::endl;
  save("reached", m.loading, {.state = state_, .parameter = m.loading});
  return true;
}

}  // namespace talus::twod
