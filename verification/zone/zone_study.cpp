// Slow flow in a split-bottom cell: the interior point on ever finer meshes, and a curve from an
// ordinary differential equation that it must tend to.
#include "verification/zone/zone_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/solve/extremes.hpp"
#include "twod/least_resistance.hpp"
#include "twod/split_bottom_report.hpp"
#include "verification/harness/fit.hpp"

namespace talus::verification {
namespace {

using twod::SplitBottom;

struct Found {
  double radius = std::numeric_limits<double>::quiet_NaN();  // NaN where the solve fails
  double width = radius, torque = radius, turning = radius;
  int factorisations = 0;
  double seconds = 0;
  io::Table zone = {};
};

Found find(const SplitBottom& cell, shear::CrossSection<2>& space) {
  const auto solution = twod::solve(cell, space, twod::default_options(cell));
  Found found;
  found.factorisations = solution.iterations();
  found.seconds = solution.seconds;
  if (!solve::is_success(solution.end)) return found;
  const twod::Zone zone = twod::zone_of(solution, space);
  found.radius = zone.centre.back();
  found.width = zone.width.back();
  found.torque = twod::torque_integral(solution, space);
  found.turning = io::number_in(twod::surface_table(solution, space).rows.front()[1]);
  found.zone = twod::zone_table(solution, space);
  return found;
}

Found find(const SplitBottom& cell, int elements) {
  auto space = twod::space_of(cell, {elements});
  return find(cell, space);
}

std::string command(const SplitBottom& cell, int elements) {
  return "./run split-bottom --height " + io::rounded(cell.height) +
         (cell.rate == SplitBottom{}.rate ? "" : " --rate " + io::rounded(cell.rate)) +
         " --elements " + std::to_string(elements);
}

// Every so many rows: marks that do not hide a line.
std::vector<double> numbers(const io::Table& table, std::size_t column, std::size_t step = 1) {
  std::vector<double> values;
  for (std::size_t i = 0; i < table.rows.size(); i += step)
    values.push_back(io::number_in(table.rows[i][column]));
  return values;
}

// What the errors of two meshes, one twice as fine, leave if they fall with the first order.
double extrapolated(double coarse, double fine) {
  return 2 * fine - coarse;
}

void follow_the_meshes(Chapter& chapter, const Context& context) {
  const std::vector<double> heights =
      context.full ? std::vector<double>{0.2, 0.5, 0.6, 0.7} : std::vector<double>{0.2, 0.5, 0.7};
  const std::vector<int> meshes =
      context.full ? std::vector<int>{20, 40, 80, 160} : std::vector<int>{20, 40, 80};
  io::Panel torque{"torque", "elements along Rs", "T / T(curve) - 1", true, true, {}};
  io::Panel zones{"shear zones", "r / Rs", "z / Rs", false, false, {}};
  io::Table table{
      "The zone on ever finer meshes, and the curve of least resistance",
      {"H/Rs", "elements along Rs", "Rc/Rs", "torque integral", "factorisations", "CPU s"},
      {}};
  Range counts, apart;
  for (const double height : heights) {
    const SplitBottom cell{.height = height};
    const twod::ZoneCurve curve = twod::least_resistance(height);
    const std::string label = "H/Rs = " + io::rounded(height);
    io::Curve errors{label, {}, {}};
    std::vector<Found> all;
    for (const int elements : meshes) {
      all.push_back(find(cell, elements));
      const Found& found = all.back();
      counts.add(found.factorisations);
      errors.x.push_back(elements);
      errors.y.push_back(found.torque / curve.integral - 1);
      errors.commands.push_back(command(cell, elements));
      table.rows.push_back({io::rounded(height), std::to_string(elements),
                            io::rounded(found.radius, 7), io::rounded(found.torque, 7),
                            std::to_string(found.factorisations), io::rounded(found.seconds, 3)});
      context.progress(static_cast<double>(table.rows.size()) /
                       static_cast<double>(heights.size() * meshes.size() + 8));
    }
    table.rows.push_back({io::rounded(height), "the curve", io::rounded(curve.surface_radius, 7),
                          io::rounded(curve.integral, 7), "", ""});
    torque.curves.push_back(errors);
    const std::size_t step = std::max<std::size_t>(1, all.back().zone.rows.size() / 12);
    zones.curves.push_back({label, numbers(all.back().zone, 1, step),
                            numbers(all.back().zone, 0, step), io::Style::points});
    zones.curves.push_back({label + ", least resistance", numbers(all.back().zone, 3),
                            numbers(all.back().zone, 0), io::Style::line});
    const Found &fine = all.back(), &coarse = all[all.size() - 2];
    const double radius = extrapolated(coarse.radius, fine.radius);
    apart.add(std::abs(radius - curve.surface_radius));
    // The radius jumps with where nodes lie: a fraction of an element of the finest mesh.
    const double room = context.full ? 3e-4 : 1.5e-3, torque_room = context.full ? 1e-3 : 3e-3;
    chapter.check(Kind::exact, label + ": radius of the zone at the surface, extrapolated", radius,
                  curve.surface_radius - room, curve.surface_radius + room);
    chapter.check(Kind::exact, label + ": torque integral, extrapolated, over that of the curve",
                  extrapolated(coarse.torque, fine.torque) / curve.integral, 1 - torque_room,
                  1 + torque_room);
    chapter.check(Kind::self_consistency, label + ": order of the torque",
                  -fitted_order(errors.x, errors.y), 0.75, 1.1);
  }
  chapter.check(Kind::self_consistency, "largest count of factorisations", counts.upper(), 1, 40);
  chapter.answer(
      "Slow flow shears along the curve of least resistance: extrapolated, the zone "
      "leaves the surface within " +
      known(apart.upper(), 1) + " Rs of it, after " + counts.text(2) +
      " factorisations, whatever the mesh.");
  chapter.figure({"zones",
                  "Split-bottom cell at d*Ω = 1e-8 sqrt(g/Rs), interior point (no λr). Left: where "
                  "the material turns with half of the rate, by height, on the finest mesh, and "
                  "the curve of least resistance. Right: how far the torque is from that curve's.",
                  {zones, torque},
                  2});
  chapter.table(std::move(table));
}

// From the open zone, over which the middle rests, to the dome, over which all of the surface
// turns.
void cross_the_transition(Chapter& chapter, const Context& context) {
  constexpr double known_height = 0.7256344;
  const int elements = context.full ? 160 : 80;
  const double room = context.full ? 2e-3 : 6e-3;
  io::Curve turning{"middle of the surface", {}, {}};
  for (const double shift : {-4., -1., 0., 1., 4.}) {
    const SplitBottom cell{.height = known_height + shift * room};
    turning.x.push_back(cell.height);
    turning.y.push_back(find(cell, elements).turning);
    turning.commands.push_back(command(cell, elements));
  }
  chapter.check(Kind::exact,
                "just below the transition the middle of the surface turns with less "
                "than half of the rate",
                turning.y[1], 0, 0.5);
  chapter.check(Kind::exact, "just above it with more", turning.y[3], 0.5, 1 + 1e-6);
  io::Panel panel{"the middle of the surface", "H / Rs", "ω / Ω", false, false, {turning}};
  chapter.figure({"transition",
                  "Where the least resistance jumps from the open zone to a dome, at H/Rs = "
                  "0.72563, both have the same: a mesh finds a mixture of the two.",
                  {panel},
                  1});
}

void turn_faster(Chapter& chapter, const Context& context) {
  const std::vector<int> meshes =
      context.full ? std::vector<int>{40, 80} : std::vector<int>{20, 40};
  io::Panel panel{"width of the zone at the surface", "d*Ω / sqrt(g/Rs)", "W / Rs", true, true, {}};
  for (const int elements : meshes) {
    io::Curve curve{std::to_string(elements) + " elements along Rs", {}, {}};
    for (const double rate : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
      const SplitBottom cell{.rate = rate};
      curve.x.push_back(rate);
      curve.y.push_back(find(cell, elements).width);
      curve.commands.push_back(command(cell, elements));
    }
    panel.curves.push_back(curve);
  }
  const auto &coarse = panel.curves[0].y, &fine = panel.curves[1].y;
  chapter.check(Kind::self_consistency, "at a slow rate the width is the mesh's: halved with it",
                coarse.front() / fine.front(), 1.3, 2.2);
  chapter.check(Kind::self_consistency, "at a fast one it is the law's",
                coarse.back() / fine.back(), 0.95, 1.05);
  chapter.answer(
      "The μ(I) law has no width of its own: slower, the zone thins out until the mesh "
      "holds it, where experiments keep a width of some grains (an honest limit of a "
      "local law).");
  chapter.figure({"width",
                  "Width of the zone at H/Rs = 0.5, interior point, on two meshes. Where they "
                  "agree it is the law's; where they part, the mesh's.",
                  {panel},
                  1});
}

void break_it(Chapter& chapter) {
  const SplitBottom cell;
  auto around_axis = twod::space_of(cell, {20});
  shear::CrossSection<2> straight(around_axis.mesh());
  const Found found = find(cell, straight);
  // Without the weight of the radius the shortest way up is the upright one: a wall at the split.
  chapter.check(Kind::control, "negative control: without the weight of the radius, Rc",
                found.radius, 0.95, 1.05);
}

}  // namespace

void zone_study(Chapter& chapter, const Context& context) {
  follow_the_meshes(chapter, context);
  cross_the_transition(chapter, context);
  turn_faster(chapter, context);
  break_it(chapter);
}

}  // namespace talus::verification
