// A solved flow that can be asked anywhere inside its elements, whatever it was solved by: what is
// written for ParaView and what is drawn comes from here.
#pragma once

#include <functional>
#include <vector>

#include "common/io/vtu.hpp"
#include "common/mixed/mixed_flow.hpp"
#include "common/shear/shear_solver.hpp"

namespace talus::program {

/// A point of a flow.
template <int Dim>
struct FlowSample {
  fem::Point<Dim> position;
  double speed = 0;
  double dynamic_pressure = 0;  ///< 0 of unidirectional flow
  double stress = 0;            ///< |τ|
  rheology::LocalState law;
};

/// Values inside an element, up to its sides: nothing is averaged over several. What it is made of
/// must outlive it.
template <int Dim>
struct FlowView {
  const fem::Mesh<Dim>* mesh;
  rheology::FrictionLaw law;
  std::function<FlowSample<Dim>(std::size_t element, const fem::Point<Dim>& reference)> at;
};

template <int Dim>
FlowView<Dim> view_of(const mixed::MixedFlow<Dim>& flow, const solve::CompensatedVector& state);

/// Of a cross-section. Shear rate and stress are the solver's own, bilinear in each element: the
/// stress of the interior point says how far a plug is from yielding.
FlowView<2> view_of(const shear::CrossSection<2>& space, const shear::ShearSolution& solution,
                    const std::function<double(const fem::Point<2>&)>& pressure,
                    const rheology::Rheology& rheology);

/// Means over the quadrature points of each element: shear rate, pressure, dynamic pressure if it
/// is asked for, stress; inertial number and stress over μs p of the means.
template <int Dim>
std::vector<io::Field> cell_means(const FlowView<Dim>& view, bool with_dynamic_pressure);

}  // namespace talus::program
