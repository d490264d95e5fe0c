// What every solve of unidirectional flow leaves behind: parts of summary.json, and its iterations.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/flow/shear_solver.hpp"
#include "common/io/table.hpp"

namespace talus::program {

nlohmann::json as_json(const rheology::FrictionLaw& law);
/// Method and its parameters.
nlohmann::json as_json(const flow::ShearOptions& options);
/// Adds status, newton or interior_point, iterations, factorisations, and seconds.
void add_outcome(nlohmann::json& summary, const flow::ShearSolution& solution);

/// One row an iteration of Newton or of the interior point.
io::Table iteration_table(const flow::ShearSolution& solution);
/// newton.csv or interior_point.csv.
std::string iteration_file(const flow::ShearSolution& solution);

/// Largest memory the process has held so far, in MB.
double peak_memory();

/// Prints the checks of a scene and whether all passed; the exit code of --check-jacobian.
int report(const std::string& scene, const std::vector<flow::NamedCheck>& checks);

/// The end of the solve in one line.
std::string outcome_line(const flow::ShearSolution& solution);

}  // namespace talus::program
