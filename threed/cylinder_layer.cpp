#include "threed/cylinder_layer.hpp"

#include <array>

#include "common/mixed/reaction.hpp"

namespace talus::threed {
namespace {

mixed::BoundaryConditions<3> boundary_conditions(const twod::Cylinder& scene) {
  mixed::BoundaryConditions<3> conditions = {
      {"cylinder", mixed::no_slip<3>()},
      {"wall", mixed::no_slip<3>()},
      {"top", mixed::fully_developed<3>(1)},
      {"bottom", scene.open_outlet == mixed::Open::no ? mixed::fully_developed<3>(1)
                                                      : mixed::open_boundary<3>(scene.open_outlet)},
      {"back", mixed::symmetry<3>(2)},
      {"front", mixed::symmetry<3>(2)}};
  if (!scene.mesh.full) conditions["symmetry"] = mixed::symmetry<3>(0);
  return conditions;
}

mixed::MixedLoad<3> load_of(const twod::Cylinder& scene) {
  return {[](const fem::Point<3>&) { return 1.0; },
          [](const fem::Point<3>&) { return fem::Point<3>(0, -1, 0); }, scene.inertia ? 1.0 : 0.0};
}

}  // namespace

CylinderLayer::CylinderLayer(const twod::CylinderFlow& plane, double thickness)
    : thickness_(thickness),
      halves_(plane.scene().mesh.full ? 1 : 2),
      space_(mixed::extruded_mesh(plane.space().mesh(), std::array{0.0, thickness}),
             boundary_conditions(plane.scene())),
      flow_(space_, plane.flow().rheology(), load_of(plane.scene()), plane.scene().penalty) {
  flow_.set_load_factor(plane.flow().load_factor());
}

double CylinderLayer::drag() const {
  return halves_ * mixed::total_reaction(flow_, "cylinder", 1) / thickness_;
}

}  // namespace talus::threed
