// The heap in three dimensions, as the paper solves it: velocity and pressure on H27/P1 elements.
//
// x runs along the stream, y from the middle of the channel to its side wall, z upwards. Symmetry
// at y = 0, no slip at the bottom and the wall, a free surface; the flow enters developed and
// leaves developed or through the open boundary of eq. (8). Static pressure (H - z) cos α, driven
// by sin α: the flow is that of the cross-section (twod/section.hpp), which has its scaling too.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/mixed/mixed_flow.hpp"
#include "twod/section.hpp"

namespace talus::threed {

struct Heap {
  twod::Section section;  ///< without slip at the wall
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};
  double lambda_r = 1e-5;
  mixed::Open open_outlet = mixed::Open::no;  ///< the open boundary of eq. (8) downstream
  mixed::PenaltyOptions penalty = {};
};

/// Elements along the stream, and those of the section.
struct HeapMesh {
  int along = 1;
  twod::SectionMesh section;
  double length = 0;  ///< 0: elements along are as long as those across are wide on average
};

/// Half as many elements each way, rounded up, on the same box; nothing where that saves nothing.
std::optional<HeapMesh> coarsened(const Heap& heap, const HeapMesh& mesh);

/// The discrete problem of a scene.
class HeapFlow {
 public:
  using State = mixed::MixedFlow<3>::State;
  HeapFlow(const Heap& heap, const HeapMesh& mesh);
  HeapFlow(const HeapFlow&) = delete;  // flow_ refers to space_
  HeapFlow& operator=(const HeapFlow&) = delete;

  const Heap& heap() const { return heap_; }
  const HeapMesh& mesh() const { return mesh_; }
  const mixed::MixedSpace<3>& space() const { return space_; }
  mixed::MixedFlow<3>& flow() { return flow_; }
  const mixed::MixedFlow<3>& flow() const { return flow_; }

  mixed::FlowPoint<3> point_at(const State& state, std::size_t element,
                               const fem::Point<3>& reference) const;
  /// The same at a position inside the box.
  mixed::FlowPoint<3> point_at(const State& state, const fem::Point<3>& position) const;

 private:
  Heap heap_;
  HeapMesh mesh_;
  std::array<std::vector<double>, 3> lines_;  // element boundaries along the axes
  mixed::MixedSpace<3> space_;
  mixed::MixedFlow<3> flow_;
};

}  // namespace talus::threed
