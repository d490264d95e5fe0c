// Where paths in λr past yield lead: over the meshes, with and without eq. (16), natural and
// arclength; and what the penalty parameter does there.
#include <algorithm>
#include <cmath>

#include "verification/cylinder_runs.hpp"
#include "verification/methods.hpp"
#include "verification/stability_parts.hpp"

namespace talus::verification {
namespace {

constexpr double loading = 0.054;  // the paper's flowing one
constexpr double pressure_floor = 0.01;
constexpr int bins = 10;  // of λr from 0.1 to 1e-6, half a decade each

// A way down in λr.
struct Way {
  std::string label;
  twod::Continuation continuation = twod::Continuation::arclength;
  bool regularises_pressure = true;
  double pressure_floor = 0;
  bool in_quick_run = true;
};

const std::vector<Way>& ways() {
  static const std::vector<Way> all = {
      {"arclength"},
      {"primal-dual", twod::Continuation::primal_dual},
      {"without (16)", twod::Continuation::arclength, false},
      {"natural", twod::Continuation::natural, true, 0, false},
      {"floor 0.01", twod::Continuation::arclength, true, pressure_floor, false}};
  return all;
}

// Elements around that a way is tried on: the quick ones on more meshes.
std::vector<int> meshes_for(const Way& way, bool full) {
  const bool is_quick = way.continuation == twod::Continuation::primal_dual;
  if (full) return is_quick ? std::vector{16, 24, 32, 40, 80} : std::vector{16, 24, 32, 40};
  if (!way.in_quick_run) return {};
  return is_quick ? std::vector{16, 24} : std::vector{16};
}

Followed follow(const rheology::Regularisation& law, int around, const Way& way, int max_points) {
  twod::Cylinder scene = cylinder_around(around, law);
  scene.regularises_pressure = way.regularises_pressure;
  scene.pressure_floor = way.pressure_floor;
  return along_lambda_r(scene, loading, way.continuation, max_points);
}

std::size_t bin_of(double lambda_r) {
  const double place = std::floor(-2 * (std::log10(lambda_r) + 1) + 1e-9);
  return static_cast<std::size_t>(std::clamp(place, 0.0, bins - 1.0));
}

io::Map empty_map() {
  io::Map map;
  for (int i = 0; i < bins; ++i)
    map.columns.push_back(i % 2 == 0 ? short_power(std::pow(10, -1 - i / 2)) : "");
  map.value_label = "factorisations";
  map.largest = 100;
  return map;
}

// One row of the atlas: the work in each half decade of λr; folds counted, the stop crossed.
void add_row(io::Map& map, const std::string& name, const Followed& f) {
  std::vector<double> work(bins, std::nan(""));
  std::vector<int> folds(bins, 0);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const std::size_t bin = bin_of(f.measures[i].lambda_r);
    // Half decades above the start, or that a long step goes over, cost nothing.
    for (std::size_t over = i > 0 ? bin_of(f.measures[i - 1].lambda_r) : 0; over < bin; ++over)
      if (std::isnan(work[over])) work[over] = 0;
    work[bin] = (std::isnan(work[bin]) ? 0 : work[bin]) + f.points[i].cost.factorisations;
    folds[bin] += f.points[i].is_fold_passed ? 1 : 0;
  }
  std::vector<std::string> marks(bins);
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (folds[i] > 0) marks[i] = std::to_string(folds[i]) + "f";
  if (!f.arrived()) marks[f.measures.empty() ? 0 : bin_of(f.last().lambda_r)] += "×";
  map.rows.push_back(name);
  map.values.push_back(work);
  map.marks.push_back(marks);
}

io::Curve curve_of(const std::string& label, const Followed& f) {
  io::Curve curve{label, {}, {}};
  for (const auto& m : f.measures) {
    curve.x.push_back(m.lambda_r);
    curve.y.push_back(m.mean_velocity);
  }
  return curve;
}

std::vector<std::string> row_of(const std::string& law, int around, const Way& way,
                                const Followed& f) {
  const bool started = !f.measures.empty();
  return {law,
          std::to_string(around),
          way.label,
          solve::name_of(f.end),
          io::rounded(f.smallest_lambda_r(), 3),
          std::to_string(f.folds()),
          std::to_string(f.points.size()),
          std::to_string(f.factorisations),
          f.arrived() ? io::rounded(f.last().mean_velocity, 5) : "",
          f.arrived() ? io::rounded(f.last().drag, 5) : "",
          started ? io::rounded(f.last().min_pressure, 3) : "",
          started ? io::rounded(f.last().negative_share, 2) : "",
          io::rounded(f.seconds, 3)};
}

void add_folds(io::Curve& folds, const Followed& f) {
  for (std::size_t i = 0; i < f.points.size(); ++i)
    if (f.points[i].is_fold_passed) {
      folds.x.push_back(f.measures[i].lambda_r);
      folds.y.push_back(f.measures[i].mean_velocity);
    }
}

void atlas(Chapter& chapter, const Context& context) {
  io::Table table{"Paths in λr from 0.1 to 1e-6 at F = 0.054 around the cylinder",
                  {"law", "around", "way", "end", "smallest λr", "folds", "points",
                   "factorisations", "U", "F_D", "smallest pressure", "share p < 0", "CPU s"},
                  {}};
  io::Figure maps{"cylinder_atlas",
                  "How far paths in λr come at F = 0.054 (rows: way and elements around; grey: not "
                  "reached). Colour: factorisations in a half decade of λr; 2f: two folds passed; "
                  "×: given up there.",
                  {},
                  2};
  io::Figure lines{"cylinder_lambda_paths",
                   "Mean velocity at F = 0.054 as the regularisation is taken away, arclength "
                   "continuation; folds ringed.",
                   {},
                   2};
  int arrived = 0, work_of_primal_dual = 0, work_of_arclength = 0;
  std::string given_up;
  for (const auto& law : laws_of_paths()) {
    const std::string name = rheology::name_of(law);
    io::Panel map{name, "λr", "way, elements around", false, false, {}, empty_map()};
    io::Panel panel{name, "λ_r", "U", true, false, {}};
    panel.key = "top left";
    io::Curve folds{"folds", {}, {}, io::Style::rings};
    for (const Way& way : ways())
      for (const int around : meshes_for(way, context.full)) {
        const Followed f = follow(law, around, way, context.full ? 250 : 30);
        add_row(*map.map, way.label + ", " + std::to_string(around), f);
        table.rows.push_back(row_of(name, around, way, f));
        arrived += f.arrived() ? 1 : 0;
        if (!f.arrived())
          given_up += (given_up.empty() ? "" : "; ") + name + ", " + way.label + ", " +
                      std::to_string(around) + " around (" + solve::name_of(f.end) + ")";
        const auto both = meshes_for(ways().front(), context.full);
        if (way.label == "arclength") work_of_arclength += f.factorisations;
        if (way.label == "primal-dual" && std::ranges::find(both, around) != both.end())
          work_of_primal_dual += f.factorisations;
        // Eq. (12) has several flows on 16 elements, and on 80 a path of many steps.
        const bool is_sure = !rheology::has_yield_stress(law) || (around >= 24 && around <= 40);
        if (way.continuation == twod::Continuation::primal_dual && is_sure)
          chapter.check(name + ", primal-dual, " + std::to_string(around) +
                            " around, F = 0.054: smallest λr reached",
                        f.smallest_lambda_r(), 0.999e-6, 1.001e-6);
        if (&way != &ways().front()) continue;
        panel.curves.push_back(curve_of(std::to_string(around) + " around", f));
        add_folds(folds, f);
        if (rheology::has_yield_stress(law)) continue;
        const std::string what = name + ", " + std::to_string(around) + " around, F = 0.054: ";
        chapter.check(what + "folds", if_counts(f.arrived(), f.folds()), 0, 0);
        chapter.check(what + "smallest λr reached", f.smallest_lambda_r(), 0.999e-6, 1.001e-6);
      }
    if (!folds.x.empty()) panel.curves.push_back(folds);
    maps.panels.push_back(std::move(map));
    lines.panels.push_back(std::move(panel));
  }
  chapter.text(
      "Paths in λr past yield, F = 0.054: " + std::to_string(arrived) + " of " +
      std::to_string(table.rows.size()) +
      " arrive at λr = 1e-6. Given up: " + (given_up.empty() ? "none" : given_up) +
      ". With a stress carried beside the velocity (primal-dual) Newton's method converges from "
      "decade to decade of λr, far from the path between; on the meshes of both it takes " +
      std::to_string(work_of_primal_dual) + " factorisations, arclength continuation " +
      std::to_string(work_of_arclength) +
      ". Where several flows exist it may land in another one than the path leads to: compare U.");
  chapter.figure(std::move(maps));
  chapter.figure(std::move(lines));
  chapter.table(std::move(table));
}

// Where the iterated penalty is meant to be used: larger ones stall its iterations, smaller ones
// lose the digits of the matrix.
bool conditions_well(double lambda_p) {
  return lambda_p < 2e-4 && lambda_p > 0.5e-8;
}

// λp from 1e-2 to 1e-12, from rest to a flow past yield, against the iterated penalty's default.
void penalties(Chapter& chapter, const Context& context) {
  constexpr double past_yield = 0.052;
  const double lambda_r = context.full ? 1e-6 : 1e-4;
  const std::vector<double> lambda_ps = context.full
                                            ? std::vector{1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}
                                            : std::vector{1e-4, 1e-8, 1e-12};
  io::Table table{
      "Penalty past yield: paths in λr from 0.1 to " + short_power(lambda_r) +
          " at F = 0.052, 16 elements around",
      {"law", "penalty", "λp", "end", "points", "factorisations", "U", "F_D", "projected div u"},
      {}};
  for (const auto& law : laws_of_paths()) {
    if (!context.full && rheology::has_yield_stress(law)) continue;
    twod::Cylinder scene = cylinder_around(16, law);
    scene.lambda_r = lambda_r;
    const auto solved = [&](const flow::PenaltyOptions& penalty) {
      scene.penalty = penalty;
      return along_lambda_r(scene, past_yield, twod::Continuation::arclength, 60);
    };
    const Followed usual = solved({});
    const double drag = if_counts(usual.arrived(), usual.last().drag);
    double worst = 0;
    std::string not_arrived;
    for (const auto kind : {flow::Penalty::iterated, flow::Penalty::plain})
      for (const double lambda_p : lambda_ps) {
        const Followed f = solved({kind, lambda_p});
        const bool is_iterated = kind == flow::Penalty::iterated;
        if (is_iterated && conditions_well(lambda_p))
          worst = solve::nan_max(worst, if_counts(f.arrived(), std::abs(f.last().drag / drag - 1)));
        if (!f.arrived())
          not_arrived += (not_arrived.empty() ? "" : ", ") +
                         std::string(is_iterated ? "iterated " : "plain ") + short_power(lambda_p);
        table.rows.push_back({rheology::name_of(law), is_iterated ? "iterated" : "plain",
                              short_power(lambda_p), solve::name_of(f.end),
                              std::to_string(f.points.size()), std::to_string(f.factorisations),
                              f.arrived() ? io::rounded(f.last().mean_velocity, 5) : "",
                              f.arrived() ? io::rounded(f.last().drag, 5) : "",
                              f.arrived() ? io::rounded(f.last().projected_divergence, 2) : ""});
      }
    chapter.check(rheology::name_of(law) +
                      ", past yield, iterated penalty, λp from 1e-8 to 1e-4: change of the drag",
                  worst, 0, 1e-4);
    chapter.text("Penalties past yield, " + rheology::name_of(law) + ": " +
                 (not_arrived.empty() ? "every path arrived."
                                      : "paths that did not arrive: " + not_arrived + "."));
  }
  chapter.table(std::move(table));
}

}  // namespace

void add_cylinder_atlas(Chapter& chapter, const Context& context) {
  atlas(chapter, context);
  penalties(chapter, context);
}

}  // namespace talus::verification
