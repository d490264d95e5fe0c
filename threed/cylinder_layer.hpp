// Flow around the cylinder as the paper ran it: one layer of H27 elements on the mesh of the plane,
// symmetry at back and front.
#pragma once

#include "common/mixed/layer.hpp"
#include "twod/cylinder.hpp"

namespace talus::threed {

/// Coordinates (x, z, and the axis of the cylinder); lengths in D, the rest scaled as the plane's.
class CylinderLayer {
 public:
  using State = mixed::MixedFlow<3>::State;
  /// The scene of a plane flow, at its λr and loading. The paper's thickness is not given.
  explicit CylinderLayer(const twod::CylinderFlow& plane, double thickness = 1);
  CylinderLayer(const CylinderLayer&) = delete;  // flow_ refers to space_
  CylinderLayer& operator=(const CylinderLayer&) = delete;

  const mixed::MixedSpace<3>& space() const { return space_; }
  mixed::MixedFlow<3>& flow() { return flow_; }
  const mixed::MixedFlow<3>& flow() const { return flow_; }

  /// Drag per unit thickness on the whole cylinder, F_D/(p_ext D), from the consistent nodal
  /// reactions at the state last evaluated.
  double drag() const;

 private:
  double thickness_, halves_;
  mixed::MixedSpace<3> space_;
  mixed::MixedFlow<3> flow_;
};

}  // namespace talus::threed
