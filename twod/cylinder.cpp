#include "twod/cylinder.hpp"

#include <Eigen/Cholesky>

#include "common/mixed/reaction.hpp"

namespace talus::twod {
namespace {

using State = CylinderFlow::State;

mixed::BoundaryConditions<2> boundary_conditions(const Cylinder& scene) {
  mixed::BoundaryConditions<2> conditions = {
      {"cylinder", mixed::no_slip<2>()},
      {"wall", mixed::no_slip<2>()},
      {"top", mixed::fully_developed<2>(1)},
      {"bottom", scene.open_outlet == mixed::Open::no
                     ? mixed::fully_developed<2>(1)
                     : mixed::open_boundary<2>(scene.open_outlet)}};
  if (!scene.mesh.full) conditions["symmetry"] = mixed::symmetry<2>(0);
  return conditions;
}

mixed::MixedLoad<2> load_of(const Cylinder& scene) {
  return {[](const fem::Point<2>&) { return 1.0; },
          [](const fem::Point<2>&) { return fem::Point<2>(0, -1); }, scene.inertia ? 1.0 : 0.0};
}

rheology::Rheology rheology_of(const Cylinder& scene) {
  rheology::Rheology rheology(scene.law, scene.regularisation, scene.lambda_r);
  rheology.pressure_floor = scene.pressure_floor;
  rheology.regularises_pressure = scene.regularises_pressure;
  return rheology;
}

// Vertical force of the constraint on the nodes of a boundary.
double reaction(const CylinderFlow& cylinder, const std::string& boundary) {
  return mixed::total_reaction(cylinder.flow(), boundary, 1);
}

double traction_integral(const CylinderFlow& cylinder, const State& state) {
  double sum = 0;
  const auto& mesh = cylinder.space().mesh();
  for (const fem::Face& face : mesh.boundaries.at("cylinder"))
    for (const auto& point : fem::face_rule(mesh, face)) {
      const mixed::FlowPoint<2> at = cylinder.flow().point_at(state, face.element, point.reference);
      const Eigen::Matrix2d gamma =
          at.values.velocity_gradient + at.values.velocity_gradient.transpose();
      const fem::Point<2> traction =
          at.law.viscosity * gamma * point.normal - at.values.pressure * point.normal;
      sum += point.weight * traction[1];
    }
  return sum;
}

double inflow(const CylinderFlow& cylinder, const State& state) {
  double flux = 0;
  const auto& mesh = cylinder.space().mesh();
  for (const fem::Face& face : mesh.boundaries.at("top"))
    for (const auto& point : fem::face_rule(mesh, face))
      flux -= point.weight *
              cylinder.space().values_at(state, face.element, point.reference).velocity[1];
  return flux;
}

}  // namespace

CylinderFlow::CylinderFlow(const Cylinder& scene)
    : scene_(scene),
      space_(cylinder_mesh(scene.mesh), boundary_conditions(scene)),
      flow_(space_, rheology_of(scene), load_of(scene), scene.penalty) {
  flow_.set_tangent_factors(mixed::tangent_factors(scene.tangent));
}

double CylinderMeasures::effective_froude(double confining_pressure) const {
  return froude(confining_pressure) / std::sqrt(1 + Cylinder{}.law.grain_size);
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
  const auto rule = fem::gauss_rule<2>(3);
  double projected = 0;
  using Projection = mixed::MixedSpace<2>::PressureValues;
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    Projection moments = Projection::Zero();  // of div u with the pressures of the element
    Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
    for (const auto& point : rule) {
      const mixed::FlowPoint<2> at = cylinder.flow().point_at(state, e, point.position);
      const double weight =
          point.weight * fem::ElementPoint<2>(mesh, e, point.position).determinant;
      const Projection psi = space.pressure_basis(e, point.position, at.values.position);
      moments += weight * at.values.divergence() * psi;
      mass += weight * psi * psi.transpose();
      area += weight;
      divergence += weight * std::pow(at.values.divergence(), 2);
      gradient += weight * at.values.velocity_gradient.squaredNorm();
      momentum += weight * at.values.velocity_gradient.row(1).dot(at.values.velocity);
      if (at.law.has_yielded) yielded += weight;
      if (at.law.has_yielded && at.law.well_posedness > 0) ill_posed += weight;
      if (at.law.total_pressure < 0) negative += weight;
      m.min_pressure = std::min(m.min_pressure, at.law.total_pressure);
      m.max_pressure = std::max(m.max_pressure, at.law.total_pressure);
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

}  // namespace talus::twod
