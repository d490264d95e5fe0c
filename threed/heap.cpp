#include "threed/heap.hpp"

#include <algorithm>

#include "common/fem/line_mesh.hpp"
#include "twod/section_nested.hpp"

namespace talus::threed {
namespace {

double length_of(const Heap& heap, const HeapMesh& mesh) {
  if (mesh.length > 0) return mesh.length;
  return mesh.along * 0.5 * heap.section.width / mesh.section.across;
}

std::array<std::vector<double>, 3> lines_of(const Heap& heap, const HeapMesh& mesh) {
  const auto [across, up] = twod::lines_of(heap.section, mesh.section);
  return {fem::graded_line(0, length_of(heap, mesh), mesh.along, 1), across, up};
}

// Boundaries by their names in a tensor mesh.
mixed::BoundaryConditions<3> boundary_conditions(const Heap& heap) {
  return {
      {"left", mixed::fully_developed<3>(0)},
      {"right", heap.open_outlet == mixed::Open::no ? mixed::fully_developed<3>(0)
                                                    : mixed::open_boundary<3>(heap.open_outlet)},
      {"bottom", mixed::symmetry<3>(1)},  // y = 0
      {"top", mixed::no_slip<3>()},       // the side wall
      {"back", mixed::no_slip<3>()},      // z = 0
      {"front", {}}};                     // the free surface
}

mixed::MixedLoad<3> load_of(const Heap& heap) {
  using fem::Point;
  const auto load = twod::load_of(heap.section);
  return {[=](const Point<3>& x) { return load.pressure(x.tail<2>()); },
          [=](const Point<3>& x) { return Point<3>(load.body_force(x.tail<2>()), 0, 0); }};
}

}  // namespace

std::optional<HeapMesh> coarsened(const Heap& heap, const HeapMesh& mesh) {
  const auto section = twod::coarsened(mesh.section);
  if (!section) return std::nullopt;
  return HeapMesh{(mesh.along + 1) / 2, *section, length_of(heap, mesh)};
}

HeapFlow::HeapFlow(const Heap& heap, const HeapMesh& mesh)
    : heap_(heap),
      mesh_(mesh),
      lines_(lines_of(heap, mesh)),
      space_(fem::box_mesh(lines_[0], lines_[1], lines_[2]), boundary_conditions(heap)),
      flow_(space_, {heap.section.law, heap.regularisation, heap.lambda_r}, load_of(heap),
            heap.penalty) {}

mixed::FlowPoint<3> HeapFlow::point_at(const State& state, std::size_t element,
                                       const fem::Point<3>& reference) const {
  return flow_.point_at(state, element, reference);
}

mixed::FlowPoint<3> HeapFlow::point_at(const State& state, const fem::Point<3>& position) const {
  const auto place = fem::locate<3>({lines_[0], lines_[1], lines_[2]}, position);
  return point_at(state, place.element, place.reference);
}

}  // namespace talus::threed
