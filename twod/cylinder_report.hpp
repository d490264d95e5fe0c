// What a run of the cylinder leaves behind: tables, fields for ParaView, figures.
#pragma once

#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/figure.hpp"
#include "common/io/table.hpp"
#include "common/io/vtu.hpp"
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
/// Pressures and stresses on the right half of the perimeter, θ = 0 downstream (fig. 15).
io::Table perimeter_table(const CylinderFlow& cylinder, const CylinderFlow::State& state);

/// Velocity at the nodes; pressures, viscosity and its two parts, inertial number, well-posedness
/// and yielded region in the elements (figs. 13, 14, 16).
io::QuadraticGrid grid(const CylinderFlow& cylinder, const CylinderFlow::State& state);

/// F_D/p_ext against Fr, and C_D against Fr based on D + d (fig. 12).
io::Figure drag_figure(const std::vector<CylinderMeasures>& sweep,
                       const std::vector<double>& confining_pressures);
/// Fig. 15.
io::Figure perimeter_figure(const CylinderFlow& cylinder, const CylinderFlow::State& state);
/// U along the paths, against λr and against the loading; folds marked.
io::Figure path_figure(const std::vector<PathRecord>& path);

}  // namespace talus::twod
