#include "oned/report.hpp"

#include <cmath>

#include "common/program/summary.hpp"

namespace talus::oned {
namespace {

using nlohmann::json;

json parameters_as_json(const ShearScene& scene, const RunParameters& parameters) {
  json all = parameters.scene;
  all["elements"] = parameters.mesh.elements;
  all["grading"] = parameters.mesh.grading;
  all["align"] = parameters.mesh.align ? json(*parameters.mesh.align) : json(nullptr);
  all["friction"] = program::as_json(scene.law());
  all.update(program::as_json(parameters.solve));
  return all;
}

json header(const ShearScene& scene, const RunParameters& parameters) {
  return {{"scene", scene.name},
          {"model", parameters.model},
          {"parameters", parameters_as_json(scene, parameters)},
          {"elements", parameters.mesh.elements},
          {"element_size", scene.length / parameters.mesh.elements},
          {"regime", rheology::name_of(scene.regime())},
          {"limits", scene.limits}};
}

}  // namespace

json summary(const ShearScene& scene, const RunParameters& parameters, const Solution& solution) {
  json all = header(scene, parameters);
  program::add_outcome(all, solution);
  all["results"] = json::object();
  if (!solve::is_success(solution.end)) return all;
  const Errors error = errors(solution, scene);
  const double exact_max = std::max(scene.exact_velocity(0), scene.exact_velocity(scene.length));
  all["results"] = {{"max_velocity", solution.velocity.value().lpNorm<Eigen::Infinity>()},
                    {"exact_max_velocity", exact_max},
                    {"error_l2", error.l2},
                    {"error_max", error.max},
                    {"error_nodal_max", error.nodal_max},
                    {"error_paper_rms", error.paper_rms},
                    {"error_shear_rate_l2", error.shear_rate.l2},
                    {"error_shear_rate_max", error.shear_rate.max},
                    {"error_stress_l2", error.stress.l2},
                    {"error_stress_max", error.stress.max}};
  return all;
}

json refusal(const ShearScene& scene, const RunParameters& parameters) {
  json all = header(scene, parameters);
  all["status"] = solve::name_of(solve::End::no_steady_state);
  all["results"] = json::object();
  return all;
}

io::Table profile_table(const ShearScene& scene, const Solution& solution) {
  io::Table table{"",
                  {scene.coordinate, scene.velocity, scene.velocity + "_exact", "shear_rate",
                   "shear_rate_exact", "I", "I_exact", "stress", "stress_exact"},
                  {}};
  const auto& points = solution.space.points();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points[k].position[0], p = scene.pressure(x);
    const auto& nodes = solution.space.mesh().elements[k / solution.space.points_per_element()];
    double velocity = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      velocity +=
          points[k].values[static_cast<Eigen::Index>(a)] * solution.velocity.value()[nodes[a]];
    const double exact_rate = scene.exact_shear_rate(x);
    table.rows.push_back({});
    for (const double value :
         {x, velocity, scene.exact_velocity(x), solution.shear_rate[k], exact_rate,
          scene.law().inertial_number(solution.shear_rate[k], p),
          scene.law().inertial_number(exact_rate, p), solution.stress[k], scene.exact_stress(x)})
      table.rows.back().push_back(io::exact(value));
  }
  return table;
}

io::Figure profile_figure(const ShearScene& scene,
                          const std::vector<std::pair<std::string, const Solution*>>& solutions) {
  struct Quantity {
    std::string title, label;
    std::size_t column;  // of the computed values in the profile table; the exact ones follow
    bool is_error;
  };
  const std::string rate = "|d" + scene.velocity + "/d" + scene.coordinate + "|";
  const std::vector<Quantity> quantities = {
      {"velocity", scene.velocity + " / sqrt(gd)", 1, false},
      {"shear rate", rate + " / sqrt(g/d)", 3, false},
      {"inertial number", "I", 5, false},
      {"shear stress", "τ / φρgd", 7, false},
      {"error of the velocity", "|error| / sqrt(gd)", 1, true},
      {"error of the shear rate", "|error| / sqrt(g/d)", 3, true}};
  io::Figure figure{"profile", scene.title + " against the exact profiles", {}, 3};
  for (const Quantity& quantity : quantities) {
    io::Panel panel{quantity.title, scene.coordinate + " / d", quantity.label,
                    false,          quantity.is_error,         {}};
    io::Curve exact{"exact", {}, {}, io::Style::line};
    for (const auto& [label, solution] : solutions) {
      io::Curve computed{label, {}, {}, io::Style::points};
      exact.x.clear();
      exact.y.clear();
      for (const auto& row : profile_table(scene, *solution).rows) {
        const double value = io::number_in(row[quantity.column]);
        const double exact_value = io::number_in(row[quantity.column + 1]);
        const double error = std::abs(value - exact_value);
        if (quantity.is_error && error == 0) continue;  // no place on a logarithmic axis
        computed.x.push_back(io::number_in(row[0]));
        computed.y.push_back(quantity.is_error ? error : value);
        exact.x.push_back(computed.x.back());
        exact.y.push_back(exact_value);
      }
      panel.curves.push_back(computed);
    }
    if (!quantity.is_error) panel.curves.push_back(exact);
    figure.panels.push_back(panel);
  }
  return figure;
}

}  // namespace talus::oned
