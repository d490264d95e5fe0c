#include "common/program/flow_picture.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/io/result_folder.hpp"
#include "common/mixed/mixed_test_problems.hpp"
#include "common/solve/extremes.hpp"

BOOST_AUTO_TEST_SUITE(flow_picture_test)
using namespace talus;
using namespace talus::program;

namespace {

// A flow with given velocities at the nodes and no dynamic pressure; the static one is 2.
template <int Dim>
struct Flow {
  mixed::MixedSpace<Dim> space;
  mixed::MixedFlow<Dim> flow;
  typename mixed::MixedFlow<Dim>::State state;

  template <class Velocity>
  Flow(fem::Mesh<Dim> mesh, const Velocity& velocity)
      : space(mesh, free(mesh)), flow(space, {}, mixed::test_load<Dim>(0)), state(space.start()) {
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      const fem::Point<Dim> u = velocity(mesh.nodes[node]);
      for (int i = 0; i < Dim; ++i)
        state.set(space.velocity_index(static_cast<Eigen::Index>(node), i), u[i]);
    }
  }
  Flow(const Flow&) = delete;  // flow refers to space

  static mixed::BoundaryConditions<Dim> free(const fem::Mesh<Dim>& mesh) {
    mixed::BoundaryConditions<Dim> conditions;
    for (const auto& [name, faces] : mesh.boundaries) conditions[name] = {};
    return conditions;
  }
};

fem::Point<2> rotation(const fem::Point<2>& x) {
  return {-x[1], x[0]};
}

fem::Mesh<2> quarter() {
  return fem::annulus_mesh(0.5, 2, 3, 2);
}

const PictureLabels labels{.name = "fields", .title = "a flow", .caption = "a flow"};

io::FieldMap map_of(const Surface& surface, const PictureOptions& options) {
  const io::Figure figure = picture(surface, rheology::FrictionLaw{}, labels, options);
  BOOST_REQUIRE(figure.panels.size() == 1U);
  return *figure.panels[0].field;
}

// The largest distance between the samples and a known field; NaN if there are none.
template <class Known>
double error(const io::FieldMap& map, const Known& known) {
  double largest = map.patches.empty() ? std::nan("") : 0;
  for (const io::FieldPatch& patch : map.patches)
    for (std::size_t k = 0; k < patch.points.size(); ++k)
      largest = std::max(largest,
                         std::abs(patch.values[k] - known(patch.points[k][0], patch.points[k][1])));
  return largest;
}

const auto radius = [](double x, double y) { return std::hypot(x, y); };

}  // namespace

BOOST_AUTO_TEST_CASE(samples_are_exact_between_nodes_on_curved_elements_too) {
  const Flow<2> flow(quarter(), rotation);
  const io::FieldMap map = map_of(surface_of(view_of(flow.flow, flow.state)), {"speed", {}});
  BOOST_TEST(map.patches.size() == 6U);
  BOOST_TEST(map.patches[0].points.size() > 100U);
  BOOST_TEST(error(map, radius) < 1e-13);
  BOOST_TEST(error(map_of(surface_of(view_of(flow.flow, flow.state)), {"pressure", {}}),
                   [](double, double) { return 2; }) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_biquadratic_speed_is_exact_between_nodes) {
  const std::vector<double> x = {0, 0.4, 1};
  const auto speed = [](double a, double b) { return a * a * b * b + b * b + 0.1; };
  const Flow<2> flow(fem::tensor_mesh<2>({x, x}),
                     [&](const fem::Point<2>& p) { return fem::Point<2>(0, speed(p[0], p[1])); });
  BOOST_TEST(error(map_of(surface_of(flow.flow, flow.state), {"speed", {}}), speed) < 1e-13);
}

BOOST_AUTO_TEST_CASE(two_nodes_that_are_swapped_are_noticed) {
  fem::Mesh<2> mesh = quarter();
  std::swap(mesh.elements[1][3], mesh.elements[1][7]);
  const Flow<2> right(quarter(), rotation);
  FlowView<2> view = view_of(right.flow, right.state);
  view.at = [&, whole = view.at](std::size_t e, const fem::Point<2>& reference) {
    FlowSample<2> sample = whole(e, reference);  // what is there, shown where it is not
    sample.position = fem::ElementPoint<2>(mesh, e, reference).position;
    return sample;
  };
  BOOST_TEST(error(map_of(surface_of(view), {"speed", {}}), radius) > 0.01);
}

BOOST_AUTO_TEST_CASE(a_pressure_that_jumps_between_elements_keeps_its_jump) {
  const std::vector<double> x = {0, 1, 2}, y = {0, 1};
  Flow<2> flow(fem::tensor_mesh<2>({x, y}), rotation);
  flow.state.set(flow.space.pressure_index(0, 0), -0.5);
  const io::FieldMap map = map_of(surface_of(flow.flow, flow.state), {"pressure", {}});
  BOOST_REQUIRE(map.patches.size() == 2U);
  for (const double value : map.patches[0].values) BOOST_TEST(value == 1.5);
  for (const double value : map.patches[1].values) BOOST_TEST(value == 2.0);
}

BOOST_AUTO_TEST_CASE(the_streamlines_of_a_rotation_are_circles) {
  const Flow<2> flow(quarter(), rotation);
  const io::FieldMap map = map_of(surface_of(flow.flow, flow.state), {"regions", {}});
  BOOST_TEST(map.streamlines.size() >= 20U);
  for (const io::Polyline& line : map.streamlines) {
    BOOST_TEST(line.size() > 20U);
    for (const io::PlanePoint& point : line)
      BOOST_TEST(std::abs(radius(point[0], point[1]) - radius(line[0][0], line[0][1])) < 2e-3);
  }
  BOOST_TEST(
      map_of(surface_of(view_of(flow.flow, flow.state)), {"regions", {}}).streamlines.empty());
}

BOOST_AUTO_TEST_CASE(a_mirror_image_is_the_other_half) {
  const Flow<2> flow(quarter(), rotation);
  Surface surface = surface_of(flow.flow, flow.state);
  surface.is_mirrored = true;
  const io::FieldMap map = map_of(surface, {"speed", {}});
  BOOST_TEST(map.patches.size() == 12U);
  BOOST_TEST(error(map, radius) < 1e-13);
  const io::Window window = io::window_of(map);
  BOOST_TEST(window.low[0] == -window.high[0]);
}

BOOST_AUTO_TEST_CASE(a_window_shows_the_elements_in_it_and_samples_them_more_finely) {
  const Flow<2> flow(fem::annulus_mesh(0.5, 2, 6, 4), rotation);
  const Surface surface = surface_of(flow.flow, flow.state);
  const io::FieldMap whole = map_of(surface, {"speed", {}});
  const io::FieldMap part = map_of(surface, {"speed", "0.5,0,0.7,0.1"});
  BOOST_TEST(part.patches.size() == 1U);
  BOOST_TEST(part.patches[0].points.size() > whole.patches[0].points.size());
}

BOOST_AUTO_TEST_CASE(a_cut_shows_space_where_it_is_in_a_side_and_inside_elements) {
  const std::vector<double> x = {0, 1, 3}, y = {0, 0.5, 1};
  const Flow<3> flow(fem::box_mesh(x, y, y),
                     [](const fem::Point<3>& p) { return fem::Point<3>(p[0] * p[0] + 1, 0, 0); });
  const auto view = view_of(flow.flow, flow.state);
  for (const double at : {0., 0.3, 1., 2., 3.}) {
    const Surface cut = cut_of(view, 0, at);
    BOOST_TEST(cut.count == 4U);
    BOOST_TEST(error(map_of(cut, {"speed", {}}), [&](double, double) { return at * at + 1; }) <
               1e-12);
  }
  BOOST_TEST(cut_of(view, 0, 3.1).count == 0U);
  BOOST_TEST(error(map_of(cut_of(view, 1, 0.5), {"speed", {}}),
                   [](double a, double) { return a * a + 1; }) < 1e-12);
  const Flow<3> curved(mixed::awkward_mesh3(), [](const fem::Point<3>& p) { return p; });
  BOOST_CHECK_THROW(map_of(cut_of(view_of(curved.flow, curved.state), 0, 0.5), {"speed", {}}),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(neighbours_have_the_same_points_on_the_side_they_share) {
  const std::vector<double> x = {0, 0.05, 1}, y = {0, 0.3, 0.4};
  const Flow<2> flow(fem::tensor_mesh<2>({x, y}), rotation);
  const io::FieldMap map = map_of(surface_of(flow.flow, flow.state), {"speed", {}});
  BOOST_REQUIRE(map.patches.size() == 4U);
  BOOST_TEST(map.patches[0].columns < map.patches[1].columns);
  BOOST_TEST(map.patches[0].rows() == map.patches[1].rows());
  BOOST_TEST(map.patches[0].columns == map.patches[2].columns);
  // So that nothing is left of the sides between them.
  BOOST_TEST(io::area_of_all(map.patches, io::window_of(map)).size() == 1U);
}

BOOST_AUTO_TEST_CASE(a_free_surface_shows_the_law_beside_it) {
  const std::vector<double> x = {0, 1};
  Flow<2> flow(fem::tensor_mesh<2>({x, x}),
               [](const fem::Point<2>& p) { return fem::Point<2>(p[1], 0); });
  const fem::Point<2> top(0.5, 1);  // the static pressure is 2: it falls from 4 to 0 there
  flow.state.set(flow.space.pressure_index(0, 2),
                 -2 / flow.space.pressure_basis(0, fem::Point<2>(0, 1), top)[2]);
  const auto view = view_of(flow.flow, flow.state);
  BOOST_TEST(view.at(0, fem::Point<2>(0, 1)).law.inertial_number > 1000);
  const Surface surface = surface_of(view);
  const io::FieldMap inertial_number = map_of(surface, {"inertial-number", {}});
  for (const double value : inertial_number.patches[0].values) BOOST_TEST(value < 5);
  BOOST_TEST(error(map_of(surface, {"pressure", {}}), [](double, double y) { return 4 - 4 * y; }) <
             1e-12);
}

BOOST_AUTO_TEST_CASE(what_yields_is_told_from_what_does_not) {
  const std::vector<double> x = {0, 1, 2}, y = {0, 1};
  const Flow<2> flow(fem::tensor_mesh<2>({x, y}), [](const fem::Point<2>& p) {
    return fem::Point<2>(0, p[0] <= 1 ? 0 : 10 * (p[0] - 1));
  });
  const io::FieldMap map = map_of(surface_of(flow.flow, flow.state), {"regions", {}});
  BOOST_REQUIRE(map.regions.size() >= 2U);
  BOOST_TEST(map.regions[1].label == "yielded");
  for (const double value : map.regions[1].patches[0].values) BOOST_TEST(value < 0);
  for (const double value : map.regions[1].patches[1].values) BOOST_TEST(value > 0);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_drawn_is_refused_in_a_line) {
  const auto complaint = [](std::vector<std::string> arguments, bool plots) {
    io::CommandLine line("a program", "program");
    PictureOptions options;
    add_pictures(line, options);
    arguments.insert(arguments.begin(), "program");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    std::string text;
    line.run(static_cast<int>(argv.size()), argv.data(), [&] {
      try {
        check_pictures(line, options, plots);
      } catch (const io::UserError& error) {
        text = error.what();
      }
      return 0;
    });
    return text;
  };
  BOOST_TEST(complaint({"--fields", "speed,mesh", "--window", "0,0,1,1"}, true).empty());
  BOOST_TEST(complaint({"--fields", "speed"}, false).find("--plot") != std::string::npos);
  BOOST_TEST(complaint({"--fields", "speeed"}, true).find("did you mean speed?") !=
             std::string::npos);
  BOOST_TEST(complaint({"--fields", "mesh"}, true).find("--fields") == 0U);
  for (const std::string window : {"0,0,1", "1,0,0,1", "0,1,1,1", "0,0,1,1,2", "0,0,1,x", ",,,"})
    BOOST_TEST(complaint({"--window", window}, true).find("--window") == 0U, window);
}

BOOST_AUTO_TEST_SUITE_END()
