// What every solve of unidirectional flow leaves behind: parts of summary.json, and its iterations.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/table.hpp"
#include "common/shear/shear_solver.hpp"

namespace talus::program {

nlohmann::json as_json(const rheology::FrictionLaw& law);
/// Method and its parameters.
nlohmann::json as_json(const shear::ShearOptions& options);
/// Adds status, newton or interior_point, iterations, factorisations, and seconds.
void add_outcome(nlohmann::json& summary, const shear::ShearSolution& solution);

/// One row an iteration of Newton or of the interior point.
io::Table iteration_table(const shear::ShearSolution& solution);
/// newton.csv or interior_point.csv.
std::string iteration_file(const shear::ShearSolution& solution);

/// Largest memory the process has held so far, in MB.
double peak_memory();

/// Prints the checks of a scene and whether all passed; the exit code of --check-jacobian.
int report(const std::string& scene, const std::vector<solve::NamedCheck>& checks);

/// The end of the solve in one line.
std::string outcome_line(const shear::ShearSolution& solution);

}  // namespace talus::program
