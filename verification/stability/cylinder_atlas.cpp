// Where paths in λr past yield lead: over the meshes, with and without eq. (16), natural and
// arclength.
#include "verification/stability/cylinder_atlas.hpp"

#include <algorithm>
#include <cmath>

#include "verification/harness/methods.hpp"
#include "verification/stability/stability_parts.hpp"

namespace talus::verification {

const std::vector<WayDown>& ways_down() {
  static const std::vector<WayDown> all = {
      {"arclength"},
      {"primal-dual", twod::Continuation::primal_dual},
      {"without (16)", twod::Continuation::arclength, false},
      {"natural", twod::Continuation::natural, true, 0, false},
      {"floor 0.01", twod::Continuation::arclength, true, 0.01, false}};
  return all;
}

namespace {

constexpr double loading = 0.054;  // the paper's flowing one
constexpr int bins = 10;           // of λr from 0.1 to 1e-6, half a decade each

// Elements around that a way is tried on: the quick ones on more meshes.
std::vector<int> meshes_for(const WayDown& way, bool full) {
  const bool is_quick = way.continuation == twod::Continuation::primal_dual;
  if (full) return is_quick ? std::vector{16, 24, 32, 40, 80} : std::vector{16, 24, 32, 40};
  if (!way.in_quick_run) return {};
  return is_quick ? std::vector{16, 24} : std::vector{16};
}

Followed follow(const rheology::Regularisation& law, int around, const WayDown& way,
                int max_points) {
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

std::vector<std::string> row_of(const LambdaPath& path) {
  const Followed& f = path.followed;
  const bool started = !f.measures.empty();
  return {rheology::name_of(path.law),
          std::to_string(path.around),
          path.way.label,
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

std::vector<LambdaPath> paths(const Context& context) {
  std::vector<LambdaPath> all;
  for (const auto& law : laws_of_paths())
    for (const WayDown& way : ways_down())
      for (const int around : meshes_for(way, context.full))
        all.push_back({law, way, around, follow(law, around, way, context.full ? 250 : 30)});
  return all;
}

// A panel for each law, in the order of the paths.
void draw(Chapter& chapter, const std::vector<LambdaPath>& paths) {
  io::Figure maps{
      "cylinder_atlas",
      "How far paths in λr around the cylinder come at F = 0.054 (rows: way and elements "
      "around; grey: not reached). Colour: factorisations in a half decade of λr.",
      {},
      2};
  io::Figure lines{
      "cylinder_lambda_paths",
      "Mean velocity of the cylinder at F = 0.054 as the regularisation is taken away, "
      "arclength continuation, on the meshes of the key.",
      {},
      2};
  for (const auto& law : laws_of_paths()) {
    const std::string name = rheology::name_of(law);
    io::Panel map{name, "λr", "way, elements around", false, false, {}, empty_map()};
    io::Panel panel{name, "λr", "U / sqrt(p_ext / φρ)", true, false, {}};
    io::Curve folds{"folds", {}, {}, io::Style::rings};
    for (const LambdaPath& path : paths) {
      if (rheology::name_of(path.law) != name) continue;
      const std::string around = std::to_string(path.around);
      add_row(*map.map, path.way.label + ", " + around, path.followed);
      if (path.way.label != ways_down().front().label) continue;
      panel.curves.push_back(curve_of(around + " around", path.followed));
      add_folds(folds, path.followed);
    }
    if (!folds.x.empty()) panel.curves.push_back(folds);
    maps.panels.push_back(std::move(map));
    lines.panels.push_back(std::move(panel));
  }
  const bool has_folds =
      std::ranges::any_of(paths, [](const auto& p) { return p.followed.folds() > 0; });
  const bool has_losses =
      std::ranges::any_of(paths, [](const auto& p) { return !p.followed.arrived(); });
  if (has_folds) {
    maps.caption += " 2f: two folds passed.";
    lines.caption += " Rings: folds.";
  }
  if (has_losses) maps.caption += " ×: given up there.";
  chapter.figure(std::move(maps));
  chapter.figure(std::move(lines));
}

// Primal-dual is the way that is recommended.
void count_ends(Chapter& chapter, const std::vector<LambdaPath>& paths) {
  for (const WayDown& way : ways_down()) {
    Ends ends{"cylinder, plane", way.label == ways_down()[1].label};
    for (const LambdaPath& path : paths)
      if (path.way.label == way.label)
        ++ends.counts[path.followed.arrived() ? arrival : solve::name_of(path.followed.end)];
    if (!ends.counts.empty()) chapter.ends.push_back(std::move(ends));
  }
}

void tabulate(Chapter& chapter, const std::vector<LambdaPath>& paths) {
  io::Table table{"Paths in λr from 0.1 to 1e-6 at F = 0.054 around the cylinder",
                  {"law", "around", "way", "end", "smallest λr", "folds", "points",
                   "factorisations", "U", "F_D", "smallest pressure", "share p < 0", "CPU s"},
                  {}};
  for (const LambdaPath& path : paths) table.rows.push_back(row_of(path));
  chapter.table(std::move(table));
}

// Whether a way was tried on the law and mesh of a path.
bool has_mesh(const std::vector<LambdaPath>& paths, const WayDown& way, const LambdaPath& like) {
  return std::ranges::any_of(paths, [&](const LambdaPath& path) {
    return path.way.label == way.label && path.around == like.around &&
           rheology::name_of(path.law) == rheology::name_of(like.law);
  });
}

}  // namespace

void judge_atlas(Chapter& chapter, const std::vector<LambdaPath>& paths) {
  const WayDown &arclength = ways_down()[0], &primal_dual = ways_down()[1];
  int arrived = 0, work_of_primal_dual = 0, work_of_arclength = 0;
  bool is_sound = true;  // the primal-dual tangent, where it should be
  std::string given_up;
  for (const LambdaPath& path : paths) {
    const auto& [law, way, around, f] = path;
    const std::string mesh = std::to_string(around) + " around";
    arrived += f.arrived() ? 1 : 0;
    if (!f.arrived())
      given_up += (given_up.empty() ? "" : "; ") + rheology::name_of(law) + ", " + way.label +
                  ", " + mesh + " (" + solve::name_of(f.end) + ")";
    const bool is_primal_dual = way.label == primal_dual.label;
    const bool is_arclength = way.label == arclength.label;
    if (is_arclength) work_of_arclength += f.factorisations;
    if (is_primal_dual && has_mesh(paths, arclength, path)) work_of_primal_dual += f.factorisations;
    // Eq. (12) has several flows on 16 elements, and on 80 a path of many steps.
    const bool is_sure = !rheology::has_yield_stress(law) || (around >= 24 && around <= 40);
    const bool has_no_fold = !rheology::has_yield_stress(law) && is_arclength;
    if (!(is_primal_dual && is_sure) && !has_no_fold) continue;
    const std::string what = rheology::name_of(law) + ", " + way.label + ", " + mesh +
                             ", F = " + io::rounded(loading) + ": ";
    const bool arrives = chapter.check(Kind::self_consistency, what + "smallest λr reached",
                                       f.smallest_lambda_r(), 0.999e-6, 1.001e-6);
    // Creep would have some 1e-5.
    const bool flows = chapter.check(Kind::self_consistency, what + "U, a flow's",
                                     if_counts(f.arrived(), f.last().mean_velocity), 0.05, 1);
    if (is_primal_dual) is_sound = is_sound && arrives && flows;
    if (has_no_fold)
      chapter.check(Kind::self_consistency, what + "folds", if_counts(f.arrived(), f.folds()), 0,
                    0);
  }
  chapter.text(
      "Paths in λr past yield, F = 0.054: " + std::to_string(arrived) + " of " +
      std::to_string(paths.size()) +
      " arrive at λr = 1e-6. Given up: " + (given_up.empty() ? "none" : given_up) +
      ". With a stress carried beside the velocity (primal-dual) Newton's method " +
      (is_sound ? "converges" : "should converge, but a check of that fails,") +
      " from decade to decade of λr, far from the path between; on the meshes of both it takes " +
      std::to_string(work_of_primal_dual) + " factorisations, arclength continuation " +
      std::to_string(work_of_arclength) +
      ", those of paths given up included. Where several flows exist it may land in another one "
      "than the path leads to: compare U.");
}

void cylinder_atlas(Chapter& chapter, const Context& context) {
  const std::vector<LambdaPath> all = paths(context);
  judge_atlas(chapter, all);
  count_ends(chapter, all);
  draw(chapter, all);
  tabulate(chapter, all);
}

}  // namespace talus::verification
