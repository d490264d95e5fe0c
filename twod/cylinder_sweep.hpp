// A run of the cylinder: from rest to one loading after the other, with a checkpoint at every
// accepted point. A run that was killed and resumed gives the same numbers, to the last digit, as
// one that was not.
#pragma once

#include <string>
#include <vector>

#include "common/io/progress.hpp"
#include "common/io/result_folder.hpp"
#include "common/program/checkpoint.hpp"
#include "twod/cylinder_report.hpp"

namespace talus::twod {

/// To each loading: without a path where it creeps (flow/creep.hpp), else down in λr; along the
/// loading at the scene's λr, having crept in well below yield; or down in λr at the loading
/// itself.
enum class Route { cheapest, loading, lambda_r };
std::string name_of(Route route);

/// How a loading was reached.
struct Arrival {
  double loading = 0;
  std::string by;          ///< from the load before, from rest, or along the path that led there
  int loads = 1;           ///< solved on the way without a path, this one included
  int factorisations = 0;  ///< since the loading before, attempts in vain included
};
nlohmann::json as_json(const Arrival& arrival);
Arrival arrival_from(const nlohmann::json& json);

struct SweepOptions {
  Cylinder scene;
  std::vector<double> loadings = {0.054};
  std::vector<double> confining_pressures = {1, 2, 3, 5, 10};  ///< in φρgD, for the tables
  Continuation continuation = Continuation::primal_dual;
  Route route = Route::cheapest;
  int max_points = 400;  ///< of one path
  /// Of the solution at each loading, as NewtonOptions has them.
  double tolerance = 1e-13, distance = 1e-10;
  bool resume = false;  ///< go on from the checkpoint in the folder, if there is one
};

class CylinderSweep {
 public:
  /// Both must outlive the sweep.
  CylinderSweep(const SweepOptions& options, const io::ResultFolder& folder);

  /// Removes what an older run left, but for what --resume goes on from. Reaches one loading after
  /// the other; true if all were. Every loading reached writes its fields and sweep.csv. Throws
  /// io::UserError if the checkpoint is damaged or belongs to another run.
  bool run();

  const CylinderFlow& cylinder() const { return cylinder_; }
  const CylinderFlow::State& state() const { return state_; }  ///< of the last loading, if reached
  const nlohmann::json& parameters() const { return parameters_; }
  const std::vector<PathRecord>& records() const { return records_; }  ///< before --resume too
  const std::vector<CylinderMeasures>& reached_loadings() const { return sweep_; }
  const std::vector<Arrival>& arrivals() const { return arrivals_; }  ///< one a loading reached
  const std::vector<io::SeriesEntry>& series() const { return series_; }
  /// "converged" if all were reached, else how the last path, or Newton after it, ended.
  const std::string& status() const { return status_; }
  /// All of them, Newton before and after a path and what went before --resume as well.
  int factorisations() const { return earlier_factorisations_ + cylinder_.flow().factorisations(); }
  int iterations() const { return earlier_iterations_ + cylinder_.flow().iterations(); }
  int folds() const;

 private:
  std::size_t reached() const { return sweep_.size(); }
  int factorisations_since_last() const;  // loading that was reached
  double share_reached() const;
  double first_loading() const;
  solve::PathOptions path_options() const;
  CylinderObserver observer(const std::string& stage, double target);
  void save(const std::string& stage, double target,
            const solve::PathStart<CylinderFlow::State>& start) const;
  void start_anew() const;
  bool resume();
  solve::PathStart<CylinderFlow::State> recall(const program::Checkpoint& checkpoint);
  bool reach(double target);
  mixed::CreepSummary creep_to(double target);
  bool starts_by_creep(double first);
  void record(const mixed::CreepSummary& creep, const CylinderMeasures& measures);
  bool follow_paths(double target);
  bool accept(CylinderPath path);
  bool finish_path();
  solve::NewtonOptions to_the_end(solve::NewtonOptions options) const;
  bool finish_creep(const mixed::CreepSummary& creep);
  bool finish_loading(const CylinderMeasures& measures, int loads);
  void add_to_sweep(const CylinderMeasures& measures);
  void write_sweep() const;
  bool fail(const std::string& status);

  const SweepOptions& options_;
  const io::ResultFolder& folder_;
  CylinderFlow cylinder_;
  nlohmann::json parameters_;
  CylinderFlow::State state_;
  double loading_ = 0;  // of state_
  std::vector<PathRecord> records_;
  bool has_start_ = false;  // the next point accepted is the last record's
  int path_points_ = 0;     // of the path being followed
  int earlier_factorisations_ = 0, earlier_iterations_ = 0;
  std::string way_;  // to the loading that is being reached
  std::vector<Arrival> arrivals_;
  std::vector<CylinderMeasures> sweep_;
  std::vector<io::SeriesEntry> series_;
  std::string status_ = "converged";
  io::Progress progress_;
};

}  // namespace talus::twod
