#include "twod/cylinder.hpp"

#include <Eigen/Cholesky>

#include "common/flow/reaction.hpp"
#include "common/solve/natural_continuation.hpp"

namespace talus::twod {
namespace {

using State = CylinderFlow::State;

// Smooth enough for Newton from rest; for its primal-dual form, nearly always.
constexpr double smooth_lambda_r = 0.1, primal_dual_lambda_r = 0.01;

flow::BoundaryConditions<2> boundary_conditions(const Cylinder& scene) {
  flow::BoundaryConditions<2> conditions = {
      {"cylinder", flow::no_slip<2>()},
      {"wall", flow::no_slip<2>()},
      {"top", flow::fully_developed<2>(1)},
      {"bottom", scene.open_outlet == flow::Open::no ? flow::fully_developed<2>(1)
                                                     : flow::open_boundary<2>(scene.open_outlet)}};
  if (!scene.mesh.full) conditions["symmetry"] = flow::symmetry<2>(0);
  return conditions;
}

flow::DenseLoad<2> load_of(const Cylinder& scene) {
  return {[](const flow::Point<2>&) { return 1.0; },
          [](const flow::Point<2>&) { return flow::Point<2>(0, -1); }, scene.inertia ? 1.0 : 0.0};
}

rheology::Rheology rheology_of(const Cylinder& scene) {
  rheology::Rheology rheology(scene.law, scene.regularisation, scene.lambda_r);
  rheology.pressure_floor = scene.pressure_floor;
  rheology.regularises_pressure = scene.regularises_pressure;
  return rheology;
}

// Vertical force of the constraint on the nodes of a boundary.
double reaction(const CylinderFlow& cylinder, const std::string& boundary) {
  return flow::total_reaction(cylinder.flow(), boundary, 1);
}

double traction_integral(const CylinderFlow& cylinder, const State& state) {
  double sum = 0;
  const auto& mesh = cylinder.space().mesh();
  for (const flow::Face& face : mesh.boundaries.at("cylinder"))
    for (const auto& point : flow::face_rule(mesh, face)) {
      const CylinderPoint at = point_at(cylinder, state, face.element, point.reference);
      const Eigen::Matrix2d gamma =
          at.values.velocity_gradient + at.values.velocity_gradient.transpose();
      const flow::Point<2> traction =
          at.viscosity * gamma * point.normal - at.values.pressure * point.normal;
      sum += point.weight * traction[1];
    }
  return sum;
}

double inflow(const CylinderFlow& cylinder, const State& state) {
  double flux = 0;
  const auto& mesh = cylinder.space().mesh();
  for (const flow::Face& face : mesh.boundaries.at("top"))
    for (const auto& point : flow::face_rule(mesh, face))
      flux -= point.weight *
              cylinder.space().values_at(state, face.element, point.reference).velocity[1];
  return flux;
}

template <class Problem>
CylinderPath follow(CylinderFlow& cylinder, Problem problem, solve::PathStart<State> start,
                    Continuation continuation, solve::PathOptions options,
                    const CylinderObserver& observe) {
  if (start.parameter == options.target) {  // of this path the start is all
    options.target.reset();
    options.max_points = 1;
    auto path = follow(cylinder, problem, std::move(start), continuation, options, observe);
    if (path.end == solve::PathEnd::out_of_points) path.end = solve::PathEnd::target_reached;
    return path;
  }
  const solve::PathObserver<State> observer = [&](const State& state, solve::PathPoint& point) {
    return !observe || observe(state, measure(cylinder, state), point);
  };
  if (continuation == Continuation::arclength)
    return solve::follow_arclength(problem, std::move(start), options, observer);
  if (continuation == Continuation::natural)
    return solve::follow_natural(problem, std::move(start), solve::Predictor::secant, options,
                                 observer);
  // Steps so long that a tangent says nothing about their end, with time to converge.
  solve::PathOptions far = options;
  far.largest_step = 2;
  far.few_corrections = 6;
  far.many_corrections = 12;
  far.max_corrections = 18;
  cylinder.flow().carry_stress();
  auto path =
      solve::follow_natural(problem, std::move(start), solve::Predictor::constant, far, observer);
  cylinder.flow().stop_carrying_stress();
  return path;
}

solve::NewtonSummary newton_at(CylinderFlow& cylinder, double loading, double lambda_r,
                               State& state, double tolerance) {
  cylinder.flow().set_load_factor(loading);
  cylinder.flow().set_lambda_r(lambda_r);
  return solve::newton(cylinder.flow(), state,
                       {.tolerance = tolerance,
                        .max_iterations = 100,
                        .line_search = solve::LineSearch::residual_norm});
}

// Newton from rest at `lambda_r`, or at the scene's if that is larger. On the way pressures are
// negative: eq. (16) is needed there even if the scene does without.
solve::NewtonSummary smooth_start(CylinderFlow& cylinder, double loading, double lambda_r,
                                  State& state, double tolerance) {
  const rheology::Rheology own = rheology_of(cylinder.scene());
  rheology::Rheology regularised = own;
  regularised.regularises_pressure = true;
  cylinder.flow().set_rheology(regularised);
  state = cylinder.space().start();
  lambda_r = std::max(lambda_r, own.lambda_r);
  auto newton = newton_at(cylinder, loading, lambda_r, state, tolerance);
  cylinder.flow().set_rheology(own);
  if (!own.regularises_pressure && solve::is_success(newton.end))
    newton = newton_at(cylinder, loading, lambda_r, state, tolerance);
  return newton;
}

}  // namespace

std::string name_of(Continuation continuation) {
  switch (continuation) {
    case Continuation::arclength:
      return "arclength";
    case Continuation::natural:
      return "natural";
    case Continuation::primal_dual:
      return "primal-dual";
  }
  return {};
}

CylinderFlow::CylinderFlow(const Cylinder& scene)
    : scene_(scene),
      space_(cylinder_mesh(scene.mesh), boundary_conditions(scene)),
      flow_(space_, rheology_of(scene), load_of(scene), scene.penalty) {}

CylinderPoint point_at(const CylinderFlow& cylinder, const State& state, std::size_t element,
                       const flow::Point<2>& reference) {
  const rheology::Rheology& rheology = cylinder.flow().rheology();
  CylinderPoint point{cylinder.space().values_at(state, element, reference)};
  point.total_pressure = 1 + point.values.pressure;
  point.regularised_pressure = rheology.regularised_pressure(point.total_pressure).value;
  point.shear_rate = point.values.shear_rate();
  point.viscosity = rheology.evaluate(point.shear_rate, point.total_pressure).eta;
  point.inertial_number =
      rheology.law.inertial_number(point.shear_rate, point.regularised_pressure);
  point.well_posedness = rheology.well_posedness(point.inertial_number);
  point.has_yielded =
      point.viscosity * point.shear_rate > rheology.law.mu_s * point.regularised_pressure;
  return point;
}

CylinderMeasures measure(CylinderFlow& cylinder, const State& state) {
  const auto& space = cylinder.space();
  const auto& mesh = space.mesh();
  const double halves = cylinder.scene().mesh.full ? 1 : 2;
  cylinder.flow().evaluate(state);
  CylinderMeasures m;
  m.loading = cylinder.flow().load_factor();
  m.lambda_r = cylinder.flow().rheology().lambda_r;
  m.mean_velocity = halves * inflow(cylinder, state) / (2 * cylinder.scene().mesh.half_width);
  m.drag = halves * reaction(cylinder, "cylinder");
  m.drag_traction = halves * traction_integral(cylinder, state);
  m.wall_force = halves * reaction(cylinder, "wall");
  m.largest_velocity = state.value().head(space.velocity_count()).lpNorm<Eigen::Infinity>();

  double area = 0, divergence = 0, gradient = 0, momentum = 0;
  double yielded = 0, ill_posed = 0, negative = 0;
  m.min_pressure = std::numeric_limits<double>::infinity();
  m.max_pressure = -m.min_pressure;
  const auto rule = flow::gauss_rule<2>(3);
  double projected = 0;
  using Projection = flow::DenseSpace<2>::PressureValues;
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    Projection moments = Projection::Zero();  // of div u with the pressures of the element
    Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
    for (const auto& point : rule) {
      const CylinderPoint at = point_at(cylinder, state, e, point.position);
      const double weight =
          point.weight * flow::ElementPoint<2>(mesh, e, point.position).determinant;
      const Projection psi = space.pressure_basis(e, point.position, at.values.position);
      moments += weight * at.values.divergence() * psi;
      mass += weight * psi * psi.transpose();
      area += weight;
      divergence += weight * std::pow(at.values.divergence(), 2);
      gradient += weight * at.values.velocity_gradient.squaredNorm();
      momentum += weight * at.values.velocity_gradient.row(1).dot(at.values.velocity);
      if (at.has_yielded) yielded += weight;
      if (at.has_yielded && at.well_posedness > 0) ill_posed += weight;
      if (at.total_pressure < 0) negative += weight;
      m.min_pressure = std::min(m.min_pressure, at.total_pressure);
      m.max_pressure = std::max(m.max_pressure, at.total_pressure);
    }
    projected += moments.dot(mass.llt().solve(moments));
  }
  m.weight = halves * m.loading * area;
  m.momentum_flux = cylinder.scene().inertia ? -halves * momentum : 0;
  m.yielded_share = yielded / area;
  m.ill_posed_share = ill_posed / area;
  m.negative_share = negative / area;
  const double gradient_norm = std::sqrt(gradient);
  m.divergence = std::sqrt(divergence) / gradient_norm;
  m.projected_divergence = std::sqrt(projected) / gradient_norm;
  return m;
}

solve::PathOptions cylinder_path_options() {
  solve::PathOptions options;
  options.tolerance = 1e-9;
  options.few_corrections = 4;
  options.growth = 2;
  options.largest_step = 1;
  options.max_points = 400;
  return options;
}

CylinderPath solve_from_rest(CylinderFlow& cylinder, double loading, Continuation continuation,
                             const solve::PathOptions& options, const CylinderObserver& observe) {
  const bool is_primal_dual = continuation == Continuation::primal_dual;
  if (is_primal_dual) cylinder.flow().carry_stress();
  double lambda_r = is_primal_dual ? primal_dual_lambda_r : smooth_lambda_r;
  State state;
  const auto newton = smooth_start(cylinder, loading, lambda_r, state, options.tolerance);
  if (is_primal_dual && !solve::is_success(newton.end)) {
    lambda_r = smooth_lambda_r;
    smooth_start(cylinder, loading, lambda_r, state, options.tolerance);
  }
  lambda_r = std::max(lambda_r, cylinder.scene().lambda_r);
  return follow_lambda_r(cylinder, loading,
                         {.state = std::move(state),
                          .parameter = std::log10(lambda_r),
                          .direction = -1,
                          .step = is_primal_dual ? 1 : 0.2},
                         continuation, options, observe);
}

solve::NewtonSummary solve_creep(CylinderFlow& cylinder, double loading, State& state,
                                 double tolerance) {
  const double lambda_r = cylinder.scene().lambda_r;
  const auto smooth = smooth_start(cylinder, loading, smooth_lambda_r, state, tolerance);
  if (!solve::is_success(smooth.end)) return smooth;
  for (Eigen::Index i = 0; i < cylinder.space().velocity_count(); ++i)
    state.set(i, std::min(1.0, lambda_r / smooth_lambda_r) * state.value()[i]);
  return newton_at(cylinder, loading, lambda_r, state, tolerance);
}

CylinderPath follow_lambda_r(CylinderFlow& cylinder, double loading, solve::PathStart<State> start,
                             Continuation continuation, solve::PathOptions options,
                             const CylinderObserver& observe) {
  cylinder.flow().set_load_factor(loading);
  options.target = std::log10(cylinder.scene().lambda_r);
  options.upper = 1;  // λr = 10: a path that climbs there has turned back for good
  return follow(cylinder, flow::RegularisationPath<2>(cylinder.flow()), std::move(start),
                continuation, options, observe);
}

CylinderPath follow_loading(CylinderFlow& cylinder, solve::PathStart<State> start, double target,
                            Continuation continuation, solve::PathOptions options,
                            const CylinderObserver& observe) {
  cylinder.flow().set_lambda_r(cylinder.scene().lambda_r);
  options.target = target;
  options.lower = 0;
  // The walls alone carry μ2/half_width; the cylinder adds a little.
  options.upper = 1.2 * cylinder.scene().law.mu_2() / cylinder.scene().mesh.half_width;
  options.parameter_scale = 1e-3;  // loadings between which the flow changes its face
  return follow(cylinder, flow::LoadPath<2>(cylinder.flow()), std::move(start), continuation,
                options, observe);
}

}  // namespace talus::twod
