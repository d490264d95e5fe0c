// What is measured of a section, on fields put in by hand whose measures are known in closed form.
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/shear/load_capacity.hpp"
#include "twod/section_report.hpp"

BOOST_AUTO_TEST_SUITE(section_measures_test)

using namespace talus;
using namespace talus::twod;
using boost::test_tools::tolerance;

namespace {

const SectionMesh mesh{4, 10};

Section slipping() {
  Section section;
  section.wall = Wall::friction;
  return section;
}

// Velocity `speed` of (y, z), stress a share of μs p that depends on (y, z).
template <class Speed, class Share>
SectionSolution made_up(const Section& section, const shear::CrossSection<2>& space, Speed&& speed,
                        Share&& share) {
  SectionSolution solution;
  solution.section = section;
  solution.end = solve::End::converged;
  solution.newton.newton.history.emplace_back();
  Eigen::VectorXd velocity(space.node_count());
  for (Eigen::Index i = 0; i < velocity.size(); ++i)
    velocity[i] = speed(space.mesh().nodes[static_cast<std::size_t>(i)]);
  solution.velocity = solve::CompensatedVector(velocity);
  for (const auto& point : space.points()) {
    solution.stress.push_back(share(point) * section.law.mu_s *
                              load_of(section).pressure(point.position));
    solution.shear_rate.push_back(0.01);
  }
  return solution;
}

double linear(const Eigen::Vector2d& x) {
  return 3 * x[1] / Section{}.height;
}

double resting(const shear::CrossSection<2>::Point&) {
  return 0.5;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_velocity_linear_in_depth_has_its_depths_and_its_flow_rate) {
  const Section section = slipping();
  const auto space = space_of(section, mesh);
  const auto solution = made_up(section, space, linear, resting);
  const SurfaceProfile surface = surface_profile(solution, space);
  for (std::size_t i = 0; i < surface.y.size(); ++i) {
    BOOST_TEST(surface.velocity[i] == 3.0, tolerance(1e-14));
    BOOST_TEST(surface.depth_1[i] == 0.99 * section.height, tolerance(1e-12));
    BOOST_TEST(surface.depth_5[i] == 0.95 * section.height, tolerance(1e-12));
  }
  BOOST_TEST(flow_rate(solution, space) == 1.5 * section.height, tolerance(1e-13));
  const auto results = summary(solution, space).at("results");
  BOOST_TEST(results.at("depth_1_percent").get<double>() == surface.depth_1.front());
  BOOST_TEST(results.at("depth_5_percent").get<double>() == surface.depth_5.front());
  BOOST_TEST(results.at("flow_rate").get<double>() == flow_rate(solution, space));
  BOOST_TEST(results.at("slip_at_surface").get<double>() == 3.0, tolerance(1e-14));
}

// The walls slip, so that points of the wall are there to be left out.
BOOST_AUTO_TEST_CASE(the_yielded_share_is_the_area_whose_stress_exceeds_mu_s_p) {
  const Section section = slipping();
  const auto space = space_of(section, mesh);
  const auto solution = made_up(section, space, linear, [&](const auto& point) {
    if (point.on_wall) return 1.2;
    return point.position[1] > 0.7 * section.height ? 1.01 : 0.99;
  });
  BOOST_TEST(yielded_share(solution, space) == 0.3, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(rest_is_judged_with_mu_s_inside_and_with_mu_2_at_a_wall_of_friction) {
  const Section section = slipping();
  const auto space = space_of(section, mesh);
  const auto is_at_rest = [&](double inside, double at_wall) {
    std::vector<double> pressure;
    std::vector<Eigen::Vector2d> stress;
    for (const auto& point : space.points()) {
      pressure.push_back(load_of(section).pressure(point.position));
      stress.emplace_back(0, (point.on_wall ? at_wall : inside) * pressure.back());
    }
    return shear::is_within_yield<2>(space, section.law, pressure, stress);
  };
  const double mu_s = section.law.mu_s, mu_2 = section.law.mu_2();
  BOOST_TEST(is_at_rest(0.99 * mu_s, 0.99 * mu_2));
  BOOST_TEST(!is_at_rest(1.01 * mu_s, 0.99 * mu_2));
  BOOST_TEST(!is_at_rest(0.99 * mu_s, 1.01 * mu_2));
}

BOOST_AUTO_TEST_CASE(the_fields_of_a_section_are_what_their_names_say) {
  const Section section = slipping();
  const auto space = space_of(section, mesh);
  const auto solution = made_up(section, space, linear, resting);
  const io::QuadraticGrid fields = grid(solution, space);
  for (const io::Field& field : fields.cell_fields)
    for (std::size_t e = 0; e < field.values.size(); ++e) {
      double height = 0;  // the mean pressure of an element is that in its middle
      for (const auto node : space.mesh().elements[e])
        height += space.mesh().nodes[static_cast<std::size_t>(node)][1] / 9;
      const double pressure = (section.height - height) * std::cos(section.angle);
      const double expected = field.name == "pressure" ? pressure
                              : field.name == "stress" ? 0.5 * section.law.mu_s * pressure
                              : field.name == "stress_over_yield_stress" ? 0.5
                              : field.name == "shear_rate"               ? 0.01
                              : field.name == "inertial_number"
                                  ? section.law.inertial_number(0.01, pressure)
                                  : std::nan("");
      BOOST_TEST(std::abs(field.values[e] / expected - 1) < 1e-12, field.name << " " << e);
    }
}

BOOST_AUTO_TEST_SUITE_END()
