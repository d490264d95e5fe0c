// Element boundaries along a line: uniform, graded, geometric, or with a given point at a given
// place.
#pragma once

#include <vector>

namespace talus::fem {

/// Boundaries of n elements on [start, end]: start + (end - start)(1 - (1 - i/n)^exponent), i =
/// 0..n. Exponent 1 is uniform; a larger one refines towards `end`. n >= 1, exponent >= 1.
std::vector<double> graded_line(double start, double end, int elements, double exponent);

/// The exponent at which the narrowest of n elements has 1e-14 of the length: beyond, its ends are
/// told apart by fewer than two digits in double precision. Infinite for one element.
double largest_grading(int elements);

/// Boundaries of n elements on [start, end] that widen (or narrow) by a constant ratio from an
/// element of width `first` at the start; the ratio is between 0.001 and 10.
std::vector<double> geometric_line(double start, double end, int elements, double first);

/// Boundaries of n elements on [0, length] such that `point` lies at the fraction (in [0, 1)) of
/// its element, 0 being a node. Elements are uniform up to the end of that element and, with the
/// given grading, beyond it. Needs can_align(...).
std::vector<double> aligned_line(double length, int elements, double point, double fraction,
                                 double exponent);

/// Whether `elements` are enough to leave at least one on either side.
bool can_align(double length, int elements, double point, double fraction);

}  // namespace talus::fem
