// The programs `chute` and `bagnold`: one main each for the scene's own options, and this for the
// rest.
#pragma once

#include <CLI/CLI.hpp>

#include "common/program/method_options.hpp"
#include "oned/report.hpp"

namespace talus::oned {

/// The options both programs share.
struct ProgramOptions {
  MeshOptions mesh;
  program::MethodOptions method;
  std::string output;
  bool plot = false, check_jacobian = false;
};

/// Adds the shared options; set `options.method.lambda_r` to the scene's default first.
void add_options(CLI::App& app, ProgramOptions& options, const std::string& scene);

/// Limits, mesh, solve, measure, write. `parameters` are the scene's own, for summary.json.
/// Returns the exit code: 0, or 1 where the solve or the Jacobian check does not succeed.
int run(const CLI::App& app, const ShearScene& scene, const ProgramOptions& options,
        const nlohmann::json& parameters);

}  // namespace talus::oned
