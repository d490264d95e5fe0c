// What elimination in the order of nested dissection costs, before there is a matrix.
#pragma once

#include <array>

namespace talus::solve {

/// Of the factor L of a symmetric matrix; an unsymmetric one of the same pattern has twice as much
/// of both.
struct FactorSize {
  double entries = 0;
  double operations = 0;  ///< multiplications and additions, each counted
};

/// The factor of a box of so many quadratic elements along its axes (0: it has no such axis), their
/// interior nodes condensed, with so many unknowns a node on average. The box is cut in half across
/// its longest axis, again and again (George 1973): in the plane O(n log n) entries and O(n^{3/2})
/// operations, in space O(n^{4/3}) and O(n²), in a layer what lies between.
FactorSize nested_dissection(const std::array<int, 3>& elements, double unknowns_per_node);

}  // namespace talus::solve
