#include "common/program/work.hpp"

#include <cmath>
#include <iostream>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "common/io/result_folder.hpp"
#include "common/mixed/mixed_flow.hpp"
#include "common/shear/cross_section.hpp"
#include "common/solve/memory.hpp"
#include "common/solve/nested_dissection.hpp"

BOOST_AUTO_TEST_SUITE(work_test)

using namespace talus;
using namespace talus::program;

namespace {

std::vector<double> line(int elements) {
  std::vector<double> boundaries;
  for (int i = 0; i <= elements; ++i) boundaries.push_back(i);
  return boundaries;
}

// Entries of the factors of a cross-section of elements: those there are, over those estimated.
double section_ratio(int across, int up) {
  const shear::CrossSection<2> space(fem::rectangle_mesh(
      line(across), line(up), [](const Eigen::Vector2d& x) { return x[1] == 0; }));
  return space.factor_entries() / solve::nested_dissection({across, up, 0}, 1).entries;
}

// The same of velocity-pressure flow, all sides but one free.
template <int Dim>
double mixed_ratio(const std::array<int, 3>& elements) {
  fem::Mesh<Dim> mesh = [&] {
    if constexpr (Dim == 2)
      return fem::tensor_mesh<2>({line(elements[0]), line(elements[1])});
    else
      return fem::box_mesh(line(elements[0]), line(elements[1]), line(elements[2]));
  }();
  mixed::BoundaryConditions<Dim> conditions;
  for (const auto& [name, faces] : mesh.boundaries) conditions[name] = {};
  conditions["bottom"] = mixed::no_slip<Dim>();
  const mixed::MixedSpace<Dim> space(std::move(mesh), conditions);
  mixed::MixedFlow<Dim> problem(
      space, {{}, rheology::ChauchatMedale{}, 1e-2},
      {[](const auto&) { return 1.0; }, [](const auto&) { return fem::Point<Dim>::Ones(); }});
  problem.evaluate(space.start());
  typename mixed::MixedFlow<Dim>::State x;
  BOOST_REQUIRE(problem.linear_solve(Eigen::VectorXd::Zero(space.size()), x));
  return problem.system().factor_entries() / (2 * solve::nested_dissection(elements, Dim).entries);
}

Task square(double share, double bytes, double seconds) {
  const int side = std::max(1, static_cast<int>(share * 1000));
  const double size = side * side / 1e6;
  return {std::to_string(side), {bytes * size, seconds * size}};
}

struct Outcome {
  std::string refusal, announcement;
};

Outcome outcome_of(double bytes, double seconds) {
  Outcome outcome;
  std::ostringstream captured;
  std::streambuf* const before = std::cerr.rdbuf(captured.rdbuf());
  try {
    admit("heap", "--elements", [&](double share) { return square(share, bytes, seconds); });
  } catch (const io::UserError& error) {
    outcome.refusal = error.what();
  }
  std::cerr.rdbuf(before);
  outcome.announcement = captured.str();
  return outcome;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(factors_are_as_large_as_estimated_to_a_third) {
  const auto is_near = [](double ratio, const char* what) {
    BOOST_TEST(ratio > 1 / 1.35, what << ": " << ratio);
    BOOST_TEST(ratio < 1.35, what << ": " << ratio);
  };
  is_near(section_ratio(20, 28), "20x28");
  is_near(section_ratio(70, 100), "70x100");
  is_near(section_ratio(12, 200), "12x200");
  is_near(mixed_ratio<2>({24, 32, 0}), "plane");
  is_near(mixed_ratio<3>({1, 14, 20}), "layer");
  is_near(mixed_ratio<3>({5, 5, 5}), "cube");
  BOOST_TEST(section_ratio(70, 100) / section_ratio(20, 28) < 1.3);  // the growth is right too
}

BOOST_AUTO_TEST_CASE(a_cube_costs_more_than_a_layer_of_as_many_elements) {
  const Work layer = mixed_work({1, 50, 160}, 3, 1), cube = mixed_work({20, 20, 20}, 3, 1);
  BOOST_TEST(cube.bytes > 2 * layer.bytes);
  BOOST_TEST(cube.seconds > 5 * layer.seconds);
  BOOST_TEST(mixed_work({20, 20, 20}, 3, 7).seconds == 7 * cube.seconds);
}

BOOST_AUTO_TEST_CASE(nothing_overflows_however_much_is_asked_for) {
  BOOST_TEST(section_work({100000, 100000}, true, 30).bytes > 9e13);
  BOOST_TEST(mixed_work({100000, 100000, 100000}, 3, 30).bytes > 6e19);
}

BOOST_AUTO_TEST_CASE(what_fits_and_is_quick_begins_without_a_word) {
  const Outcome outcome = outcome_of(1e6, 10);
  BOOST_TEST((outcome.refusal.empty() && outcome.announcement.empty()));
}

BOOST_AUTO_TEST_CASE(what_is_long_or_large_is_announced) {
  const Outcome is_long = outcome_of(1e6, 3 * 3600);
  BOOST_TEST(is_long.refusal.empty());
  BOOST_TEST(says(is_long.announcement, "heap: --elements: '1000' will take about"));
  BOOST_TEST(says(is_long.announcement, "3 hours"));
  const Outcome is_large = outcome_of(0.7 * solve::available_memory(), 10);
  BOOST_TEST(is_large.refusal.empty());
  BOOST_TEST(says(is_large.announcement, "GB are available"));
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused_with_the_largest_size_that_would) {
  const std::string refusal = outcome_of(16 * solve::available_memory(), 10).refusal;
  BOOST_TEST(says(refusal, "--elements: '1000' needs about"));
  const std::size_t end = refusal.find(" would fit");
  BOOST_REQUIRE(end != std::string::npos);
  const int side = std::stoi(refusal.substr(refusal.find("available; ") + 11));
  BOOST_TEST(side > 165);  // half of what is there is 177; memory comes and goes meanwhile
  BOOST_TEST(side < 190);
  BOOST_TEST(says(outcome_of(1e30, 10).refusal, "nothing of this kind fits"));
  BOOST_TEST(says(outcome_of(std::nan(""), 10).refusal, "needs about"));
}

// 24 factorisations of the heap's 70x100 take 1.8 s by interior points (docs/heap.md), and memory
// the size of the factors: the guess is of that order.
BOOST_AUTO_TEST_CASE(the_interior_point_of_a_section_costs_what_was_measured) {
  const Work work = section_work({70, 100}, true, 24);
  BOOST_TEST(work.seconds > 0.6);
  BOOST_TEST(work.seconds < 5);
  BOOST_TEST(work.bytes > section_work({70, 100}, false, 24).bytes);
  BOOST_TEST(work.seconds < 2 * section_work({70, 100}, false, 24).seconds);
}

BOOST_AUTO_TEST_SUITE_END()
