#include "common/io/contours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace talus::io {
namespace {

using Key = std::array<long, 2>;  // a point of the grid

struct Corner {
  PlanePoint at;
  double value = 0;
};
using Cell = std::vector<Corner>;  // counter-clockwise

// Coordinates are rounded to a multiple of this: a power of ten, less than 1/10000 of the window.
double grid_of(const Window& box) {
  const double longest = std::max(box.extent(0), box.extent(1));
  return longest > 0 ? std::pow(10, std::floor(std::log10(longest)) - 4) : 1;
}

Key key_of(const PlanePoint& point, double grid) {
  return {std::lround(point[0] / grid), std::lround(point[1] / grid)};
}

PlanePoint point_of(const Key& key, double grid) {
  return {static_cast<double>(key[0]) * grid, static_cast<double>(key[1]) * grid};
}

bool has_number(const Cell& cell) {
  return std::ranges::none_of(cell, [](const Corner& c) { return std::isnan(c.value); });
}

// Where a coordinate of the corners, or their value, is `level`, linear between the two; the same
// from either side.
template <class Coordinate>
Corner crossing(const Corner& a, const Corner& b, const Coordinate& of, double level) {
  if (of(a) > of(b)) return crossing(b, a, of, level);
  const double share = (level - of(a)) / (of(b) - of(a));
  return {{std::lerp(a.at[0], b.at[0], share), std::lerp(a.at[1], b.at[1], share)},
          std::lerp(a.value, b.value, share)};
}

// The part of a cell on one side of a level (Sutherland & Hodgman 1974).
template <class Coordinate>
Cell cut(const Cell& cell, const Coordinate& of, double level, bool keeps_above) {
  const auto is_kept = [&](const Corner& c) { return (of(c) >= level) == keeps_above; };
  if (std::ranges::all_of(cell, is_kept)) return cell;
  Cell part;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Corner &here = cell[i], &next = cell[(i + 1) % cell.size()];
    if (is_kept(here)) part.push_back(here);
    if (is_kept(here) != is_kept(next)) part.push_back(crossing(here, next, of, level));
  }
  return part;
}

constexpr auto value_of = [](const Corner& corner) { return corner.value; };

double area_of(const Cell& cell) {
  Polyline outline;
  for (const Corner& corner : cell) outline.push_back(corner.at);
  return io::area_of(outline);
}

// What of them is in the window.
void for_each_cell(std::span<const FieldPatch> patches, const Window& window,
                   const std::function<void(const Cell&)>& action) {
  for (const FieldPatch& patch : patches)
    for (std::size_t row = 0; row + 1 < patch.rows(); ++row)
      for (std::size_t column = 0; column + 1 < patch.columns; ++column) {
        const std::size_t first = row * patch.columns + column, next = first + patch.columns;
        Cell cell;
        for (const std::size_t k : {first, first + 1, next + 1, next})
          cell.push_back({patch.points[k], patch.values[k]});
        if (area_of(cell) < 0) std::ranges::reverse(cell);  // a mirror image
        for (const std::size_t d : {0u, 1u}) {
          const auto coordinate = [d](const Corner& corner) { return corner.at[d]; };
          cell = cut(cut(cell, coordinate, window.low[d], true), coordinate, window.high[d], false);
        }
        if (!cell.empty()) action(cell);
      }
}

// Sides of polygons; one that is passed in both directions lies inside and is left out.
class Sides {
 public:
  explicit Sides(double grid) : grid_(grid) {}

  void add(const Cell& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Key from = key_of(polygon[i].at, grid_);
      const Key to = key_of(polygon[(i + 1) % polygon.size()].at, grid_);
      if (from == to) continue;
      const auto opposite = sides_.find({to, from});
      if (opposite == sides_.end())
        ++sides_[{from, to}];
      else if (--opposite->second == 0)
        sides_.erase(opposite);
    }
  }

  std::vector<Polyline> outlines() {
    std::vector<Polyline> all;
    while (!sides_.empty()) {
      std::vector<Key> loop{sides_.begin()->first[0]};
      do loop.push_back(take(loop.back()));
      while (loop.back() != loop.front());
      loop.pop_back();
      all.push_back(without_straight_points(loop));
    }
    return all;
  }

 private:
  // As many sides come to a point as leave it: there is always a next one.
  Key take(const Key& from) {
    const auto side = sides_.lower_bound(
        {from, Key{std::numeric_limits<long>::min(), std::numeric_limits<long>::min()}});
    const Key to = side->first[1];
    if (--side->second == 0) sides_.erase(side);
    return to;
  }

  Polyline without_straight_points(const std::vector<Key>& loop) const {
    Polyline line;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Key &before = loop[(i + loop.size() - 1) % loop.size()], &here = loop[i],
                &after = loop[(i + 1) % loop.size()];
      if ((here[0] - before[0]) * (after[1] - here[1]) !=
          (here[1] - before[1]) * (after[0] - here[0]))
        line.push_back(point_of(here, grid_));
    }
    return line;
  }

  double grid_;
  std::map<std::array<Key, 2>, int> sides_;
};

// Pieces of lines, joined where they meet.
class Pieces {
 public:
  explicit Pieces(double grid) : grid_(grid) {}

  void add(const PlanePoint& a, const PlanePoint& b) {
    const Key from = key_of(a, grid_), to = key_of(b, grid_);
    if (from == to) return;
    ends_.insert({from, to});
    ends_.insert({to, from});
  }

  std::vector<Polyline> lines() {
    std::vector<Polyline> all;
    // Open lines from where they end; then what is left is closed.
    for (const bool is_open : {true, false})
      for (auto at = ends_.begin(); at != ends_.end();) {
        const Key start = at->first;
        if (is_open && ends_.count(start) != 1) {
          ++at;
          continue;
        }
        all.push_back(line_from(start));
        at = ends_.lower_bound(start);
      }
    return all;
  }

 private:
  Polyline line_from(Key here) {
    Polyline line{point_of(here, grid_)};
    for (auto next = ends_.find(here); next != ends_.end(); next = ends_.find(here)) {
      const Key there = next->second;
      ends_.erase(next);
      auto [back, last] = ends_.equal_range(there);
      while (back != last && back->second != here) ++back;
      if (back != last) ends_.erase(back);
      line.push_back(point_of(there, grid_));
      here = there;
    }
    return line;
  }

  double grid_;
  std::multimap<Key, Key> ends_;
};

// The pieces in a cell: between the two sides that are crossed, or where all four are, around the
// corners on the other side of the level than the middle.
void add_pieces(const Cell& cell, double level, Pieces& pieces) {
  std::vector<PlanePoint> at;
  double middle = 0;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Corner &here = cell[i], &next = cell[(i + 1) % cell.size()];
    middle += here.value / static_cast<double>(cell.size());
    if ((here.value >= level) != (next.value >= level))
      at.push_back(crossing(here, next, value_of, level).at);
  }
  if (at.size() == 2) pieces.add(at[0], at[1]);
  if (at.size() != 4) return;
  const bool cuts_off_first = (cell[0].value >= level) != (middle >= level);
  pieces.add(at[0], at[cuts_off_first ? 3 : 1]);
  pieces.add(at[2], at[cuts_off_first ? 1 : 3]);
}

}  // namespace

Window box_of(std::span<const FieldPatch> patches) {
  Window box;
  bool is_first = true;
  for (const FieldPatch& patch : patches)
    for (const PlanePoint& point : patch.points)
      for (const std::size_t d : {0u, 1u}) {
        box.low[d] = is_first ? point[d] : std::min(box.low[d], point[d]);
        box.high[d] = is_first ? point[d] : std::max(box.high[d], point[d]);
        is_first = is_first && d == 0;
      }
  return box;
}

std::vector<Polyline> isolines(std::span<const FieldPatch> patches, double level,
                               const Window& window) {
  Pieces pieces(grid_of(window));
  for_each_cell(patches, window, [&](const Cell& cell) {
    if (has_number(cell)) add_pieces(cell, level, pieces);
  });
  return pieces.lines();
}

std::vector<Polyline> area_between(std::span<const FieldPatch> patches, double low, double high,
                                   const Window& window) {
  Sides sides(grid_of(window));
  for_each_cell(patches, window, [&](const Cell& cell) {
    if (!has_number(cell)) return;
    const auto [least, most] = std::ranges::minmax(cell, {}, &Corner::value);
    if (least.value < high && most.value >= low)
      sides.add(cut(cut(cell, value_of, low, true), value_of, high, false));
  });
  return sides.outlines();
}

std::vector<Polyline> area_without_number(std::span<const FieldPatch> patches,
                                          const Window& window) {
  Sides sides(grid_of(window));
  for_each_cell(patches, window, [&](const Cell& cell) {
    if (!has_number(cell)) sides.add(cell);
  });
  return sides.outlines();
}

std::vector<Polyline> area_of_all(std::span<const FieldPatch> patches, const Window& window) {
  Sides sides(grid_of(window));
  for_each_cell(patches, window, [&](const Cell& cell) { sides.add(cell); });
  return sides.outlines();
}

Polyline joined(const std::vector<Polyline>& outlines) {
  Polyline all;
  for (const Polyline& outline : outlines) {
    if (outline.empty()) continue;
    all.insert(all.end(), outline.begin(), outline.end());
    all.push_back(outline.front());
    if (all.size() > outline.size() + 1) all.push_back(all.front());
  }
  return all;
}

double area_of(const Polyline& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanePoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

}  // namespace talus::io
