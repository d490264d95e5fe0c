// Lines and areas of equal value of a field that is sampled on patches.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace talus::io {

using PlanePoint = std::array<double, 2>;
using Polyline = std::vector<PlanePoint>;

/// A field on one quadrilateral, curved or not: a grid of points, `columns` in a row, and the value
/// at each. Patches share nothing, so that a field may jump from one to the next.
struct FieldPatch {
  std::size_t columns = 0;
  std::vector<PlanePoint> points;
  std::vector<double> values;

  std::size_t rows() const { return columns == 0 ? 0 : points.size() / columns; }
};

/// The smallest box around the points: lower left and upper right corner; zero without points.
struct Window {
  PlanePoint low{}, high{};

  double extent(std::size_t axis) const { return high[axis] - low[axis]; }
};
Window box_of(std::span<const FieldPatch> patches);

// All of them cut off what is outside the window, and round coordinates to less than 1/10000 of it:
// points of neighbours that are meant to be the same are so. Along the edge of a cell the field is
// taken as linear. The same points on both sides of an edge are asked for.

/// Where the field takes a value: lines through the cells of the patches, straight in each, joined
/// where their ends meet; where a corner is not a number there is none.
std::vector<Polyline> isolines(std::span<const FieldPatch> patches, double level,
                               const Window& window);

/// Outlines of the area where low <= value < high, each closed (its first point is not repeated),
/// counter-clockwise around it and clockwise around holes.
std::vector<Polyline> area_between(std::span<const FieldPatch> patches, double low, double high,
                                   const Window& window);
/// Outlines of the cells with a corner that is not a number, or of all cells.
std::vector<Polyline> area_without_number(std::span<const FieldPatch> patches,
                                          const Window& window);
std::vector<Polyline> area_of_all(std::span<const FieldPatch> patches, const Window& window);

/// The same area as a single polygon, which goes to and fro between the outlines.
Polyline joined(const std::vector<Polyline>& outlines);

/// Signed area of a closed line.
double area_of(const Polyline& outline);

}  // namespace talus::io
