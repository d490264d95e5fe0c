// The command-line options of every program that solves unidirectional flow.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "common/flow/shear_solver.hpp"

namespace talus::program {

/// As typed; `shear_options` and `friction_law` make sense of it.
struct MethodOptions {
  std::string method = "newton", regularisation = "chauchat-medale", precision = "compensated";
  std::string line_search = "energy-slope", tangent = "full", friction;
  double lambda_r = 1e-6;
  double tolerance = 0;    ///< 0: the method's own default
  int max_iterations = 0;  ///< 0: the method's own default
  bool no_continuation = false;
};

/// Adds them; set the scene's own defaults first.
void add_method_options(CLI::App& app, MethodOptions& options);

/// `defaults` for what the command line does not say.
flow::ShearOptions shear_options(const MethodOptions& options, flow::ShearOptions defaults = {});

/// The friction law of --friction. Throws io::UserError.
rheology::FrictionLaw friction_law(const MethodOptions& options);

}  // namespace talus::program
