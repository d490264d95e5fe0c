#include "twod/cylinder_report.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "common/program/grid.hpp"
#include "common/program/method_options.hpp"
#include "common/program/penalty_options.hpp"
#include "common/program/summary.hpp"

namespace talus::twod {
namespace {

using State = CylinderFlow::State;

// Every measure that is kept, by the name it has in files.
template <class Measures, class Action>
void for_each_measure(Measures& m, Action&& action) {
  action("loading", m.loading);
  action("lambda_r", m.lambda_r);
  action("mean_velocity", m.mean_velocity);
  action("drag", m.drag);
  action("drag_traction", m.drag_traction);
  action("wall_force", m.wall_force);
  action("weight", m.weight);
  action("momentum_flux", m.momentum_flux);
  action("min_pressure", m.min_pressure);
  action("max_pressure", m.max_pressure);
  action("largest_velocity", m.largest_velocity);
  action("divergence", m.divergence);
  action("projected_divergence", m.projected_divergence);
  action("yielded_share", m.yielded_share);
  action("ill_posed_share", m.ill_posed_share);
  action("negative_share", m.negative_share);
}

// What is kept of a point of a path, likewise.
template <class Point, class Action>
void for_each_note(Point& point, Action&& action) {
  action("parameter", point.parameter);
  action("slope", point.parameter_slope);
  action("step", point.step);
  action("cosine", point.cosine);
  action("corrections", point.corrections);
  action("failures", point.cost.failures);
  action("factorisations", point.cost.factorisations);
  action("determinant_sign", point.determinant_sign);
  action("fold", point.is_fold_passed);
  action("residual", point.residual);
}

// The scene's scaling fixes d* = d/D.
double effective_froude(const CylinderMeasures& m, double confining_pressure) {
  const double grain_size = Cylinder{}.law.grain_size;
  return m.froude(confining_pressure) / std::sqrt(1 + grain_size);
}

// A point of the perimeter.
struct PerimeterPoint {
  double angle = 0;  // degrees from the downstream end
  mixed::FlowPoint<2> at;
  double normal_stress = 0, shear_stress = 0;  // of ηγ - p_total 1
};

std::vector<PerimeterPoint> perimeter(const CylinderFlow& cylinder, const State& state) {
  std::vector<PerimeterPoint> points;
  const auto& mesh = cylinder.space().mesh();
  for (const fem::Face& face : mesh.boundaries.at("cylinder"))
    for (const auto& each : fem::face_rule(mesh, face)) {
      PerimeterPoint point;
      point.at = cylinder.flow().point_at(state, face.element, each.reference);
      const auto& x = point.at.values.position;
      if (x[0] < 0) continue;
      point.angle = std::atan2(x[0], -x[1]) * 180 / std::numbers::pi;
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

}  // namespace

nlohmann::json as_json(const CylinderMeasures& measures) {
  nlohmann::json json;
  for_each_measure(measures, [&](const char* name, double value) { json[name] = value; });
  json["imbalance"] = measures.imbalance();
  json["drag_coefficient"] = measures.drag_coefficient();
  return json;
}

CylinderMeasures measures_from(const nlohmann::json& json) {
  CylinderMeasures measures;
  for_each_measure(measures, [&](const char* name, double& value) { value = json.at(name); });
  return measures;
}

nlohmann::json as_json(const PathRecord& record) {
  nlohmann::json json = {{"measures", as_json(record.measures)}};
  for_each_note(record.point, [&](const char* name, const auto& value) { json[name] = value; });
  return json;
}

PathRecord record_from(const nlohmann::json& json) {
  PathRecord record{{}, measures_from(json.at("measures"))};
  for_each_note(record.point, [&](const char* name, auto& value) { json.at(name).get_to(value); });
  return record;
}

std::string name_of_outflow(mixed::Open open) {
  return open == mixed::Open::no        ? "fully-developed"
         : open == mixed::Open::viscous ? "open-viscous"
                                        : "open";
}

nlohmann::json as_json(const Cylinder& scene) {
  nlohmann::json all = {{"around", scene.mesh.around},
                        {"first_layer", scene.mesh.first_layer},
                        {"domain", scene.mesh.full ? "full" : "half"},
                        {"outlet", scene.mesh.outlet},
                        {"outflow", name_of_outflow(scene.open_outlet)},
                        {"regularisation", rheology::name_of(scene.regularisation)},
                        {"lambda_r", scene.lambda_r},
                        {"pressure_floor", scene.pressure_floor},
                        {"regularises_pressure", scene.regularises_pressure},
                        {"inertia", scene.inertia},
                        {"tangent", program::name_of(scene.tangent)},
                        {"friction", program::as_json(scene.law)}};
  all.update(program::as_json(scene.penalty));
  return all;
}

io::Table sweep_table(const std::vector<CylinderMeasures>& sweep,
                      const std::vector<double>& confining_pressures) {
  io::Table table;
  for (const CylinderMeasures& m : sweep) {
    table.header.clear();
    auto& row = table.rows.emplace_back();
    for_each_measure(m, [&](const char* name, double value) {
      table.header.push_back(name);
      row.push_back(io::exact(value));
    });
    table.header.push_back("drag_coefficient_over_p_ext");
    row.push_back(io::exact(m.drag_coefficient()));
    for (const double p : confining_pressures) {
      table.header.push_back("froude_at_p_ext_" + io::rounded(p));
      row.push_back(io::exact(effective_froude(m, p)));
    }
  }
  return table;
}

io::Table path_table(const std::vector<PathRecord>& path) {
  io::Table table{"",
                  {"loading", "lambda_r", "slope", "step", "corrections", "determinant_sign",
                   "fold", "failures", "factorisations", "residual", "mean_velocity", "drag",
                   "min_pressure", "ill_posed_share", "negative_share"},
                  {}};
  for (const auto& [point, m] : path)
    table.rows.push_back({io::exact(m.loading), io::exact(m.lambda_r),
                          io::exact(point.parameter_slope), io::exact(point.step),
                          std::to_string(point.corrections), std::to_string(point.determinant_sign),
                          point.is_fold_passed ? "1" : "0", std::to_string(point.cost.failures),
                          std::to_string(point.cost.factorisations), io::exact(point.residual),
                          io::exact(m.mean_velocity), io::exact(m.drag), io::exact(m.min_pressure),
                          io::exact(m.ill_posed_share), io::exact(m.negative_share)});
  return table;
}

io::Table perimeter_table(const CylinderFlow& cylinder, const State& state) {
  io::Table table{"",
                  {"angle", "dynamic_pressure", "total_pressure", "regularised_pressure",
                   "normal_stress", "shear_stress", "regularised_normal_stress"},
                  {}};
  for (const PerimeterPoint& p : perimeter(cylinder, state))
    table.rows.push_back(
        {io::exact(p.angle), io::exact(p.at.values.pressure), io::exact(p.at.law.total_pressure),
         io::exact(p.at.law.regularised_pressure), io::exact(p.normal_stress),
         io::exact(p.shear_stress),
         io::exact(p.normal_stress + p.at.law.total_pressure - p.at.law.regularised_pressure)});
  return table;
}

io::QuadraticGrid grid(const CylinderFlow& cylinder, const State& state) {
  const auto& space = cylinder.space();
  io::QuadraticGrid grid = program::grid_of<2>(space.mesh(), {0, 2});
  io::Field velocity{"velocity", {}, 3};
  for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node) {
    const auto first = space.velocity_index(static_cast<Eigen::Index>(node), 0);
    velocity.values.insert(velocity.values.end(),
                           {state.value()[first], 0.0, state.value()[first + 1]});
  }
  grid.point_fields = {velocity};
  constexpr float unbounded = std::numeric_limits<float>::max();
  const rheology::FrictionLaw& law = cylinder.scene().law;
  io::Field dynamic{"dynamic_pressure", {}}, total{"total_pressure", {}},
      regularised{"regularised_pressure", {}}, rate{"shear_rate", {}}, eta{"viscosity", {}},
      eta_static{"viscosity_static_part", {}}, eta_dynamic{"viscosity_dynamic_part", {}},
      inertial{"inertial_number", {}}, posed{"well_posedness", {}}, yielded{"yielded", {}};
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    const mixed::FlowPoint<2> at = cylinder.flow().point_at(state, e, fem::Point<2>::Zero());
    // The yield stress over the regularised shear rate, as in eq. (12), and the rest.
    const double yield_part = law.mu_s * at.law.regularised_pressure /
                              std::hypot(at.law.shear_rate, cylinder.flow().rheology().lambda_r);
    dynamic.values.push_back(at.values.pressure);
    total.values.push_back(at.law.total_pressure);
    regularised.values.push_back(at.law.regularised_pressure);
    rate.values.push_back(at.law.shear_rate);
    eta.values.push_back(at.law.viscosity);
    eta_static.values.push_back(yield_part);
    eta_dynamic.values.push_back(at.law.viscosity - yield_part);
    // Infinite where nothing presses: a number that every viewer reads.
    inertial.values.push_back(std::min<double>(at.law.inertial_number, unbounded));
    posed.values.push_back(at.law.well_posedness);
    yielded.values.push_back(at.law.has_yielded ? 1 : 0);
  }
  grid.cell_fields = {dynamic,    total,       regularised, rate,  eta,
                      eta_static, eta_dynamic, inertial,    posed, yielded};
  return grid;
}

io::Figure drag_figure(const std::vector<CylinderMeasures>& sweep,
                       const std::vector<double>& confining_pressures) {
  io::Panel force{"Drag", "Fr = U/sqrt(gD)", "F_D/(p_{ext} D)", true, false, {}};
  io::Panel coefficient{"Drag coefficient", "Fr = U/sqrt(g(D+d))", "C_D", true, true, {}};
  force.key = "top left";
  for (const double p : confining_pressures) {
    io::Curve drag{"p_{ext} = " + io::rounded(p), {}, {}}, c_d = drag;
    for (const CylinderMeasures& m : sweep) {
      drag.x.push_back(m.froude(p));
      drag.y.push_back(m.drag);
      c_d.x.push_back(effective_froude(m, p));
      c_d.y.push_back(m.drag_coefficient());
    }
    force.curves.push_back(drag);
    coefficient.curves.push_back(c_d);
  }
  return {"drag",
          "Drag of the cylinder for several confining pressures (in units of φρgD), all from one "
          "sweep of the loading (fig. 12).",
          {force, coefficient}};
}

io::Figure perimeter_figure(const CylinderFlow& cylinder, const State& state) {
  io::Panel pressures{"Pressures", "angle from the downstream end", "p/p_{ext}", false, false, {}};
  io::Panel stresses{"Stresses", "angle from the downstream end", "σ/p_{ext}", false, false, {}};
  io::Curve dynamic{"dynamic", {}, {}, io::Style::line}, total{"total", {}, {}, io::Style::line},
      regularised{"regularised", {}, {}, io::Style::dashed},
      normal{"normal", {}, {}, io::Style::line}, shear{"tangential", {}, {}, io::Style::line},
      regularised_normal{"normal, regularised", {}, {}, io::Style::dashed};
  for (const PerimeterPoint& p : perimeter(cylinder, state)) {
    for (io::Curve* curve : {&dynamic, &total, &regularised, &normal, &shear, &regularised_normal})
      curve->x.push_back(p.angle);
    dynamic.y.push_back(p.at.values.pressure);
    total.y.push_back(p.at.law.total_pressure);
    regularised.y.push_back(p.at.law.regularised_pressure);
    normal.y.push_back(p.normal_stress);
    shear.y.push_back(p.shear_stress);
    regularised_normal.y.push_back(p.normal_stress + p.at.law.total_pressure -
                                   p.at.law.regularised_pressure);
  }
  pressures.curves = {dynamic, total, regularised};
  stresses.curves = {normal, shear, regularised_normal};
  return {
      "perimeter", "Pressures and stresses along the perimeter (fig. 15).", {pressures, stresses}};
}

io::Figure path_figure(const std::vector<PathRecord>& path) {
  io::Panel in_lambda{"Path in λ_r", "λ_r", "U", true, true, {}};
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
