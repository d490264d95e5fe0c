// The command-line options of every program that solves unidirectional flow.
#pragma once

#include <string>
#include <vector>

#include "common/io/command_line.hpp"
#include "common/shear/shear_solver.hpp"

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
void add_method_options(io::CommandLine& line, MethodOptions& options);

/// Adds --regularisation: every name of the registry.
void add_regularisation(io::CommandLine& line, std::string& name);

/// Adds --friction, for `friction_law`.
void add_friction(io::CommandLine& line, std::string& friction);

/// Adds --method where there is but one: velocity and pressure have no interior point.
void add_newton(io::CommandLine& line, std::string& method);
/// Adds --tangent; what its value means.
void add_tangent(io::CommandLine& line, std::string& tangent);
shear::TangentTerm tangent_named(const std::string& tangent);
std::string name_of(shear::TangentTerm tangent);

/// What a value of --line-search means.
solve::LineSearch line_search_named(const std::string& line_search);

/// Adds --threads, with all of the machine as its default; for solve::set_threads.
void add_threads(io::CommandLine& line, int& threads);

/// `defaults` for what the command line does not say.
shear::ShearOptions shear_options(const MethodOptions& options, shear::ShearOptions defaults = {});

/// Which of these options a run uses, for io::refuse_unused. The interior point solves eq. (4)
/// itself, whatever the regularisation; --check-jacobian solves and writes nothing.
std::vector<io::Use> used_options(const MethodOptions& options, bool checks_jacobian);

/// The regularisation whose limiting law the results are to be compared with: eq. (4) for the
/// interior point.
rheology::Regularisation limiting_law(const MethodOptions& options);

/// The friction law mu_s,delta_mu,I0 of --friction, the default if it is empty. Throws
/// io::UserError.
rheology::FrictionLaw friction_law(const std::string& text, rheology::FrictionLaw law = {});
/// The friction law of --friction. Throws io::UserError.
rheology::FrictionLaw friction_law(const MethodOptions& options);

}  // namespace talus::program
