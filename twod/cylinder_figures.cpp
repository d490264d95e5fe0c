// The figures of a run of the cylinder, as the paper draws them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "twod/cylinder_report.hpp"

namespace talus::twod {
namespace {

using State = CylinderFlow::State;

// The paper's validity domain: what is slower it takes for creep.
constexpr double slowest_shown = 0.005, onset_shown = 0.05;

}  // namespace

std::vector<PerimeterPoint> perimeter(const CylinderFlow& cylinder, const State& state) {
  std::vector<PerimeterPoint> points;
  const auto& mesh = cylinder.space().mesh();
  for (const fem::Face& face : mesh.boundaries.at("cylinder"))
    for (const auto& each : fem::face_rule(mesh, face)) {
      PerimeterPoint point;
      point.at = cylinder.flow().point_at(state, face.element, each.reference);
      const auto& x = point.at.values.position;
      if (x[0] < 0) continue;
      point.angle = std::atan2(x[0], -x[1]);
      const Eigen::Matrix2d gamma =
          point.at.values.velocity_gradient + point.at.values.velocity_gradient.transpose();
      const fem::Point<2> normal = -each.normal;  // out of the cylinder
      const fem::Point<2> tangent(normal[1], -normal[0]);
      const fem::Point<2> drag = point.at.law.viscosity * gamma * normal;
      point.normal_stress = drag.dot(normal) - point.at.law.total_pressure;
      point.shear_stress = drag.dot(tangent);
      points.push_back(point);
    }
  std::ranges::sort(points, {}, &PerimeterPoint::angle);
  return points;
}

io::Table perimeter_table(const CylinderFlow& cylinder, const State& state) {
  io::Table table{"",
                  {"angle", "dynamic_pressure", "total_pressure", "regularised_pressure",
                   "normal_stress", "shear_stress", "regularised_normal_stress"},
                  {}};
  for (const PerimeterPoint& p : perimeter(cylinder, state))
    table.rows.push_back({io::exact(p.angle * 180 / std::numbers::pi),
                          io::exact(p.at.values.pressure), io::exact(p.at.law.total_pressure),
                          io::exact(p.at.law.regularised_pressure), io::exact(p.normal_stress),
                          io::exact(p.shear_stress), io::exact(p.regularised_normal_stress())});
  return table;
}

io::Figure drag_figure(const std::vector<CylinderMeasures>& sweep,
                       const std::vector<double>& confining_pressures) {
  const std::string froude = "Fr = U/sqrt(gD)", effective = "Fr = U/sqrt(g(D+d))";
  io::Panel force{"Drag", froude, "F_D / (p_ext D)", false, false, {}};
  io::Panel onset{"Drag where flow sets in", froude, "F_D / (p_ext D)", true, false, {}};
  io::Panel coefficient{"Drag coefficient", effective, "C_D", true, true, {}};
  io::Panel collapse{"The same over p_ext", effective, "C_D / p_ext", true, true, {}};
  for (const double p : confining_pressures) {
    const io::Curve empty{"p_ext = " + io::rounded(p), {}, {}};
    for (io::Panel* panel : {&force, &onset, &coefficient, &collapse})
      panel->curves.push_back(empty);
    const auto add = [](io::Panel& panel, double x, double y) {
      panel.curves.back().x.push_back(x);
      panel.curves.back().y.push_back(y);
    };
    for (const CylinderMeasures& m : sweep) {
      add(force, m.froude(p), m.drag);
      if (m.froude(p) <= onset_shown) add(onset, m.froude(p), m.drag);
      if (m.froude(p) < slowest_shown) continue;
      add(coefficient, m.effective_froude(p), m.drag_coefficient());
      add(collapse, m.effective_froude(p), m.drag_coefficient() / p);
    }
  }
  io::Figure figure{
      "drag",
      "Drag of the cylinder for several confining pressures (in units of φρgD), all from one "
      "sweep of the loading, and where flow sets in; its coefficient, from Fr = 0.005 on, and "
      "what is left of the pressure in it (fig. 12).",
      {force, onset, coefficient, collapse}};
  // Nothing flows in creep, and nothing creeps in a flow.
  std::erase_if(figure.panels, [](const io::Panel& panel) {
    return std::ranges::all_of(panel.curves,
                               [](const io::Curve& curve) { return curve.x.empty(); });
  });
  return figure;
}

io::Panel perimeter_panel(const CylinderFlow& cylinder, const State& state,
                          const std::string& title) {
  io::Panel panel{title, "θ, radians, 0 downstream", "p / p_ext, σ / p_ext", false, false, {}};
  io::Curve dynamic{"p_dyn", {}, {}, io::Style::line}, total{"p_tot", {}, {}, io::Style::line},
      regularised{"p_regu", {}, {}, io::Style::dashed}, normal{"σ_n", {}, {}, io::Style::line},
      shear{"τ", {}, {}, io::Style::line},
      regularised_normal{"σ_n with p_regu", {}, {}, io::Style::dashed};
  const auto add = [](io::Curve& curve, double x, double y) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  };
  const std::vector<PerimeterPoint> points = perimeter(cylinder, state);
  for (const PerimeterPoint& p : points) {
    add(dynamic, -p.angle, p.at.values.pressure);
    add(total, -p.angle, p.at.law.total_pressure);
    add(regularised, -p.angle, p.at.law.regularised_pressure);
    add(normal, p.angle, p.normal_stress);
    add(shear, p.angle, p.shear_stress);
    add(regularised_normal, p.angle, p.regularised_normal_stress());
  }
  panel.curves = {dynamic, total, regularised, normal, shear, regularised_normal};
  return panel;
}

io::Figure perimeter_figure(const CylinderFlow& cylinder, const State& state) {
  return {"perimeter",
          "Along the perimeter (fig. 15): pressures on the left half, stresses on the right one.",
          {perimeter_panel(cylinder, state, "Pressures, and stresses")},
          1};
}

io::Figure path_figure(const std::vector<PathRecord>& path) {
  io::Panel in_lambda{"Path in λr", "λr", "U / sqrt(p_ext / φρ)", true, true, {}};
  io::Panel in_loading{"Path in the loading", "F", "U", false, true, {}};
  const auto add = [](io::Curve& curve, double x, const CylinderMeasures& m) {
    curve.x.push_back(x);
    curve.y.push_back(m.mean_velocity);
  };
  io::Curve lambda{"path", {}, {}}, loading{"path", {}, {}};
  io::Curve lambda_folds{"folds", {}, {}, io::Style::rings},
      loading_folds{"folds", {}, {}, io::Style::rings};
  const double last_lambda_r = path.back().measures.lambda_r;
  const double first_loading = path.front().measures.loading;
  for (const auto& [point, m] : path) {
    const bool moves_lambda = m.loading == first_loading;
    const bool moves_loading = m.lambda_r == last_lambda_r;
    if (moves_lambda) add(lambda, m.lambda_r, m);
    if (moves_loading) add(loading, m.loading, m);
    if (point.is_fold_passed && moves_lambda) add(lambda_folds, m.lambda_r, m);
    if (point.is_fold_passed && moves_loading) add(loading_folds, m.loading, m);
  }
  in_lambda.curves = {lambda, lambda_folds};
  in_loading.curves = {loading, loading_folds};
  return {"path", "The paths of solutions that were followed.", {in_lambda, in_loading}};
}

}  // namespace talus::twod
