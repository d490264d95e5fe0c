#include "twod/cylinder_report.hpp"

#include <algorithm>
#include <limits>

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
      row.push_back(io::exact(m.effective_froude(p)));
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

}  // namespace talus::twod
