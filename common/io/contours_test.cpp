#include "common/io/contours.hpp"

#include <cmath>
#include <limits>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(contours_test)

using namespace talus::io;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A patch of cells x cells on [left, left + 1] x [0, 1].
template <class Field>
FieldPatch patch_at(double left, std::size_t cells, const Field& field) {
  FieldPatch patch{cells + 1, {}, {}};
  for (std::size_t j = 0; j <= cells; ++j)
    for (std::size_t i = 0; i <= cells; ++i) {
      const double x = left + static_cast<double>(i) / static_cast<double>(cells);
      const double y = static_cast<double>(j) / static_cast<double>(cells);
      patch.points.push_back({x, y});
      patch.values.push_back(field(x, y));
    }
  return patch;
}

double total_area(const std::vector<Polyline>& outlines) {
  double area = 0;
  for (const Polyline& outline : outlines) area += area_of(outline);
  return area;
}

std::size_t lines(const std::vector<FieldPatch>& patches, double level) {
  return isolines(patches, level, box_of(patches)).size();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_band_across_patches_is_one_outline_of_the_right_area) {
  const auto field = [](double x, double) { return x; };
  const std::vector<FieldPatch> patches = {patch_at(0, 4, field), patch_at(1, 4, field)};
  const auto outlines = area_between(patches, 0.3, 1.6, box_of(patches));
  BOOST_TEST(outlines.size() == 1U);
  BOOST_TEST(outlines[0].size() == 4U);  // points on straight sides are left out
  BOOST_TEST(std::abs(total_area(outlines) - 1.3) < 1e-12);
  BOOST_TEST(std::abs(total_area(area_of_all(patches, box_of(patches))) - 2) < 1e-12);
}

BOOST_AUTO_TEST_CASE(bands_leave_no_gap_and_do_not_overlap) {
  const auto field = [](double x, double y) { return std::sin(7 * x) * std::cos(5 * y) + x; };
  const std::vector<FieldPatch> patches = {patch_at(0, 9, field), patch_at(1, 9, field)};
  double sum = 0;
  for (int k = -5; k < 15; ++k) {
    const double area = total_area(area_between(patches, 0.2 * k, 0.2 * (k + 1), box_of(patches)));
    BOOST_TEST(area >= 0);
    sum += area;
  }
  BOOST_TEST(std::abs(sum - 2) < 0.02);  // a saddle's middle may belong to two
}

BOOST_AUTO_TEST_CASE(a_hole_is_cut_out_of_the_area_and_of_the_polygon) {
  const auto radius = [](double x, double y) { return std::hypot(x - 0.5, y - 0.5); };
  const std::vector<FieldPatch> patches = {patch_at(0, 40, radius)};
  const auto outlines = area_between(patches, 0.2, 0.4, box_of(patches));
  BOOST_TEST(outlines.size() == 2U);
  const double ring = std::acos(-1.) * (0.4 * 0.4 - 0.2 * 0.2);
  BOOST_TEST(std::abs(total_area(outlines) / ring - 1) < 0.01);
  BOOST_TEST(std::abs(area_of(joined(outlines)) - total_area(outlines)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_jump_between_patches_stays_a_jump) {
  const std::vector<FieldPatch> patches = {patch_at(0, 2, [](double, double) { return 0.; }),
                                           patch_at(1, 2, [](double, double) { return 1.; })};
  BOOST_TEST(std::abs(total_area(area_between(patches, 0.5, 2, box_of(patches))) - 1) < 1e-12);
  BOOST_TEST(area_between(patches, 0.25, 0.75, box_of(patches)).empty());
  BOOST_TEST(lines(patches, 0.5) == 0U);
}

BOOST_AUTO_TEST_CASE(what_is_not_a_number_has_no_colour_and_no_line) {
  FieldPatch patch = patch_at(0, 4, [](double x, double) { return x; });
  patch.values[6] = std::nan("");  // a corner of four cells
  const std::vector<FieldPatch> patches = {patch};
  BOOST_TEST(std::abs(total_area(area_without_number(patches, box_of(patches))) - 0.25) < 1e-12);
  BOOST_TEST(std::abs(total_area(area_between(patches, -infinity, infinity, box_of(patches))) -
                      0.75) < 1e-12);
  for (const Polyline& line : isolines(patches, 0.3, box_of(patches)))
    for (const PlanePoint& point : line) BOOST_TEST(point[1] >= 0.5);
}

BOOST_AUTO_TEST_CASE(isolines_lie_on_their_level_and_close) {
  const auto square = [](double x, double y) { return std::hypot(x - 1, y - 0.5); };
  const std::vector<FieldPatch> patches = {patch_at(0, 20, square), patch_at(1, 20, square)};
  const auto circle = isolines(patches, 0.3, box_of(patches));
  BOOST_REQUIRE(circle.size() == 1U);  // over both patches
  BOOST_TEST((circle[0].front() == circle[0].back()));
  for (const PlanePoint& point : circle[0])
    BOOST_TEST(std::abs(square(point[0], point[1]) - 0.3) < 2e-3);
  BOOST_TEST(lines(patches, 0.45) == 1U);
  BOOST_TEST(lines(patches, 0.7) == 2U);  // cut off above and below
  BOOST_TEST(lines(patches, 2) == 0U);
}

BOOST_AUTO_TEST_CASE(around_a_saddle_isolines_do_not_cross) {
  const std::vector<FieldPatch> patches = {
      patch_at(0, 1, [](double x, double y) { return (x - 0.5) * (y - 0.5); })};
  for (const double level : {-0.01, 0.01}) {
    const auto pair = isolines(patches, level, box_of(patches));
    BOOST_REQUIRE(pair.size() == 2U);
    for (const Polyline& line : pair)
      for (const PlanePoint& point : line)  // each in a quarter of its own
        BOOST_TEST((line.front()[0] - 0.5) * (point[0] - 0.5) >= 0);
  }
}

BOOST_AUTO_TEST_CASE(what_is_outside_the_window_is_cut_off) {
  const std::vector<FieldPatch> patches = {patch_at(0, 3, [](double x, double) { return x; })};
  const Window window{{0.1, 0.2}, {0.8, 0.6}};
  BOOST_TEST(std::abs(total_area(area_of_all(patches, window)) - 0.7 * 0.4) < 1e-12);
  BOOST_TEST(std::abs(total_area(area_between(patches, 0.5, 2, window)) - 0.3 * 0.4) < 1e-12);
  const auto line = isolines(patches, 0.5, window);
  BOOST_REQUIRE(line.size() == 1U);
  BOOST_TEST(std::abs(line[0].front()[1] - line[0].back()[1]) == 0.4,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(isolines(patches, 0.9, window).empty());
}

BOOST_AUTO_TEST_CASE(a_mirrored_patch_has_the_same_area) {
  FieldPatch patch = patch_at(0, 5, [](double x, double y) { return x + y; });
  const std::vector<FieldPatch> once = {patch};
  for (PlanePoint& point : patch.points) point[0] = -point[0];
  const std::vector<FieldPatch> both = {once[0], patch};
  const double area = total_area(area_between(once, 0.4, 1.1, box_of(once)));
  BOOST_TEST(area > 0);
  BOOST_TEST(std::abs(total_area(area_between(both, 0.4, 1.1, box_of(both))) - 2 * area) < 1e-9);
}

BOOST_AUTO_TEST_CASE(two_points_that_are_swapped_are_noticed) {
  FieldPatch patch = patch_at(0, 4, [](double x, double) { return x; });
  std::swap(patch.points[6], patch.points[8]);
  const std::vector<FieldPatch> patches = {patch};
  BOOST_TEST(std::abs(total_area(area_between(patches, 0.3, 0.6, box_of(patches))) - 0.3) > 0.01);
}

BOOST_AUTO_TEST_SUITE_END()
