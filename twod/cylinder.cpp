#include "twod/cylinder.hpp"

#include <Eigen/Cholesky>

#include "common/flow/reaction.hpp"
#include "common/solve/natural_continuation.hpp"

namespace talus::twod {
namespace {

using State = CylinderFlow::State;

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
                    Continuation continuation, const solve::PathOptions& options,
                    const CylinderObserver& observe) {
  const solve::PathObserver<State> observer = [&](const State& state, solve::PathPoint& point) {
    return !observe || observe(state, measure(cylinder, state), point);
  };
  return continuation == Continuation::arclength
             ? solve::follow_arclength(problem, std::move(start), options, observer)
             : solve::follow_natural(problem, std::move(start), solve::Predictor::secant, options,
                                     observer);
}

}  // namespace

CylinderFlow::CylinderFlow(const Cylinder& scene)
    : scene_(scene),
      space_(cylinder_mesh(scene.mesh), boundary_conditions(scene)),
      flow_(space_, {scene.law, scene.regularisation, scene.lambda_r}, load_of(scene),
            scene.penalty) {}

CylinderPoint point_at(const CylinderFlow& cylinder, const State& state, std::size_t element,
                       const flow::Point<2>& reference) {
  const rheology::Rheology& rheology = cylinder.flow().rheology();
  CylinderPoint point{cylinder.space().values_at(state, element, reference)};
  point.total_pressure = 1 + point.values.pressure;
  point.regularised_pressure =
      rheology::regularise_pressure(point.total_pressure, rheology.lambda_r).value;
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

  double area = 0, divergence = 0, gradient = 0, yielded = 0, ill_posed = 0, momentum = 0;
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
      m.min_pressure = std::min(m.min_pressure, at.total_pressure);
      m.max_pressure = std::max(m.max_pressure, at.total_pressure);
    }
    projected += moments.dot(mass.llt().solve(moments));
  }
  m.weight = halves * m.loading * area;
  m.momentum_flux = cylinder.scene().inertia ? -halves * momentum : 0;
  m.yielded_share = yielded / area;
  m.ill_posed_share = ill_posed / area;
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
  constexpr double first_lambda_r = 0.1;  // smooth enough for Newton from rest
  const double lambda_r = std::max(first_lambda_r, cylinder.scene().lambda_r);
  cylinder.flow().set_load_factor(loading);
  cylinder.flow().set_lambda_r(lambda_r);
  State state = cylinder.space().start();
  solve::newton(cylinder.flow(), state,
                {.tolerance = options.tolerance,
                 .max_iterations = 100,
                 .line_search = solve::LineSearch::residual_norm});
  return follow_lambda_r(
      cylinder, loading,
      {.state = std::move(state), .parameter = std::log10(lambda_r), .direction = -1, .step = 0.2},
      continuation, options, observe);
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
