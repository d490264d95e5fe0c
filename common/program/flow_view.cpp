#include "common/program/flow_view.hpp"

#include <algorithm>

namespace talus::program {
namespace {

// The bilinear function nearest to the values at the points of the 3 x 3 Gauss rule of an element:
// one of degree two would swing where the stress has a kink.
double interpolated(std::span<const double> at_points, const fem::Point<2>& reference) {
  static const auto rule = fem::gauss_rule<2>(3);
  double value = 0;
  for (const auto& basis :
       {+[](const fem::Point<2>&) { return 1.; }, +[](const fem::Point<2>& x) { return x[0]; },
        +[](const fem::Point<2>& x) { return x[1]; },
        +[](const fem::Point<2>& x) { return x[0] * x[1]; }}) {
    double sum = 0, norm = 0;  // the four are orthogonal over the points
    for (std::size_t k = 0; k < rule.size(); ++k) {
      const double here = basis(rule[k].position);
      sum += here * at_points[k];
      norm += here * here;
    }
    value += sum / norm * basis(reference);
  }
  return value;
}

}  // namespace

template <int Dim>
FlowView<Dim> view_of(const mixed::MixedFlow<Dim>& flow, const solve::CompensatedVector& state) {
  return {&flow.space().mesh(), flow.rheology().law,
          [&](std::size_t element, const fem::Point<Dim>& reference) -> FlowSample<Dim> {
            const mixed::FlowPoint<Dim> at = flow.point_at(state, element, reference);
            return {at.values.position, at.values.velocity.norm(), at.values.pressure,
                    at.law.stress(), at.law};
          }};
}

FlowView<2> view_of(const shear::CrossSection<2>& space, const shear::ShearSolution& solution,
                    const std::function<double(const fem::Point<2>&)>& pressure,
                    const rheology::Rheology& rheology) {
  return {&space.mesh(), rheology.law,
          [&space, &solution, pressure, rheology](std::size_t element,
                                                  const fem::Point<2>& reference) -> FlowSample<2> {
            const fem::ElementPoint<2> at(space.mesh(), element, reference);
            const auto local = space.local_velocities(solution.velocity, element);
            const auto velocity = static_cast<double>(
                local.interior + at.values.cast<long double>().dot(local.relative));
            const auto own = [&](const std::vector<double>& everywhere) {
              const std::span<const double> here(&everywhere[*space.points_of(element).begin()],
                                                 space.points_per_element());
              return std::max(0., interpolated(here, reference));
            };
            const double stress = own(solution.stress);
            rheology::LocalState law =
                rheology.local_state(own(solution.shear_rate), pressure(at.position));
            law.viscosity = stress / law.shear_rate;
            law.has_yielded = stress > rheology.law.mu_s * law.regularised_pressure;
            return {at.position, std::abs(velocity), 0, stress, law};
          }};
}

template <int Dim>
std::vector<io::Field> cell_means(const FlowView<Dim>& view, bool with_dynamic_pressure) {
  io::Field rate{"shear_rate", {}}, inertial{"inertial_number", {}}, pressure{"pressure", {}},
      dynamic{"dynamic_pressure", {}}, stress{"stress", {}}, yield{"stress_over_yield_stress", {}};
  const auto rule = fem::gauss_rule<Dim>(3);
  const double share = 1 / static_cast<double>(rule.size());
  for (std::size_t e = 0; e < view.mesh->elements.size(); ++e) {
    double rates = 0, pressures = 0, dynamics = 0, stresses = 0;
    for (const auto& point : rule) {
      const FlowSample<Dim> at = view.at(e, point.position);
      rates += share * at.law.shear_rate;
      pressures += share * at.law.total_pressure;
      dynamics += share * at.dynamic_pressure;
      stresses += share * at.stress;
    }
    rate.values.push_back(rates);
    pressure.values.push_back(pressures);
    dynamic.values.push_back(dynamics);
    stress.values.push_back(stresses);
    inertial.values.push_back(view.law.inertial_number(rates, pressures));
    yield.values.push_back(stresses / (view.law.mu_s * pressures));
  }
  std::vector<io::Field> fields = {rate, inertial, pressure, stress, yield};
  if (with_dynamic_pressure) fields.insert(fields.begin() + 3, dynamic);
  return fields;
}

template FlowView<2> view_of(const mixed::MixedFlow<2>&, const solve::CompensatedVector&);
template FlowView<3> view_of(const mixed::MixedFlow<3>&, const solve::CompensatedVector&);
template std::vector<io::Field> cell_means(const FlowView<2>&, bool);
template std::vector<io::Field> cell_means(const FlowView<3>&, bool);

}  // namespace talus::program
