// What is measured of the flow around the cylinder, on a flow put in by hand: u = (0, G x), p = P.
// Its shear rate is G, its total pressure 1 + P, everywhere.
#include <cmath>
#include <numbers>

#include <boost/test/unit_test.hpp>

#include "twod/cylinder_report.hpp"
#include "twod/cylinder_test_problems.hpp"

BOOST_AUTO_TEST_SUITE(cylinder_measures_test)

using namespace talus;
using namespace talus::twod;
using boost::test_tools::tolerance;
using State = CylinderFlow::State;

namespace {

struct Uniform {
  Cylinder scene;
  CylinderFlow cylinder;
  State state;
  double shear_rate, pressure;

  Uniform(double rate, double dynamic_pressure, int around = 8)
      : scene(cylinder_of(around)), cylinder(scene), shear_rate(rate), pressure(dynamic_pressure) {
    const auto& space = cylinder.space();
    Eigen::VectorXd value = Eigen::VectorXd::Zero(space.size());
    for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node)
      value[space.velocity_index(static_cast<Eigen::Index>(node), 1)] =
          rate * space.mesh().nodes[node][0];
    for (std::size_t e = 0; e < space.element_count(); ++e)
      value[space.pressure_index(e, 0)] = dynamic_pressure;
    state = State(solve::CompensatedVector(value));
  }
  double viscosity() const {
    return cylinder.flow().rheology().evaluate(shear_rate, 1 + pressure).eta;
  }
  CylinderMeasures measures() { return measure(cylinder, state); }
};

double column(const io::Table& table, std::size_t row, const std::string& name) {
  const auto found = std::ranges::find(table.header, name);
  BOOST_REQUIRE(found != table.header.end());
  return io::number_in(table.rows[row][static_cast<std::size_t>(found - table.header.begin())]);
}

const io::Field& field(const io::QuadraticGrid& grid, const std::string& name) {
  const auto found = std::ranges::find(grid.cell_fields, name, &io::Field::name);
  BOOST_REQUIRE(found != grid.cell_fields.end());
  return *found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(pressures_and_velocities_have_their_own_extremes) {
  Uniform flow(0.2, -7);  // |p| is larger than any velocity
  const CylinderMeasures m = flow.measures();
  BOOST_TEST(m.min_pressure == -6.0, tolerance(1e-13));
  BOOST_TEST(m.max_pressure == -6.0, tolerance(1e-13));
  BOOST_TEST(m.largest_velocity == 0.2 * flow.scene.mesh.half_width, tolerance(1e-13));
  // The flux through the inlet, over its width: the mean of -G x over half of it.
  BOOST_TEST(m.mean_velocity == -0.1 * flow.scene.mesh.half_width, tolerance(1e-12));
  BOOST_TEST(m.divergence < 1e-13);
}

// What a moving material brings: of u = (0, G (z + c)) the integral of -u·∇w is -G² times that of z
// + c, over the whole channel, whose middle is at z = 0.
BOOST_AUTO_TEST_CASE(the_flux_of_momentum_is_that_of_a_flow_put_in_by_hand) {
  Uniform flow(0, 0);
  const auto& space = flow.cylinder.space();
  const double G = 0.3, c = 40;
  Eigen::VectorXd value = flow.state.value();
  for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node)
    value[space.velocity_index(static_cast<Eigen::Index>(node), 1)] =
        G * (space.mesh().nodes[node][1] + c);
  flow.state = State(solve::CompensatedVector(value));
  const CylinderMeasures m = flow.measures();
  const double area = m.weight / m.loading;
  BOOST_TEST(m.momentum_flux == -G * G * c * area, tolerance(1e-10));
  Cylinder still = flow.scene;
  still.inertia = false;
  CylinderFlow without(still);
  BOOST_TEST(measure(without, flow.state).momentum_flux == 0.0);
}

BOOST_AUTO_TEST_CASE(shares_count_what_yields_what_is_ill_posed_and_what_is_pulled) {
  const auto shares = [](double rate, double pressure) {
    const CylinderMeasures m = Uniform(rate, pressure).measures();
    return std::array{m.yielded_share, m.ill_posed_share, m.negative_share};
  };
  const std::array at_rest{0.0, 0.0, 0.0}, slow{1.0, 1.0, 0.0}, quick{1.0, 0.0, 0.0};
  BOOST_TEST(shares(1e-9, 0) == at_rest, boost::test_tools::per_element());  // though C > 0 there
  BOOST_TEST(shares(1e-2, 0) == slow, boost::test_tools::per_element());
  const rheology::FrictionLaw law = cylinder_of(8).law;
  const double best = law.best_posed() * law.reference_shear_rate(1) / law.I0;
  const bool has_well_posed = law.well_posedness(law.best_posed()) < 0;
  BOOST_REQUIRE(has_well_posed);
  BOOST_TEST(shares(best, 0) == quick, boost::test_tools::per_element());
  BOOST_TEST(shares(1e-2, -2)[2] == 1.0);
}

// The normals are those of the mesh's arcs, of second order.
BOOST_AUTO_TEST_CASE(stresses_on_the_perimeter_are_those_of_the_flow_there) {
  const Uniform flow(0.2, 0.5, 32);
  const io::Table table = perimeter_table(flow.cylinder, flow.state);
  const double shear = flow.viscosity() * flow.shear_rate, total = 1 + flow.pressure;
  double before = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double angle = column(table, row, "angle") * std::numbers::pi / 180;
    // From the downstream end, which is below: n out of the cylinder, t along it to that end.
    const double nx = std::sin(angle), ny = -std::cos(angle), tx = ny, ty = -nx;
    BOOST_TEST(column(table, row, "dynamic_pressure") == flow.pressure, tolerance(1e-12));
    BOOST_TEST(column(table, row, "total_pressure") == total, tolerance(1e-12));
    BOOST_TEST(column(table, row, "normal_stress") == 2 * shear * nx * ny - total, tolerance(1e-3));
    BOOST_TEST(std::abs(column(table, row, "shear_stress") - shear * (tx * ny + ty * nx)) <
               1e-3 * shear);
    BOOST_TEST(angle > before);
    before = angle;
  }
  BOOST_TEST(column(table, 0, "angle") < 20.0);
}

BOOST_AUTO_TEST_CASE(fields_of_the_cylinder_are_what_their_names_say) {
  const Uniform flow(0.2, 0.5);
  const io::QuadraticGrid fields = grid(flow.cylinder, flow.state);
  const double total = 1.5, rate = 0.2, lambda_r = flow.scene.lambda_r;
  const rheology::FrictionLaw& law = flow.scene.law;
  const double yield_part = law.mu_s * std::hypot(total, lambda_r) / std::hypot(rate, lambda_r);
  const std::vector<std::pair<std::string, double>> expected = {
      {"dynamic_pressure", 0.5},
      {"total_pressure", total},
      {"regularised_pressure", total},
      {"shear_rate", rate},
      {"viscosity", flow.viscosity()},
      {"viscosity_static_part", yield_part},
      {"viscosity_dynamic_part", flow.viscosity() - yield_part},
      {"inertial_number", law.inertial_number(rate, total)},
      {"well_posedness", law.well_posedness(law.inertial_number(rate, total))},
      {"yielded", 1}};
  BOOST_TEST(fields.cell_fields.size() == expected.size());
  for (const auto& [name, value] : expected)
    for (const double each : field(fields, name).values)
      BOOST_TEST(std::abs(each - value) <= 1e-9 * std::abs(value), name << " " << each);
  const auto& velocity = fields.point_fields.at(0);
  for (std::size_t node = 0; node < fields.points.size(); ++node) {
    BOOST_TEST(velocity.values[3 * node] == 0.0);
    BOOST_TEST(velocity.values[3 * node + 1] == 0.0);
    BOOST_TEST(velocity.values[3 * node + 2] == rate * fields.points[node][0]);
  }
}

BOOST_AUTO_TEST_CASE(columns_of_the_tables_hold_what_their_names_say) {
  CylinderMeasures m;
  m.loading = 0.05;
  m.lambda_r = 1e-4;
  m.mean_velocity = 0.3;
  m.drag = 5;
  m.min_pressure = -0.1;
  m.ill_posed_share = 0.2;
  m.negative_share = 0.7;
  solve::PathPoint point;
  point.parameter_slope = -2;
  point.step = 0.25;
  point.corrections = 3;
  point.determinant_sign = -1;
  point.is_fold_passed = true;
  point.residual = 1e-13;
  point.cost.failures = 4;
  point.cost.factorisations = 9;
  const io::Table path = path_table({{point, m}});
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, double>>{{"loading", 0.05},
                                                   {"lambda_r", 1e-4},
                                                   {"slope", -2},
                                                   {"step", 0.25},
                                                   {"corrections", 3},
                                                   {"determinant_sign", -1},
                                                   {"fold", 1},
                                                   {"failures", 4},
                                                   {"factorisations", 9},
                                                   {"residual", 1e-13},
                                                   {"drag", 5},
                                                   {"mean_velocity", 0.3},
                                                   {"min_pressure", -0.1},
                                                   {"ill_posed_share", 0.2},
                                                   {"negative_share", 0.7}})
    BOOST_TEST(column(path, 0, name) == value, name);
  // U/sqrt(g(D + d)) with p_ext = 4 φρgD: U sqrt(4)/sqrt(1 + d/D).
  const io::Table sweep = sweep_table({m}, {4});
  BOOST_TEST(column(sweep, 0, "froude_at_p_ext_4") == 0.6 / std::sqrt(1.1), tolerance(1e-14));
  BOOST_TEST(column(sweep, 0, "drag_coefficient_over_p_ext") == 10 / 0.09, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(parameters_of_the_scene_are_under_their_names) {
  Cylinder scene;
  scene.mesh.around = 24;
  scene.mesh.first_layer = 0.03;
  scene.mesh.outlet = 11;
  scene.lambda_r = 1e-4;
  scene.pressure_floor = 0.02;
  scene.inertia = false;
  const nlohmann::json all = as_json(scene);
  BOOST_TEST(all.at("around") == 24);
  BOOST_TEST(all.at("first_layer") == 0.03);
  BOOST_TEST(all.at("outlet") == 11);
  BOOST_TEST(all.at("lambda_r") == 1e-4);
  BOOST_TEST(all.at("pressure_floor") == 0.02);
  BOOST_TEST(all.at("inertia") == false);
  BOOST_TEST(all.at("regularises_pressure") == true);
  BOOST_TEST(all.at("domain") == "half");
}

BOOST_AUTO_TEST_SUITE_END()
