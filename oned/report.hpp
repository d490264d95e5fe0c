// What a run of a one-dimensional scene leaves behind: summary, tables and the profile figure.
#pragma once

#include <nlohmann/json.hpp>

#include "common/io/figure.hpp"
#include "common/io/table.hpp"
#include "oned/errors.hpp"
#include "oned/solver.hpp"

namespace talus::oned {

/// Everything a run is determined by, as resolved from the command line.
struct RunParameters {
  std::string model;  ///< line, or the richer one whose line across is measured
  MeshOptions mesh;
  SolveOptions solve;
  nlohmann::json scene;  ///< the scene's own parameters by name
};

/// summary.json: scene, model, parameters, status, newton or interior_point, seconds,
/// results (none if the solve failed).
nlohmann::json summary(const ShearScene& scene, const RunParameters& parameters,
                       const Solution& solution);
/// The same for a load that has no steady flow: nothing was solved.
nlohmann::json refusal(const ShearScene& scene, const RunParameters& parameters);

/// Velocity, shear rate, I and stress with their exact values at the quadrature points.
io::Table profile_table(const ShearScene& scene, const Solution& solution);
/// Velocity, shear rate, I and stress against the exact profiles (the paper's Figs 2, 4 and 6), and
/// the errors of the first two. `solutions` are drawn over each other with their labels.
io::Figure profile_figure(const ShearScene& scene,
                          const std::vector<std::pair<std::string, const Solution*>>& solutions);

}  // namespace talus::oned
