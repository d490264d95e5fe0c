#include "common/solve/nested_dissection.hpp"

#include <algorithm>
#include <map>

namespace talus::solve {
namespace {

// A part of the box. Sides that an earlier cut made are its border: their nodes are eliminated
// after its own.
struct Part {
  std::array<int, 3> elements{};
  std::array<int, 3> borders{};  // of the sides across each axis: 0, 1 or 2
  auto operator<=>(const Part&) const = default;

  // Nodes along an axis, with or without those on its border.
  double nodes(std::size_t axis, bool with_border) const {
    if (elements[axis] == 0) return 1;
    return 2. * elements[axis] + 1 - (with_border ? 0 : borders[axis]);
  }
  double all_nodes(bool with_border) const {
    return nodes(0, with_border) * nodes(1, with_border) * nodes(2, with_border);
  }
};

class Dissection {
 public:
  explicit Dissection(double unknowns_per_node) : unknowns_per_node_(unknowns_per_node) {}

  FactorSize of(const Part& part) {
    const auto known = sizes_.find(part);
    if (known != sizes_.end()) return known->second;
    const auto longest =
        static_cast<std::size_t>(std::ranges::max_element(part.elements) - part.elements.begin());
    const double border = part.all_nodes(true) - part.all_nodes(false);
    FactorSize size;
    if (part.elements[longest] <= 1) {
      size = front(part.all_nodes(false) - 1, border);  // its interior node is condensed
    } else {
      Part first = part, second = part;
      first.elements[longest] /= 2;
      second.elements[longest] -= first.elements[longest];
      // Half of what an axis has lies on either side.
      first.borders[longest] = part.borders[longest] == 2 ? 2 : 1;
      second.borders[longest] = part.borders[longest] > 0 ? 2 : 1;
      size = front(part.all_nodes(false) / part.nodes(longest, false), border);
      for (const Part& half : {first, second}) {
        const FactorSize of_half = of(half);
        size.entries += of_half.entries;
        size.operations += of_half.operations;
      }
    }
    return sizes_[part] = size;
  }

 private:
  // So many nodes eliminated at once, with a border of so many others.
  FactorSize front(double nodes, double border) const {
    const double s = unknowns_per_node_ * nodes, b = unknowns_per_node_ * border;
    return {s * (s + 1) / 2 + s * b, s * s * s / 3 + s * s * b + s * b * b};
  }

  double unknowns_per_node_;
  std::map<Part, FactorSize> sizes_;
};

}  // namespace

FactorSize nested_dissection(const std::array<int, 3>& elements, double unknowns_per_node) {
  return Dissection(unknowns_per_node).of({elements});
}

}  // namespace talus::solve
