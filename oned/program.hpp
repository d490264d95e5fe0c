// The programs `chute` and `bagnold`: one main each for the scene's own options, and this for the
// rest.
#pragma once

#include <CLI/CLI.hpp>

#include "oned/report.hpp"

namespace talus::oned {

/// The options both programs share.
struct ProgramOptions {
  MeshOptions mesh;
  double lambda_r = 1e-6;
  double tolerance = 0;  ///< 0: the method's own default
  int max_iterations = 0;
  std::string method = "newton", regularisation = "chauchat-medale", precision = "compensated";
  std::string line_search = "energy-slope", tangent = "full", friction, align, output;
  bool plot = false, check_jacobian = false, no_continuation = false;
};

/// Adds the shared options; set `options.lambda_r` to the scene's default first.
void add_options(CLI::App& app, ProgramOptions& options, const std::string& scene);

/// The friction law of --friction. Throws io::UserError.
rheology::FrictionLaw friction_law(const ProgramOptions& options);

/// Limits, mesh, solve, measure, write. `parameters` are the scene's own, for summary.json.
/// Returns the exit code: 0, or 1 where the solve or the Jacobian check does not succeed.
int run(const ShearScene& scene, const ProgramOptions& options, const nlohmann::json& parameters);

}  // namespace talus::oned
