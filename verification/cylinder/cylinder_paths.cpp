// The flow around the cylinder past yield: paths along the loading, their folds, the law that has
// none, and what ends a sweep.
#include <algorithm>
#include <cmath>

#include "verification/cylinder/cylinder_parts.hpp"

namespace talus::verification {
namespace {

Followed follow(const Sweep& sweep, int around, int max_points) {
  twod::Cylinder scene = cylinder_around(around, sweep.law);
  scene.inertia = sweep.inertia;
  return along_loading(scene, sweep.goes_beyond() ? beyond : flowing, sweep.continuation,
                       max_points);
}

std::vector<Sweep> sweeps() {
  std::vector<Sweep> all;
  for (const auto& law : laws_of_paths())
    for (const Sweep& sweep : {Sweep{law}, Sweep{law, twod::Continuation::natural},
                               Sweep{law, twod::Continuation::primal_dual},
                               Sweep{law, twod::Continuation::primal_dual, false}})
      all.push_back(sweep);
  return all;
}

io::Figure empty_figure(const std::string& mesh) {
  io::Panel velocity{"Along the loading", "F", "U / sqrt(p_ext / φρ)", false, true, {}};
  io::Panel negative{"Negative total pressure", "F", "share of the area", false, false, {}};
  io::Panel ill_posed{"Yielded where C > 0", "F", "share of the area", false, false, {}};
  io::Panel step{"What is left of the steps", "F", "step in F, over 0.001", false, true, {}};
  return {"loading_paths",
          "The cylinder up the loading F = φρgD/p_ext, " + mesh +
              ": by arclength and with the primal-dual tangent as lines, natural continuation as "
              "points on them. ",
          {velocity, negative, ill_posed, step},
          2};
}

void add_curves(io::Figure& figure, const Sweep& sweep, const Followed& f) {
  const io::Curve empty{
      sweep.label(), {}, {}, sweep.is_natural() ? io::Style::points : io::Style::line};
  io::Curve velocity = empty, negative = empty, ill_posed = empty, step = empty;
  io::Curve folds{"folds", {}, {}, io::Style::rings};
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const auto& m = f.measures[i];
    for (io::Curve* curve : {&velocity, &negative, &ill_posed, &step})
      curve->x.push_back(m.loading);
    velocity.y.push_back(m.mean_velocity);
    negative.y.push_back(m.negative_share);
    ill_posed.y.push_back(m.ill_posed_share);
    step.y.push_back(i > 0 ? f.points[i].step : std::nan(""));
    if (!f.points[i].is_fold_passed) continue;
    folds.x.push_back(m.loading);
    folds.y.push_back(m.mean_velocity);
  }
  figure.panels[0].curves.push_back(velocity);
  if (!folds.x.empty()) figure.panels[0].curves.push_back(folds);
  if (!sweep.goes_beyond()) return;
  figure.panels[1].curves.push_back(negative);
  figure.panels[2].curves.push_back(ill_posed);
  figure.panels[3].curves.push_back(step);
}

// The point at which a path first comes to each of these loadings.
void add_rows(io::Table& table, const Sweep& sweep, const Followed& f) {
  const std::vector<double> marks = {0.048, 0.05,  0.051, 0.052, 0.053, 0.054,
                                     0.055, 0.056, 0.058, 0.06,  0.065};
  std::size_t next = 0;
  int folds = 0;
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const auto& m = f.measures[i];
    folds += f.points[i].is_fold_passed ? 1 : 0;
    const bool arrives = next < marks.size() && m.loading >= marks[next];
    while (next < marks.size() && m.loading >= marks[next]) ++next;
    if (arrives || i + 1 == f.points.size())
      table.rows.push_back({sweep.label(), io::rounded(m.loading, 6),
                            io::rounded(m.mean_velocity, 4), io::rounded(m.drag, 4),
                            io::rounded(m.min_pressure, 2), io::rounded(m.negative_share, 2),
                            io::rounded(m.ill_posed_share, 2), io::rounded(m.yielded_share, 2),
                            std::to_string(folds), io::rounded(f.points[i].step, 2)});
  }
}

std::string how_it_ended(const Sweep& sweep, const Followed& f) {
  return sweep.label() + ": " + solve::name_of(f.end) +
         " at F = " + io::rounded(f.last().loading, 5) +
         " and U = " + io::rounded(f.last().mean_velocity, 2) + " after " +
         std::to_string(f.folds()) + " folds and " + std::to_string(f.factorisations) +
         " factorisations";
}

}  // namespace

void cylinder_paths(Chapter& chapter, const Context& context) {
  const int around = context.full ? 40 : 16;
  const std::string mesh = "λr = 1e-6, " + std::to_string(around) + " elements around";
  io::Table ends{
      "Up the loading from 0.044: how the sweeps end; " + mesh,
      {"law", "end", "largest F", "points", "folds", "factorisations", "last step", "CPU s"},
      {}};
  io::Table shares{"On the way: shares of the area, folds so far, length of the step; " + mesh,
                   {"law", "F", "U", "drag", "smallest p", "share p < 0", "share C > 0",
                    "share yielded", "folds", "step"},
                   {}};
  io::Figure figure = empty_figure(mesh);
  std::string endings;
  const std::vector<Sweep> all = sweeps();
  int folds = 0, arrived = 0;
  std::size_t done = 0;
  for (const Sweep& sweep : all) {
    const Followed f = follow(sweep, around, context.full ? 250 : 35);
    ends.rows.push_back({sweep.label(), solve::name_of(f.end), io::rounded(f.largest_loading(), 6),
                         std::to_string(f.points.size()), std::to_string(f.folds()),
                         std::to_string(f.factorisations),
                         f.points.empty() ? "" : io::rounded(f.points.back().step, 2),
                         io::rounded(f.seconds, 3)});
    if (!sweep.is_natural()) add_rows(shares, sweep, f);
    add_curves(figure, sweep, f);
    judge_sweep(chapter, sweep, f);
    folds += f.folds();
    arrived += f.arrived() ? 1 : 0;
    endings += (endings.empty() ? "" : "; ") + how_it_ended(sweep, f);
    context.progress(static_cast<double>(++done) / static_cast<double>(all.size()));
  }
  chapter.text(
      "At F ≈ 0.05 the material yields; the curve over the loading may be an S there, with two "
      "folds. Natural continuation cannot pass a fold, whatever its step; arclength continuation "
      "can, and steps with the primal-dual tangent may land beyond it. How the sweeps of this run "
      "ended: " +
      endings + ".");
  chapter.text(
      "What to look for: the share of the area that flows where the equations are ill-posed "
      "(C > 0), with eq. (12) and with the control law; and what inertia does where the pressure "
      "behind the cylinder is negative and little viscosity is left to balance it.");
  chapter.table(std::move(ends));
  // Lines first: then a law has one colour in all panels.
  std::ranges::stable_partition(figure.panels[0].curves, [](const io::Curve& curve) {
    return curve.style == io::Style::line;
  });
  figure.caption += folds > 0 ? "Rings: folds." : "No fold was passed.";
  chapter.answer(std::to_string(arrived) + " of " + std::to_string(all.size()) +
                 " sweeps up the loading arrive where they were sent; " + std::to_string(folds) +
                 " folds are passed on the way.");
  chapter.figure(std::move(figure));
  chapter.table(std::move(shares));
}

}  // namespace talus::verification
