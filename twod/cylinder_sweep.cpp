#include "twod/cylinder_sweep.hpp"

#include <algorithm>
#include <iostream>
#include <utility>

namespace talus::twod {
namespace {

std::string file_of(std::size_t number) {
  const std::string digits = std::to_string(number);
  return "flow_" + std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits + ".vtu";
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

constexpr const char* path_in_lambda_r = "path in λr";
constexpr const char* path_in_loading = "path in the loading";

}  // namespace

std::string name_of(Route route) {
  switch (route) {
    case Route::cheapest:
      return "cheapest";
    case Route::loading:
      return "loading";
    case Route::lambda_r:
      return "lambda-r";
  }
  return {};
}

CylinderSweep::CylinderSweep(const SweepOptions& options, const io::ResultFolder& folder)
    : options_(options), folder_(folder), cylinder_(options.scene) {
  parameters_ = as_json(options.scene);
  parameters_["loadings"] = options.loadings;
  parameters_["route"] = name_of(options.route);
  parameters_["continuation"] = name_of(options.continuation);
  parameters_["tolerance"] = options.tolerance;
  parameters_["distance"] = options.distance;
}

bool CylinderSweep::run() {
  if (!options_.resume) start_anew();
  if (options_.resume && !resume()) return false;
  while (reached() < options_.loadings.size())
    if (!reach(options_.loadings[reached()])) return false;
  return true;
}

// The one place where it is decided how a loading is reached, the cheap way first: no path where
// the loading creeps, if it may be so.
bool CylinderSweep::reach(double target) {
  if (options_.route == Route::cheapest && may_creep(options_.scene, target)) {
    const auto creep = creep_to(target);
    if (solve::is_success(creep.newton.end)) return finish_creep(creep);
  }
  return follow_paths(target) && finish_path();
}

// From the loading before, if that creeps as well; else from rest.
mixed::CreepSummary CylinderSweep::creep_to(double target) {
  const bool goes_on = state_.size() > 0 && may_creep(options_.scene, loading_);
  way_ = goes_on ? "newton from the load before" : "creep from rest";
  progress_.show("F = " + io::rounded(target, 6) + ": " + way_, share_reached());
  return twod::creep_to(cylinder_, target, goes_on ? loading_ : 0, state_,
                        to_the_end(mixed::creep_options()));
}

// By the route; down in λr unless told otherwise.
bool CylinderSweep::follow_paths(double target) {
  const bool is_along_loading = options_.route == Route::loading;
  path_points_ = 0;
  const double first = is_along_loading ? first_loading() : target;
  const bool is_at_rest = state_.size() == 0;
  const bool needs_start = !is_along_loading || (is_at_rest && !starts_by_creep(first));
  if (needs_start) {
    way_ = path_in_lambda_r;
    progress_.show("F = " + io::rounded(first, 6) + ": from rest", share_reached());
    if (!accept(solve_from_rest(cylinder_, first, options_.continuation, path_options(),
                                observer("lambda_r", first))))
      return false;
  }
  if (loading_ == target) return true;
  way_ = path_in_loading;
  path_points_ = 0;
  const int direction = target > loading_ ? 1 : -1;
  return accept(
      follow_loading(cylinder_, {.state = state_, .parameter = loading_, .direction = direction},
                     target, options_.continuation, path_options(), observer("loading", target)));
}

// The cheapest start of a path in the loading.
bool CylinderSweep::starts_by_creep(double first) {
  if (!may_creep(options_.scene, first)) return false;
  const auto creep = creep_to(first);
  if (!solve::is_success(creep.newton.end)) return false;
  loading_ = first;
  record(creep, measure(cylinder_, state_));
  return true;
}

int CylinderSweep::folds() const {
  return static_cast<int>(std::ranges::count_if(
      records_, [](const PathRecord& record) { return record.point.is_fold_passed; }));
}

int CylinderSweep::factorisations_since_last() const {
  int before = 0;
  for (const Arrival& arrival : arrivals_) before += arrival.factorisations;
  return factorisations() - before;
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
      earlier_iterations_ -= cylinder_.flow().iterations();
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

bool CylinderSweep::fail(const std::string& status) {
  status_ = status;
  return false;
}

// Takes over where a path ended; true if that is its target.
bool CylinderSweep::accept(CylinderPath path) {
  state_ = std::move(path.next.state);
  state_.stress.clear();  // the path's own
  loading_ = cylinder_.flow().load_factor();
  return path.end == solve::PathEnd::target_reached || fail(solve::name_of(path.end));
}

void CylinderSweep::add_to_sweep(const CylinderMeasures& measures) {
  sweep_.push_back(measures);
  series_.push_back({measures.loading, file_of(sweep_.size())});
}

void CylinderSweep::write_sweep() const {
  folder_.write("sweep.csv", io::to_csv(sweep_table(sweep_, options_.confining_pressures)));
}

// The points of a path are rough: Newton to the solution. False if there is none.
bool CylinderSweep::finish_path() {
  cylinder_.flow().set_load_factor(loading_);
  cylinder_.flow().set_lambda_r(options_.scene.lambda_r);
  const solve::NewtonSummary newton = solve::newton(
      cylinder_.flow(), state_, to_the_end({.line_search = solve::LineSearch::residual_norm}));
  if (!solve::is_success(newton.end)) return fail(solve::name_of(newton.end));
  return finish_loading(measure(cylinder_, state_), 1);
}

bool CylinderSweep::finish_creep(const mixed::CreepSummary& creep) {
  loading_ = cylinder_.flow().load_factor();
  const CylinderMeasures m = measure(cylinder_, state_);
  record(creep, m);
  return finish_loading(m, creep.loads);
}

solve::NewtonOptions CylinderSweep::to_the_end(solve::NewtonOptions options) const {
  options.tolerance = options_.tolerance;
  options.distance = options_.distance;
  return options;
}

// Creep is a point of path.csv as well.
void CylinderSweep::record(const mixed::CreepSummary& creep, const CylinderMeasures& measures) {
  solve::PathPoint point{.parameter = loading_, .corrections = creep.newton.iterations()};
  point.cost = {creep.failures, factorisations_since_last()};
  point.residual = creep.newton.final_residual();
  records_.push_back({point, measures});
}

// Measures, fields and how it was reached. False if nothing flows.
bool CylinderSweep::finish_loading(const CylinderMeasures& m, int loads) {
  if (!flows(cylinder_, m)) return fail(solve::name_of(solve::End::stagnated));
  arrivals_.push_back({m.loading, way_, loads, factorisations_since_last()});
  add_to_sweep(m);
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
