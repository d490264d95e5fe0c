#include "threed/cylinder_layer.hpp"

#include <array>

#include "common/flow/reaction.hpp"

namespace talus::threed {
namespace {

flow::BoundaryConditions<3> boundary_conditions(const twod::Cylinder& scene) {
  flow::BoundaryConditions<3> conditions = {
      {"cylinder", flow::no_slip<3>()},
      {"wall", flow::no_slip<3>()},
      {"top", flow::fully_developed<3>(1)},
      {"bottom", scene.open_outlet == flow::Open::no ? flow::fully_developed<3>(1)
                                                     : flow::open_boundary<3>(scene.open_outlet)},
      {"back", flow::symmetry<3>(2)},
      {"front", flow::symmetry<3>(2)}};
  if (!scene.mesh.full) conditions["symmetry"] = flow::symmetry<3>(0);
  return conditions;
}

flow::DenseLoad<3> load_of(const twod::Cylinder& scene) {
  return {[](const flow::Point<3>&) { return 1.0; },
          [](const flow::Point<3>&) { return flow::Point<3>(0, -1, 0); },
          scene.inertia ? 1.0 : 0.0};
}

}  // namespace

CylinderLayer::CylinderLayer(const twod::CylinderFlow& plane, double thickness)
    : thickness_(thickness),
      halves_(plane.scene().mesh.full ? 1 : 2),
      space_(flow::extruded_mesh(plane.space().mesh(), std::array{0.0, thickness}),
             boundary_conditions(plane.scene())),
      flow_(space_, plane.flow().rheology(), load_of(plane.scene()), plane.scene().penalty) {
  flow_.set_load_factor(plane.flow().load_factor());
}

double CylinderLayer::drag() const {
  return halves_ * flow::total_reaction(flow_, "cylinder", 1) / thickness_;
}

}  // namespace talus::threed
