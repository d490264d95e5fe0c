// The flow around the cylinder past yield: paths of solutions, their folds, and the law that has
// none.
#include <algorithm>
#include <cmath>

#include "common/solve/stopwatch.hpp"
#include "twod/cylinder.hpp"
#include "verification/cylinder_parts.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

constexpr double creeping = 0.044, flowing = 0.054;

struct Followed {
  solve::PathEnd end = solve::PathEnd::start_failed;
  std::vector<twod::CylinderMeasures> measures;
  std::vector<solve::PathPoint> points;
  int folds = 0, factorisations = 0;
  double seconds = 0;

  bool arrived() const { return end == solve::PathEnd::target_reached; }
  const twod::CylinderMeasures& last() const { return measures.back(); }
  double largest_loading() const {
    double largest = 0;
    for (const auto& m : measures) largest = std::max(largest, m.loading);
    return largest;
  }
  double smallest_lambda_r() const {
    double smallest = 1;
    for (const auto& m : measures) smallest = std::min(smallest, m.lambda_r);
    return smallest;
  }
};

twod::CylinderObserver recorder(Followed& followed) {
  return [&followed](const auto&, const auto& measures, const auto& point) {
    followed.measures.push_back(measures);
    followed.points.push_back(point);
    if (point.is_fold_passed) ++followed.folds;
    return true;
  };
}

twod::Cylinder scene_of(const rheology::Regularisation& law, int around) {
  twod::Cylinder scene;
  scene.mesh = twod::refined_to(around);
  scene.regularisation = law;
  return scene;
}

// From creep at 0.044 along the loading to 0.054, at λr = 1e-6.
Followed along_loading(const rheology::Regularisation& law, int around,
                       twod::Continuation continuation, int max_points) {
  const solve::Stopwatch watch;
  twod::CylinderFlow cylinder(scene_of(law, around));
  auto start = twod::solve_from_rest(cylinder, creeping);
  Followed followed;
  auto options = twod::cylinder_path_options();
  options.max_points = max_points;
  const auto path =
      twod::follow_loading(cylinder, {.state = start.next.state, .parameter = creeping}, flowing,
                           continuation, options, recorder(followed));
  followed.end = path.end;
  followed.factorisations = cylinder.flow().factorisations();
  followed.seconds = watch.seconds();
  return followed;
}

// At a loading, from λr = 0.1 down to 1e-6.
Followed along_lambda_r(const rheology::Regularisation& law, int around, double loading,
                        int max_points) {
  const solve::Stopwatch watch;
  twod::CylinderFlow cylinder(scene_of(law, around));
  Followed followed;
  auto options = twod::cylinder_path_options();
  options.max_points = max_points;
  const auto path = twod::solve_from_rest(cylinder, loading, twod::Continuation::arclength, options,
                                          recorder(followed));
  followed.end = path.end;
  followed.factorisations = cylinder.flow().factorisations();
  followed.seconds = watch.seconds();
  return followed;
}

// eq. (12) and every law of the registry without a yield stress: the controls.
std::vector<rheology::Regularisation> laws() {
  std::vector<rheology::Regularisation> laws = {rheology::ChauchatMedale{}};
  for (const auto& law : rheology::regularisations())
    if (!rheology::has_yield_stress(law)) laws.push_back(law);
  return laws;
}

std::vector<std::string> row_of(const std::string& name, const Followed& f) {
  return {name,
          solve::name_of(f.end),
          io::rounded(f.largest_loading(), 6),
          std::to_string(f.points.size()),
          std::to_string(f.folds),
          std::to_string(f.factorisations),
          f.arrived() ? io::rounded(f.last().mean_velocity, 5) : "",
          f.arrived() ? io::rounded(f.last().drag, 5) : "",
          f.measures.empty() ? "" : io::rounded(f.last().min_pressure, 3),
          f.measures.empty() ? "" : io::rounded(f.last().ill_posed_share, 3),
          io::rounded(f.seconds, 3)};
}

void loadings(Chapter& chapter, const Context& context) {
  const int around = context.full ? 40 : 16;
  io::Table table{
      "Along the loading from 0.044 to 0.054 at λr = 1e-6, " + std::to_string(around) +
          " elements around; the share of the area where the flow has yielded and C > 0",
      {"law, continuation", "end", "largest F", "points", "folds", "factorisations", "U", "F_D",
       "smallest pressure", "ill-posed share", "CPU s"},
      {}};
  io::Panel panel{"Along the loading", "F", "U", false, true, {}};
  panel.key = "top left";
  for (const auto& law : laws())
    for (const auto continuation : {twod::Continuation::arclength, twod::Continuation::natural}) {
      const bool natural = continuation == twod::Continuation::natural;
      const bool yields = rheology::has_yield_stress(law);
      const Followed f = along_loading(law, around, continuation, context.full ? 250 : 120);
      const std::string name = rheology::name_of(law) + (natural ? ", natural" : ", arclength");
      table.rows.push_back(row_of(name, f));
      io::Curve curve{natural ? "natural" : rheology::name_of(law),
                      {},
                      {},
                      natural ? io::Style::points : io::Style::line};
      io::Curve folds{"folds", {}, {}, io::Style::rings};
      for (std::size_t i = 0; i < f.points.size(); ++i) {
        curve.x.push_back(f.measures[i].loading);
        curve.y.push_back(f.measures[i].mean_velocity);
        if (!f.points[i].is_fold_passed) continue;
        folds.x.push_back(f.measures[i].loading);
        folds.y.push_back(f.measures[i].mean_velocity);
      }
      panel.curves.push_back(curve);
      if (!folds.x.empty()) panel.curves.push_back(folds);
      if (yields && !natural)
        chapter.check(name + ": largest loading, past yield at 0.049", f.largest_loading(), 0.0495,
                      flowing);
      if (!yields && !natural) {
        chapter.check(name + ": folds on the way to 0.054", f.folds, 0, 0);
        chapter.check(name + ": loading reached", f.last().loading, flowing, flowing);
      }
    }
  chapter.text(
      "Along the loading the velocity of eq. (12) jumps by orders of magnitude at F ≈ 0.05, where "
      "the material yields: steeply, on coarse meshes along an S with two folds. Beyond, the path "
      "may fold again and again within a narrow range of the loading, where the equations are "
      "ill-posed (C > 0) and bands one element wide yield in turn. Natural continuation ends at "
      "the first fold, whatever its step; arclength continuation goes on. The control law, "
      "well-posed at small I, has no fold on the same mesh with the same solver.");
  chapter.table(std::move(table));
  chapter.figure({"loading_paths",
                  "Mean velocity along the loading: arclength continuation as lines, natural "
                  "continuation as points on them, folds ringed.",
                  {panel},
                  1});
}

void atlas(Chapter& chapter, const Context& context) {
  const std::vector<int> arounds = context.full ? std::vector{16, 24, 32, 40, 80} : std::vector{16};
  io::Table table{
      "In λr from 0.1 to 1e-6 at F = 0.052: the smallest λr reached and the folds passed",
      {"law", "around", "end", "smallest λr", "folds", "points", "factorisations", "U", "F_D",
       "CPU s"},
      {}};
  io::Panel panel{"In λr at F = 0.052", "λ_r", "U", true, false, {}};
  panel.key = "top left";
  for (const auto& law : laws())
    for (const int around : arounds) {
      const Followed f = along_lambda_r(law, around, 0.052, context.full ? 250 : 120);
      const std::string name = rheology::name_of(law);
      table.rows.push_back({name, std::to_string(around), solve::name_of(f.end),
                            io::rounded(f.smallest_lambda_r(), 3), std::to_string(f.folds),
                            std::to_string(f.points.size()), std::to_string(f.factorisations),
                            f.arrived() ? io::rounded(f.last().mean_velocity, 5) : "",
                            f.arrived() ? io::rounded(f.last().drag, 5) : "",
                            io::rounded(f.seconds, 3)});
      io::Curve curve{name + ", " + std::to_string(around), {}, {}, io::Style::line_points};
      for (const auto& m : f.measures) {
        curve.x.push_back(m.lambda_r);
        curve.y.push_back(m.mean_velocity);
      }
      panel.curves.push_back(curve);
      if (!rheology::has_yield_stress(law)) {
        const std::string what = name + ", " + std::to_string(around) + " around, F = 0.052: ";
        chapter.check(what + "folds", f.folds, 0, 0);
        chapter.check(what + "smallest λr reached", f.smallest_lambda_r(), 0.999e-6, 1.001e-6);
      }
    }
  chapter.table(std::move(table));
  chapter.figure(
      {"lambda_paths", "Mean velocity as the regularisation is taken away.", {panel}, 1});
}

}  // namespace

void cylinder_paths(Chapter& chapter, const Context& context) {
  loadings(chapter, context);
  context.progress(0.8);
  atlas(chapter, context);
}

}  // namespace talus::verification
