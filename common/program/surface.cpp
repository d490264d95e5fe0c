// The surfaces that pictures show.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "common/program/flow_picture.hpp"
#include "common/program/stream_function.hpp"

namespace talus::program {
namespace {

// A facet of a cut: an element and where the cut goes through it.
struct CutElement {
  std::size_t element = 0;
  double reference = 0;
};

std::vector<CutElement> elements_at(const fem::Mesh<3>& mesh, int axis, double value) {
  std::vector<CutElement> found;
  double bottom = std::numeric_limits<double>::infinity();
  for (const auto& node : mesh.nodes) bottom = std::min(bottom, node[axis]);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Eigen::Index node : mesh.elements[e]) {
      const double x = mesh.nodes[static_cast<std::size_t>(node)][axis];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    // A side belongs to the element below it; there is none below the lowest.
    if ((low < value && value <= high) || (value == bottom && low == bottom))
      found.push_back({e, (2 * value - low - high) / (high - low)});
  }
  return found;
}

}  // namespace

Surface surface_of(const FlowView<2>& view) {
  return {view.mesh->elements.size(),
          [view](std::size_t e, const fem::Point<2>& reference) -> PictureSample {
            const FlowSample<2> at = view.at(e, reference);
            return {{at.position[0], at.position[1]}, at.speed, at.stress, at.law};
          }};
}

Surface surface_of(const mixed::MixedFlow<2>& flow, const solve::CompensatedVector& state) {
  Surface surface = surface_of(view_of(flow, state));
  const auto psi = std::make_shared<Eigen::VectorXd>(stream_function(flow.space(), state));
  const fem::Mesh<2>& mesh = flow.space().mesh();
  surface.stream = [psi, &mesh](std::size_t e, const fem::Point<2>& reference) {
    const fem::QuadraticBasis<2> basis(reference);
    double value = 0;
    for (std::size_t a = 0; a < mesh.elements[e].size(); ++a)
      value += basis.values[static_cast<Eigen::Index>(a)] * (*psi)[mesh.elements[e][a]];
    return value;
  };
  return surface;
}

Surface cut_of(const FlowView<3>& view, int axis, double value) {
  const auto cut = std::make_shared<std::vector<CutElement>>(elements_at(*view.mesh, axis, value));
  const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  double largest = 0;
  for (const auto& node : view.mesh->nodes)
    largest = std::max(largest, node.lpNorm<Eigen::Infinity>());
  return {cut->size(), [=](std::size_t k, const fem::Point<2>& reference) -> PictureSample {
            fem::Point<3> inside;
            inside[axis] = (*cut)[k].reference;
            inside[first] = reference[0];
            inside[second] = reference[1];
            const FlowSample<3> at = view.at((*cut)[k].element, inside);
            if (std::abs(at.position[axis] - value) > 1e-9 * largest)
              throw std::invalid_argument("a cut through elements that are not straight");
            return {{at.position[first], at.position[second]}, at.speed, at.stress, at.law};
          }};
}

}  // namespace talus::program
