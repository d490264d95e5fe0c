#include "common/mixed/manufactured.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include <boost/math/differentiation/autodiff.hpp>

namespace talus::mixed {
namespace {

// Each flow: functions of the coordinates for velocity and pressure, of any number type. Pressures
// are large enough to keep I in the well-posed band (0.02 to 0.85): outside it the discrete
// solutions wander with the mesh, and no order can be seen. All fields are curved enough for the
// best approximation to dominate: what else there is superconverges on regular meshes, and hides
// the order behind a larger one.

// γ_xy = 1 everywhere, so |γ| >= 1.
struct Sheared2 {
  static constexpr const char* name = "sheared";
  static constexpr double lambda_r = 1e-3;
  template <class X, class Y>
  static auto u(const X& x, const Y& y) {
    return y + 0.2 * sin(2.0 * x) * cos(2.0 * y);
  }
  template <class X, class Y>
  static auto v(const X& x, const Y& y) {
    return -0.2 * cos(2.0 * x) * sin(2.0 * y);
  }
  template <class X, class Y>
  static auto p(const X& x, const Y& y) {
    return 5.0 + 0.5 * sin(x) * cos(2.0 * y);
  }
};

// γ_xy = cos 2x + cos 2y changes sign inside; some stretching keeps |γ| above 0.4 there. Where |γ|
// vanishes on a line, |γ| γ has a kink across it, and with it the force: no longer smooth.
struct Turning2 {
  static constexpr const char* name = "turning";
  static constexpr double lambda_r = 0.5;
  template <class X, class Y>
  static auto u(const X& x, const Y& y) {
    return 0.5 * sin(2.0 * y) + 0.2 * x;
  }
  template <class X, class Y>
  static auto v(const X& x, const Y& y) {
    return 0.5 * sin(2.0 * x) - 0.2 * y;
  }
  template <class X, class Y>
  static auto p(const X& x, const Y& y) {
    return 15.0 + 3.0 * cos(2.0 * x + y);
  }
};

// A Taylor-Green vortex: every velocity depends on every coordinate.
template <class X, class Y, class Z>
auto vortex_u(const X& x, const Y& y, const Z& z) {
  return 0.4 * sin(x) * cos(y) * cos(z);
}
template <class X, class Y, class Z>
auto vortex_v(const X& x, const Y& y, const Z& z) {
  return -0.2 * cos(x) * sin(y) * cos(z);
}
template <class X, class Y, class Z>
auto vortex_w(const X& x, const Y& y, const Z& z) {
  return -0.2 * cos(x) * cos(y) * sin(z);
}

// A sheared Arnold-Beltrami-Childress flow and the vortex.
struct Sheared3 {
  static constexpr const char* name = "sheared";
  static constexpr double lambda_r = 1e-3;
  template <class X, class Y, class Z>
  static auto u(const X& x, const Y& y, const Z& z) {
    return 2.0 * y + 0.2 * sin(z) + 0.3 * cos(y) + vortex_u(x, y, z);
  }
  template <class X, class Y, class Z>
  static auto v(const X& x, const Y& y, const Z& z) {
    return 0.25 * sin(x) + 0.2 * cos(z) + vortex_v(x, y, z);
  }
  template <class X, class Y, class Z>
  static auto w(const X& x, const Y& y, const Z& z) {
    return 0.3 * sin(y) + 0.25 * cos(x) + vortex_w(x, y, z);
  }
  template <class X, class Y, class Z>
  static auto p(const X& x, const Y& y, const Z& z) {
    return 20.0 + 0.5 * sin(x) * cos(y) * cos(z);
  }
};

struct Turning3 {
  static constexpr const char* name = "turning";
  static constexpr double lambda_r = 0.5;
  template <class X, class Y, class Z>
  static auto u(const X& x, const Y& y, const Z& z) {
    return 0.5 * sin(2.0 * y) + 0.2 * cos(z) + 0.2 * x + vortex_u(x, y, z);
  }
  template <class X, class Y, class Z>
  static auto v(const X& x, const Y& y, const Z& z) {
    return 0.5 * sin(2.0 * x) - 0.2 * y + vortex_v(x, y, z);
  }
  template <class X, class Y, class Z>
  static auto w(const X& x, const Y& y, const Z& z) {
    return 0.2 * sin(x + y) + vortex_w(x, y, z);
  }
  template <class X, class Y, class Z>
  static auto p(const X& x, const Y& y, const Z& z) {
    return 20.0 + 3.0 * cos(2.0 * x + y) * cos(z);
  }
};

// Fills row i of the velocity from a value with all derivatives up to the second.
template <class Jet>
void fill(FlowDerivatives<2>& at, Eigen::Index i, const Jet& jet) {
  at.velocity[i] = jet.derivative(0, 0);
  at.gradient.row(i) << jet.derivative(1, 0), jet.derivative(0, 1);
  at.hessian[static_cast<std::size_t>(i)] << jet.derivative(2, 0), jet.derivative(1, 1),
      jet.derivative(1, 1), jet.derivative(0, 2);
}
template <class Jet>
void fill(FlowDerivatives<3>& at, Eigen::Index i, const Jet& jet) {
  at.velocity[i] = jet.derivative(0, 0, 0);
  at.gradient.row(i) << jet.derivative(1, 0, 0), jet.derivative(0, 1, 0), jet.derivative(0, 0, 1);
  at.hessian[static_cast<std::size_t>(i)] << jet.derivative(2, 0, 0), jet.derivative(1, 1, 0),
      jet.derivative(1, 0, 1), jet.derivative(1, 1, 0), jet.derivative(0, 2, 0),
      jet.derivative(0, 1, 1), jet.derivative(1, 0, 1), jet.derivative(0, 1, 1),
      jet.derivative(0, 0, 2);
}

template <class Flow>
FlowDerivatives<2> derivatives2(const fem::Point<2>& position) {
  const auto [x, y] =
      boost::math::differentiation::make_ftuple<double, 2, 2>(position[0], position[1]);
  FlowDerivatives<2> at;
  fill(at, 0, Flow::u(x, y));
  fill(at, 1, Flow::v(x, y));
  const auto p = Flow::p(x, y);
  at.pressure = p.derivative(0, 0);
  at.pressure_gradient << p.derivative(1, 0), p.derivative(0, 1);
  return at;
}

template <class Flow>
FlowDerivatives<3> derivatives3(const fem::Point<3>& position) {
  const auto [x, y, z] = boost::math::differentiation::make_ftuple<double, 2, 2, 2>(
      position[0], position[1], position[2]);
  FlowDerivatives<3> at;
  fill(at, 0, Flow::u(x, y, z));
  fill(at, 1, Flow::v(x, y, z));
  fill(at, 2, Flow::w(x, y, z));
  const auto p = Flow::p(x, y, z);
  at.pressure = p.derivative(0, 0, 0);
  at.pressure_gradient << p.derivative(1, 0, 0), p.derivative(0, 1, 0), p.derivative(0, 0, 1);
  return at;
}

template <int Dim>
double shear_rate_of(const Eigen::Matrix<double, Dim, Dim>& gamma) {
  return gamma.norm() / std::sqrt(2.0);
}

}  // namespace

template <int Dim>
fem::Point<Dim> ManufacturedFlow<Dim>::body_force(const fem::Point<Dim>& position,
                                                  const rheology::Rheology& rheology,
                                                  double inertia) const {
  using Tensor = Eigen::Matrix<double, Dim, Dim>;
  const FlowDerivatives<Dim> flow = at(position);
  const Tensor gamma = flow.gradient + flow.gradient.transpose();
  const double shear_rate = shear_rate_of<Dim>(gamma);
  const rheology::Viscosity v = rheology.evaluate(shear_rate, flow.pressure);
  fem::Point<Dim> force = inertia * flow.gradient * flow.velocity + flow.pressure_gradient;
  for (int j = 0; j < Dim; ++j) {
    Tensor gamma_slope;  // ∂_j γ
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k)
        gamma_slope(i, k) = flow.hessian[static_cast<std::size_t>(i)](k, j) +
                            flow.hessian[static_cast<std::size_t>(k)](i, j);
    double viscosity_slope = v.d_eta_d_pressure * flow.pressure_gradient[j];
    if (shear_rate > 0)
      viscosity_slope +=
          v.d_eta_d_shear_rate * gamma.cwiseProduct(gamma_slope).sum() / (2 * shear_rate);
    force -= v.eta * gamma_slope.col(j) + viscosity_slope * gamma.col(j);
  }
  return force;
}

template <int Dim>
MixedLoad<Dim> ManufacturedFlow<Dim>::load(const rheology::Rheology& rheology,
                                           double inertia) const {
  return {[](const fem::Point<Dim>&) { return 0.0; },
          [this, rheology, inertia](const fem::Point<Dim>& x) {
            return body_force(x, rheology, inertia);
          },
          inertia};
}

template <int Dim>
fem::Point<Dim> ManufacturedFlow<Dim>::traction(const fem::Point<Dim>& position,
                                                const fem::Point<Dim>& normal,
                                                const rheology::Rheology& rheology) const {
  const FlowDerivatives<Dim> flow = at(position);
  const Eigen::Matrix<double, Dim, Dim> gamma = flow.gradient + flow.gradient.transpose();
  return rheology.evaluate(shear_rate_of<Dim>(gamma), flow.pressure).eta * gamma * normal -
         flow.pressure * normal;
}

template <>
const std::vector<ManufacturedFlow<2>>& manufactured_flows() {
  static const std::vector<ManufacturedFlow<2>> flows = {
      {Sheared2::name, Sheared2::lambda_r, derivatives2<Sheared2>},
      {Turning2::name, Turning2::lambda_r, derivatives2<Turning2>}};
  return flows;
}

template <>
const std::vector<ManufacturedFlow<3>>& manufactured_flows() {
  static const std::vector<ManufacturedFlow<3>> flows = {
      {Sheared3::name, Sheared3::lambda_r, derivatives3<Sheared3>},
      {Turning3::name, Turning3::lambda_r, derivatives3<Turning3>}};
  return flows;
}

template <int Dim>
typename MixedSpace<Dim>::State interpolate(const ManufacturedFlow<Dim>& exact,
                                            const MixedSpace<Dim>& space) {
  auto state = space.start();
  const auto& nodes = space.mesh().nodes;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const fem::Point<Dim> velocity = exact.at(nodes[node]).velocity;
    for (int i = 0; i < Dim; ++i)
      state.set(space.velocity_index(static_cast<Eigen::Index>(node), i), velocity[i]);
  }
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    const auto middle = space.mesh().elements[e][MixedSpace<Dim>::interior];
    state.set(space.pressure_index(e, 0),
              exact.at(nodes[static_cast<std::size_t>(middle)]).pressure);
  }
  return state;
}

template <int Dim>
FlowErrors errors_against(const ManufacturedFlow<Dim>& exact, const MixedSpace<Dim>& space,
                          const solve::CompensatedVector& state) {
  constexpr int points_per_direction = 4;  // one more than the solver: no superconvergent points
  FlowErrors squares;
  const auto rule = fem::gauss_rule<Dim>(points_per_direction);
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : rule) {
      const auto values = space.values_at(state, e, point.position);
      const FlowDerivatives<Dim> at = exact.at(values.position);
      const double weight =
          point.weight * fem::ElementPoint<Dim>(space.mesh(), e, point.position).determinant;
      squares.velocity += weight * (values.velocity - at.velocity).squaredNorm();
      squares.gradient += weight * (values.velocity_gradient - at.gradient).squaredNorm();
      squares.pressure += weight * std::pow(values.pressure - at.pressure, 2);
      squares.divergence += weight * std::pow(values.divergence(), 2);
    }
  return {std::sqrt(squares.velocity), std::sqrt(squares.gradient), std::sqrt(squares.pressure),
          std::sqrt(squares.divergence)};
}

template struct ManufacturedFlow<2>;
template struct ManufacturedFlow<3>;
template MixedSpace<2>::State interpolate(const ManufacturedFlow<2>&, const MixedSpace<2>&);
template MixedSpace<3>::State interpolate(const ManufacturedFlow<3>&, const MixedSpace<3>&);
template FlowErrors errors_against(const ManufacturedFlow<2>&, const MixedSpace<2>&,
                                   const solve::CompensatedVector&);
template FlowErrors errors_against(const ManufacturedFlow<3>&, const MixedSpace<3>&,
                                   const solve::CompensatedVector&);

}  // namespace talus::mixed
