// The heap in three dimensions against its cross-section, and the ways to solve it.
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/mixed/extrusion.hpp"
#include "threed/heap_report.hpp"

BOOST_AUTO_TEST_SUITE(heap_test)

using namespace talus;
using namespace talus::threed;

namespace {

Heap heap_at(double angle, double lambda_r = 1e-5) {
  Heap heap;
  heap.section.angle = angle;
  heap.lambda_r = lambda_r;
  return heap;
}

twod::SectionSolution section_of(const Heap& heap, const HeapMesh& mesh) {
  auto space = twod::space_of(heap.section, mesh.section);
  return twod::solve(heap.section, space, section_options(heap, {}));
}

// Largest difference of the velocities along the stream, relative to the largest.
double apart(const HeapSolution& solution, const twod::SectionSolution& section) {
  return mixed::departure(solution.flow->space(), solution.state, section.velocity, 1).velocity;
}

constexpr HeapMesh small{1, {4, 6}};

}  // namespace

BOOST_AUTO_TEST_CASE(from_rest_it_is_the_cross_section_without_cross_flow_or_dynamic_pressure) {
  for (const HeapMesh& mesh : {small, {2, {3, 4, 2, 2}}})
    for (const double angle : {0.38, 0.42}) {
      const Heap heap = heap_at(angle);
      const HeapSolution solution = threed::solve(heap, mesh, {.start = Start::rest});
      BOOST_TEST(solve::is_success(solution.middle.end));
      BOOST_TEST(apart(solution, section_of(heap, mesh)) < 1e-10);
      BOOST_TEST(solution.change_along < 1e-10);
      BOOST_TEST(solution.cross_flow < 1e-12);
      BOOST_TEST(solution.cross_flow > 0);  // it was solved for, not assumed
      BOOST_TEST(solution.dynamic_pressure < 1e-10);
    }
}

BOOST_AUTO_TEST_CASE(every_law_flows_as_in_the_cross_section) {
  for (const auto& regularisation : rheology::regularisations()) {
    Heap heap = heap_at(0.42, 1e-3);
    heap.regularisation = regularisation;
    const HeapSolution solution = threed::solve(heap, small, {.start = Start::rest});
    BOOST_TEST(solve::is_success(solution.middle.end), rheology::name_of(regularisation));
    BOOST_TEST(apart(solution, section_of(heap, small)) < 1e-10, rheology::name_of(regularisation));
  }
}

BOOST_AUTO_TEST_CASE(a_section_at_another_angle_is_found_to_be_another_flow) {
  const Heap heap = heap_at(0.42);
  const HeapSolution solution = threed::solve(heap, small, {.start = Start::rest});
  BOOST_TEST(apart(solution, section_of(heap_at(0.42 + 1e-8), small)) > 1e-10);
}

BOOST_AUTO_TEST_CASE(the_extruded_section_needs_three_steps_at_most) {
  for (const mixed::Open outlet : {mixed::Open::no, mixed::Open::viscous, mixed::Open::all}) {
    Heap heap = heap_at(0.41);
    heap.open_outlet = outlet;
    const auto section = section_of(heap, small);
    const HeapSolution solution = threed::solve(heap, small, {.start = Start::section}, &section);
    BOOST_TEST(solve::is_success(solution.middle.end));
    BOOST_TEST(solution.middle.iterations() <= 3);
    BOOST_TEST(apart(solution, section) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(a_wrong_section_is_not_taken_for_the_solution) {
  const Heap heap = heap_at(0.41);
  auto section = section_of(heap, small);
  const auto right = section;
  section.velocity = section.velocity.moved(0.01, section.velocity);  // a hundredth too fast
  const HeapSolution solution = threed::solve(heap, small, {.start = Start::section}, &section);
  BOOST_TEST(solve::is_success(solution.middle.end));
  BOOST_TEST(solution.middle.iterations() > 0);
  BOOST_TEST(apart(solution, section) > 5e-3);
  BOOST_TEST(apart(solution, right) < 1e-10);
}

BOOST_AUTO_TEST_CASE(nested_meshes_and_a_carried_stress_save_factorisations_of_the_fine_mesh) {
  const Heap heap = heap_at(0.41);
  const HeapMesh mesh{1, {16, 16}};
  const HeapSolution nested = threed::solve(heap, mesh);
  const HeapSolution rest = threed::solve(heap, mesh, {.start = Start::rest});
  HeapOptions plain{.start = Start::rest, .tangent = shear::TangentTerm::full};
  const HeapSolution own_tangent = threed::solve(heap, mesh, plain);
  BOOST_TEST(nested.meshes.size() == 2U);
  BOOST_TEST(nested.meshes.front().mesh.section.across == 8);
  BOOST_TEST(nested.meshes.back().factorisations < rest.meshes.back().factorisations);
  BOOST_TEST(rest.meshes.back().factorisations < own_tangent.meshes.back().factorisations);
  for (const HeapSolution* each : {&nested, &rest, &own_tangent}) {
    BOOST_TEST(solve::is_success(each->middle.end));
    BOOST_TEST(apart(*each, nested.middle) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(an_open_outlet_is_reached_by_way_of_a_developed_one) {
  for (const mixed::Open outlet : {mixed::Open::viscous, mixed::Open::all}) {
    Heap heap = heap_at(0.41);
    heap.open_outlet = outlet;
    const HeapSolution solution = threed::solve(heap, small);
    BOOST_TEST(solve::is_success(solution.middle.end));
    BOOST_TEST(solution.meshes.size() == 2U);  // the same one twice
    BOOST_TEST((solution.flow->heap().open_outlet == outlet));
    BOOST_TEST(apart(solution, section_of(heap, small)) < 1e-10);
    BOOST_TEST(!solve::is_success(threed::solve(heap, small, {.start = Start::rest}).middle.end));
  }
}

BOOST_AUTO_TEST_CASE(the_section_at_half_the_length_is_measured_as_the_cross_section_is) {
  for (const int along : {1, 2}) {
    const Heap heap = heap_at(0.41);
    const HeapMesh mesh{along, {6, 8}};
    auto space = twod::space_of(heap.section, mesh.section);
    const auto section = section_of(heap, mesh);
    const HeapSolution solution = threed::solve(heap, mesh, {.start = Start::rest});
    BOOST_TEST(twod::flow_rate(solution.middle, space) == twod::flow_rate(section, space),
               boost::test_tools::tolerance(1e-10));
    BOOST_TEST(solution.middle.stress.size() == section.stress.size());
    for (std::size_t k = 0; k < section.stress.size(); ++k)
      BOOST_TEST(std::abs(solution.middle.stress[k] - section.stress[k]) < 1e-8);
    const auto json = summary(solution, space);
    BOOST_TEST(json.at("results").at("cross_flow").get<double>() == solution.cross_flow);
    BOOST_TEST(json.at("meshes").size() == 1U);
  }
}

BOOST_AUTO_TEST_CASE(positions_are_found_in_their_elements) {
  const Heap heap = heap_at(0.41);
  HeapFlow flow(heap, {2, {5, 6, 2, 3}});
  const auto& space = flow.space();
  auto state = space.start();
  const auto field = [](const fem::Point<3>& x) { return x[0] * x[1] + x[2] * x[2]; };
  for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node)
    state.set(space.velocity_index(static_cast<Eigen::Index>(node), 1),
              field(space.mesh().nodes[node]));
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<3>(2)) {
      const auto here = flow.point_at(state, e, point.position);
      const auto found = flow.point_at(state, here.values.position);
      BOOST_TEST(found.values.velocity[1] == field(here.values.position),
                 boost::test_tools::tolerance(1e-11));
      BOOST_TEST((found.values.velocity_gradient - here.values.velocity_gradient).norm() < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(the_grid_lists_hexahedra_of_27_nodes_with_all_fields) {
  const HeapSolution solution =
      threed::solve(heap_at(0.41, 1e-3), {1, {2, 3}}, {.start = Start::rest});
  const io::Grid<3> cells = grid(solution);
  BOOST_TEST(cells.cells.size() == 6U);
  BOOST_TEST(cells.points.size() == 3U * 5 * 7);
  BOOST_TEST(cells.point_fields.front().values.size() == 3 * cells.points.size());
  const std::string vtu = io::to_vtu(cells);
  for (const char* text : {"\n29\n", "velocity", "dynamic_pressure", "stress_over_yield_stress"})
    BOOST_TEST(vtu.find(text) != std::string::npos, text);
}

// At rest in the middle of an element the pressure is that of the depth; what else a cell holds
// follows from the point values.
BOOST_AUTO_TEST_CASE(fields_are_what_their_names_say) {
  const Heap heap = heap_at(0.42);
  const HeapSolution solution = threed::solve(heap, small, {.start = Start::rest});
  const io::Grid<3> fields = grid(solution);
  const auto values = [&](const std::string& name) {
    const auto found = std::ranges::find(fields.cell_fields, name, &io::Field::name);
    BOOST_REQUIRE(found != fields.cell_fields.end());
    return found->values;
  };
  const auto& mesh = solution.flow->space().mesh();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double depth = 0;
    for (const auto node : mesh.elements[e])
      depth += (heap.section.height - mesh.nodes[static_cast<std::size_t>(node)][2]) / 27;
    const double pressure = depth * std::cos(0.42);
    BOOST_TEST(values("pressure")[e] == pressure, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(std::abs(values("dynamic_pressure")[e]) < 1e-8);
    BOOST_TEST(values("stress_over_yield_stress")[e] ==
                   values("stress")[e] / (heap.section.law.mu_s * pressure),
               boost::test_tools::tolerance(1e-10));
    BOOST_TEST(values("inertial_number")[e] ==
                   heap.section.law.inertial_number(values("shear_rate")[e], pressure),
               boost::test_tools::tolerance(1e-10));
  }
  auto section_space = twod::space_of(heap.section, small.section);
  const nlohmann::json all = summary(solution, section_space);
  BOOST_TEST(all.at("unknowns") == solution.flow->space().size());
}

BOOST_AUTO_TEST_CASE(coarse_meshes_are_not_solved_further_than_a_start_needs) {
  const Heap heap = heap_at(0.41);
  const HeapMesh fine{1, {18, 25}};
  const HeapSolution nested = threed::solve(heap, fine, {.start = Start::nested});
  BOOST_TEST_REQUIRE(nested.meshes.size() >= 2u);
  const MeshCost& start = nested.meshes.front();
  const HeapSolution to_the_end = threed::solve(heap, start.mesh, {.start = Start::rest});
  BOOST_TEST(start.factorisations < to_the_end.meshes.back().factorisations);
}

BOOST_AUTO_TEST_SUITE_END()
