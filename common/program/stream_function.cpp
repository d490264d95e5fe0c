#include "common/program/stream_function.hpp"

#include <cmath>
#include <deque>

namespace talus::program {
namespace {

// The nodes of an element one after the other around it, and the centre.
constexpr std::array<std::size_t, 8> ring = {0, 1, 2, 5, 8, 7, 6, 3};
constexpr std::size_t centre = 4;

fem::Point<2> reference_of(std::size_t node) {
  return {static_cast<double>(node % 3) - 1, static_cast<double>(node / 3) - 1};
}

// The flow of one element.
struct ElementFlow {
  Eigen::Matrix<double, 2, 9> position, velocity;

  ElementFlow(const mixed::MixedSpace<2>& space, const solve::CompensatedVector& state,
              std::size_t e) {
    for (std::size_t a = 0; a < 9; ++a) {
      const Eigen::Index node = space.mesh().elements[e][a], column = static_cast<Eigen::Index>(a);
      position.col(column) = space.mesh().nodes[static_cast<std::size_t>(node)];
      for (int i = 0; i < 2; ++i)
        velocity(i, column) = state.value()[space.velocity_index(node, i)];
    }
  }

  // ∫ u_x dy - u_y dx between two neighbours: half a side, on which it is of degree three.
  double flux(std::size_t from, std::size_t to) const {
    const fem::Point<2> start = reference_of(from), along = reference_of(to) - start;
    double sum = 0;
    for (const double share : {0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)}) {
      const fem::QuadraticBasis<2> basis(start + share * along);
      const fem::Point<2> u = velocity * basis.values;
      const fem::Point<2> dx = position * basis.gradients.transpose() * along;
      sum += 0.5 * (u[0] * dx[1] - u[1] * dx[0]);
    }
    return sum;
  }
};

// From the first node on the ring that is known to the others, and to the centre.
void fill(const ElementFlow& flow, const std::array<Eigen::Index, 9>& nodes, Eigen::VectorXd& psi) {
  std::size_t first = 0;
  while (first < ring.size() && std::isnan(psi[nodes[ring[first]]])) ++first;
  if (first == ring.size()) return;  // a velocity on the way is not a number
  for (std::size_t step = 0; step + 1 < ring.size(); ++step) {
    const std::size_t here = ring[(first + step) % ring.size()];
    const std::size_t next = ring[(first + step + 1) % ring.size()];
    if (std::isnan(psi[nodes[next]])) psi[nodes[next]] = psi[nodes[here]] + flow.flux(here, next);
  }
  psi[nodes[centre]] = 0;
  for (const std::size_t side : {1u, 3u, 5u, 7u})
    psi[nodes[centre]] += 0.25 * (psi[nodes[side]] + flow.flux(side, centre));
}

}  // namespace

Eigen::VectorXd stream_function(const mixed::MixedSpace<2>& space,
                                const solve::CompensatedVector& state) {
  const auto& elements = space.mesh().elements;
  std::vector<std::vector<std::size_t>> elements_at(space.mesh().nodes.size());
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const Eigen::Index node : elements[e])
      elements_at[static_cast<std::size_t>(node)].push_back(e);

  Eigen::VectorXd psi =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(space.mesh().nodes.size()), std::nan(""));
  psi[elements[0][0]] = 0;
  std::vector<bool> is_seen(elements.size(), false);
  std::deque<std::size_t> waiting{0};
  is_seen[0] = true;
  while (!waiting.empty()) {
    const std::size_t e = waiting.front();
    waiting.pop_front();
    fill(ElementFlow(space, state, e), elements[e], psi);
    for (const Eigen::Index node : elements[e])
      for (const std::size_t neighbour : elements_at[static_cast<std::size_t>(node)])
        if (!is_seen[neighbour]) {
          is_seen[neighbour] = true;
          waiting.push_back(neighbour);
        }
  }
  return psi;
}

}  // namespace talus::program
