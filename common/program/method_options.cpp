#include "common/program/method_options.hpp"

#include <algorithm>
#include <array>
#include <thread>
#include <utility>
#include <vector>

#include "common/io/options.hpp"

namespace talus::program {

void add_regularisation(io::CommandLine& line, std::string& name) {
  std::vector<std::string> names;
  for (const auto& each : rheology::regularisations()) names.push_back(rheology::name_of(each));
  io::add_choice(line, "--regularisation", name,
                 "Viscosity, eq. (9)-(12), or a control law without yield stress", names);
}

void add_friction(io::CommandLine& line, std::string& friction) {
  io::add_text(line, "--friction", friction,
               "Friction law mu_s,delta_mu,I0 [each 0.001 ... 10; default 0.383,0.26,0.279]");
}

namespace {

constexpr std::array<std::pair<const char*, shear::TangentTerm>, 4> tangents{
    {{"primal-dual", shear::TangentTerm::primal_dual},
     {"full", shear::TangentTerm::full},
     {"frozen", shear::TangentTerm::frozen},
     {"wrong-sign", shear::TangentTerm::wrong_sign}}};

}  // namespace

void add_tangent(io::CommandLine& line, std::string& tangent) {
  std::vector<std::string> names;
  for (const auto& [name, term] : tangents) names.push_back(name);
  io::add_choice(
      line, "--tangent", tangent,
      "Derivative of the viscosity in the tangent: in primal-dual form, plain, dropped, or "
      "broken",
      names);
}

shear::TangentTerm tangent_named(const std::string& tangent) {
  return std::ranges::find(tangents, tangent, &decltype(tangents)::value_type::first)->second;
}

std::string name_of(shear::TangentTerm tangent) {
  return std::ranges::find(tangents, tangent, &decltype(tangents)::value_type::second)->first;
}

void add_newton(io::CommandLine& line, std::string& method) {
  io::add_choice(line, "--method", method, "Newton: there is no interior point with a pressure",
                 {"newton"});
}

void add_threads(io::CommandLine& line, int& threads) {
  constexpr int most = 256;
  threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most);
  io::add_integer(line, "--threads", threads,
                  "Threads that assemble; results do not depend on them, to the last bit", 1, most);
}

void add_method_options(io::CommandLine& line, MethodOptions& options) {
  io::add_choice(line, "--method", options.method,
                 "Newton on the regularised law, or interior point without regularisation",
                 {"newton", "interior-point"});
  add_regularisation(line, options.regularisation);
  io::add_real(line, "--lambda-r", options.lambda_r, "Regularisation parameter, in sqrt(g/d)",
               1e-15, 1);
  add_friction(line, options.friction);
  io::add_choice(line, "--precision", options.precision,
                 "Of Newton's iterate: double, or double with its rounding kept",
                 {"compensated", "plain"});
  io::add_choice(line, "--line-search", options.line_search,
                 "Of Newton: on the slope of the energy (default), on the residual (default of the "
                 "heap in space), or full steps",
                 {"energy-slope", "residual-norm", "none"});
  add_tangent(line, options.tangent);
  io::add_real(
      line, "--tolerance", options.tolerance,
      "Of Newton's answer: relative residual and distance to the solution (default 1e-12); "
      "or relative duality gap, the square of a distance (default 1e-10)",
      1e-16, 1e-3)
      .without_default();
  io::add_integer(line, "--max-iterations", options.max_iterations,
                  "Of Newton (default 200) or of the interior point (default 100)", 1, 100000)
      .without_default();
  io::add_flag(line, "--no-continuation", options.no_continuation,
               "Newton at lambda_r directly and only: no way down from a larger one");
}

solve::LineSearch line_search_named(const std::string& line_search) {
  return line_search == "none"            ? solve::LineSearch::none
         : line_search == "residual-norm" ? solve::LineSearch::residual_norm
                                          : solve::LineSearch::energy_slope;
}

shear::ShearOptions shear_options(const MethodOptions& options, shear::ShearOptions defaults) {
  shear::ShearOptions result = std::move(defaults);
  result.method =
      options.method == "newton" ? shear::Method::newton : shear::Method::interior_point;
  result.regularisation = *rheology::regularisation_named(options.regularisation);
  result.lambda_r = options.lambda_r;
  if (options.no_continuation) result.continuation = shear::Continuation::never;
  result.precision =
      options.precision == "plain" ? solve::Precision::plain : solve::Precision::compensated;
  result.newton.line_search = line_search_named(options.line_search);
  result.tangent_term = tangent_named(options.tangent);
  if (options.tolerance > 0)
    result.newton.tolerance = result.newton.distance = result.interior_point.tolerance =
        options.tolerance;
  if (options.max_iterations > 0)
    result.newton.max_iterations = result.interior_point.max_factorisations =
        options.max_iterations;
  return result;
}

std::vector<io::Use> used_options(const MethodOptions& options, bool checks_jacobian) {
  return {{{"--regularisation", "--lambda-r", "--precision", "--line-search", "--tangent",
            "--no-continuation"},
           options.method == "newton",
           "--method interior-point; add --method newton"},
          {{"--precision", "--line-search", "--no-continuation", "--tolerance", "--max-iterations",
            "--output", "--plot"},
           !checks_jacobian,
           "--check-jacobian"}};
}

rheology::Regularisation limiting_law(const MethodOptions& options) {
  const shear::ShearOptions resolved = shear_options(options);
  return resolved.method == shear::Method::newton ? resolved.regularisation
                                                  : rheology::ChauchatMedale{};
}

rheology::FrictionLaw friction_law(const MethodOptions& options) {
  return friction_law(options.friction);
}

rheology::FrictionLaw friction_law(const std::string& text, rheology::FrictionLaw law) {
  if (text.empty()) return law;
  std::vector<double> numbers;
  for (const std::string& part : io::split(text, ','))
    numbers.push_back(io::real_in_range("--friction", part, 1e-3, 10));
  if (numbers.size() != 3)
    throw io::UserError("--friction: '" + text +
                        "' is not three numbers mu_s,delta_mu,I0, each 0.001 ... 10");
  law.mu_s = numbers[0];
  law.delta_mu = numbers[1];
  law.I0 = numbers[2];
  return law;
}

}  // namespace talus::program
