// What a run of the cylinder leaves behind: tables, fields for ParaView, figures.
#pragma once

#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/figure.hpp"
#include "common/io/table.hpp"
#include "common/io/vtu.hpp"
#include "common/program/flow_picture.hpp"
#include "common/scene/description.hpp"
#include "twod/cylinder.hpp"

namespace talus::twod {

/// Of the program `cylinder`.
const scene::Description& description();

/// A point of a path and what was measured there.
struct PathRecord {
  solve::PathPoint point;
  CylinderMeasures measures;
};

nlohmann::json as_json(const CylinderMeasures& measures);
CylinderMeasures measures_from(const nlohmann::json& json);
nlohmann::json as_json(const PathRecord& record);
PathRecord record_from(const nlohmann::json& json);
/// The name of an outlet condition on the command line.
std::string name_of_outflow(mixed::Open open);
/// The parameters of a scene.
nlohmann::json as_json(const Cylinder& scene);

/// One row a loading: U, drag, pressures; Froude number (based on D + d) and drag coefficient for
/// every confining pressure, in φρgD.
io::Table sweep_table(const std::vector<CylinderMeasures>& sweep,
                      const std::vector<double>& confining_pressures);
/// One row an accepted point of the paths.
io::Table path_table(const std::vector<PathRecord>& path);
/// A point of the right half of the perimeter.
struct PerimeterPoint {
  double angle = 0;  ///< θ, in radians from the downstream end
  mixed::FlowPoint<2> at;
  double normal_stress = 0, shear_stress = 0;  ///< of ηγ - p_total 1

  double regularised_normal_stress() const {
    return normal_stress + at.law.total_pressure - at.law.regularised_pressure;
  }
};
/// From downstream up.
std::vector<PerimeterPoint> perimeter(const CylinderFlow& cylinder,
                                      const CylinderFlow::State& state);
/// What is there, θ in degrees (fig. 15).
io::Table perimeter_table(const CylinderFlow& cylinder, const CylinderFlow::State& state);

/// Velocity at the nodes; pressures, viscosity and its two parts, inertial number, well-posedness
/// and yielded region in the elements (figs. 13, 14, 16).
io::QuadraticGrid grid(const CylinderFlow& cylinder, const CylinderFlow::State& state);

/// F_D/p_ext against Fr, also where flow sets in; from Fr = 0.005 on C_D against Fr based on D + d,
/// also over p_ext (fig. 12).
io::Figure drag_figure(const std::vector<CylinderMeasures>& sweep,
                       const std::vector<double>& confining_pressures);
/// Fig. 15: pressures over [-π, 0], stresses over [0, π].
io::Panel perimeter_panel(const CylinderFlow& cylinder, const CylinderFlow::State& state,
                          const std::string& title);
io::Figure perimeter_figure(const CylinderFlow& cylinder, const CylinderFlow::State& state);
/// The fields around the cylinder and close to it (figs. 13, 14, 16), of half a box with its mirror
/// image; one figure if `options` have a window.
std::vector<io::Figure> pictures(const CylinderFlow& cylinder, const CylinderFlow::State& state,
                                 const program::PictureOptions& options);
/// U along the paths, against λr and against the loading; folds marked.
io::Figure path_figure(const std::vector<PathRecord>& path);

}  // namespace talus::twod
