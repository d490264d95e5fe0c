// The page of the paper: its verdicts follow their checks, and what a user gives is drawn in it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <boost/test/unit_test.hpp>

#include "twod/cylinder_report.hpp"
#include "verification/paper/paper_cylinder.hpp"

BOOST_AUTO_TEST_SUITE(paper_test)

using namespace talus;
using namespace talus::verification;

namespace {

// Items whose verdict is open.
std::set<std::string> open_items(const Chapter& chapter) {
  std::set<std::string> open;
  for (const auto& row : std::get<io::Table>(chapter.blocks.at(1)).rows)
    if (row.back() == open_verdict) open.insert(row.front());
  return open;
}

std::set<std::string> open_in_the_heap(const twod::Section& section) {
  Chapter chapter;
  paper_heap_of(chapter, section, {});
  return open_items(chapter);
}

// A curve for every panel of these figures.
std::vector<GivenCurve> given_for(const std::set<std::string>& numbers) {
  std::vector<GivenCurve> all;
  for (const OpenFigure& each : open_figures_of_the_paper())
    for (int panel = 0; panel < each.panels; ++panel)
      if (numbers.contains(each.number))
        all.push_back({each.number,
                       name_of_panel(static_cast<std::size_t>(panel)),
                       {"given", {1}, {1}, io::Style::points}});
  return all;
}

std::size_t drawn_in(const Chapter& chapter) {
  std::size_t count = 0;
  for (const auto& block : chapter.blocks)
    if (const auto* figure = std::get_if<io::Figure>(&block))
      for (const io::Panel& panel : figure->panels)
        for (const io::Curve& curve : panel.curves) count += curve.label == "given" ? 1 : 0;
  return count;
}

// A sweep as it should be: creep to F = 0.049, then flow under a drag that comes to a value.
DragCurve drag_curve(double lambda_r) {
  const auto measures = [&](double loading, double velocity, double drag) {
    twod::CylinderMeasures m;
    m.loading = loading;
    m.lambda_r = lambda_r;
    m.mean_velocity = velocity;
    m.drag = drag;
    return m;
  };
  return {{measures(0.04, 3.2 * lambda_r, 4.7), measures(0.049, 8 * lambda_r, 5.4),
           measures(0.05, 0.014, 5.6), measures(0.052, 0.1, 5.9), measures(0.054, 0.2, 6.1),
           measures(0.055, 0.3, 6.1)}};
}

Wake wake(bool flows) {
  return {.stagnation_angle = 0.99 * std::numbers::pi,
          .largest_pressure = flows ? 7. : 5.,
          .lowest_pressure = flows ? -0.005 : 0.03,
          .lowest_angle = 0.5,
          .lowest_regularised = flows ? 5e-5 : 3e4,
          .lambda_r = 1e-6,
          .stress_gap = flows ? 0.005 : 0,
          .layer = 0.3,
          .extremes = 0,
          .static_decades = flows ? 8. : 3.,
          .dynamic_decades = 2,
          .largest_dynamic_at = 0.55,
          .lowest_viscosity = flows ? 6e-3 : 1e3,
          .lowest_viscosity_at = -0.5};
}

// Runs that are as they should be, for each test to break.
struct CylinderPage {
  DragCurve own = drag_curve(1e-6), well_posed = drag_curve(1e-6), coarse = drag_curve(1e-3);
  Wakes own_wakes{wake(false), wake(true)}, well_posed_wakes = own_wakes;

  std::set<std::string> open() const {
    Chapter chapter;
    const Context context;
    PaperPage page(chapter, context, "");
    judge_drag(page, own, well_posed, coarse);
    judge_coefficient(page, own, well_posed);
    judge_fields(page, own_wakes.flowing, well_posed_wakes.flowing);
    judge_close_up(page, own_wakes.flowing, well_posed_wakes.flowing);
    judge_perimeter(page, own_wakes, well_posed_wakes);
    judge_viscosity(page, own_wakes);
    return open_items(chapter);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_given_for_a_panel_is_drawn_once) {
  Context context;
  context.given = given_for({"2", "3", "4", "5", "6", "7", "8"});
  Chapter lines;
  paper_lines(lines, context);
  BOOST_TEST(drawn_in(lines) == context.given.size());
  context.given = given_for({"10", "11"});
  Chapter heap;
  paper_heap(heap, context);
  BOOST_TEST(drawn_in(heap) == context.given.size());
  BOOST_TEST(open_items(heap).empty());
}

BOOST_AUTO_TEST_CASE(another_friction_turns_the_verdicts_on_the_heap) {
  twod::Section section;
  section.law.mu_s += 1e-3;
  BOOST_TEST((open_in_the_heap(section) == std::set<std::string>{"Fig. 10"}));
  section = {};
  section.law.delta_mu = 1e-3;  // no angle carries these rates
  BOOST_TEST((open_in_the_heap(section) == std::set<std::string>{"Fig. 10", "Fig. 11"}));
}

BOOST_AUTO_TEST_CASE(another_drag_turns_the_verdicts_on_fig_12) {
  BOOST_TEST(CylinderPage{}.open().empty());
  const auto open = [](auto&& breaks) {
    CylinderPage page;
    breaks(page);
    return page.open();
  };
  const std::set<std::string> drag = {"Fig. 12, drag"}, both = {"Fig. 12, drag", "Fig. 12, C_D"};
  // Creep that does not go with λr, a break where the paper has it, a drag that goes on.
  BOOST_TEST((open([](auto& page) { page.coarse = page.own; }) == drag));
  BOOST_TEST((open([](auto& page) { page.own = page.coarse; }) == drag));
  BOOST_TEST((open([](auto& page) { page.own.sweep.back().drag = 6.6; }) == drag));
  // A drag of a liquid, a loading that was not reached, none at all.
  BOOST_TEST((open([](auto& page) {
                for (auto& m : page.well_posed.sweep) m.drag *= 1 + 50 * m.mean_velocity;
              }) == both));
  BOOST_TEST((open([](auto& page) { page.own.sweep[3].drag = std::nan(""); }) == both));
  BOOST_TEST((open([](auto& page) { page.own.sweep.clear(); }) == both));
}

BOOST_AUTO_TEST_CASE(another_wake_turns_the_verdicts_on_figs_13_to_16) {
  const auto opens = [](double Wake::*number, double value, std::set<std::string> items,
                        bool is_flowing = true) {
    CylinderPage page;
    Wake& broken = is_flowing ? page.own_wakes.flowing : page.own_wakes.creeping;
    broken.*number = value;
    BOOST_TEST(page.open() == items, boost::test_tools::per_element());
    broken.*number = std::nan("");
    BOOST_TEST(page.open() == items, boost::test_tools::per_element());
  };
  opens(&Wake::stagnation_angle, 0, {"Fig. 13"});
  opens(&Wake::largest_pressure, 1, {"Fig. 13"});
  opens(&Wake::lowest_angle, 3, {"Fig. 13"});
  opens(&Wake::lowest_pressure, 0.02, {"Fig. 13", "Fig. 15"});
  opens(&Wake::layer, 1, {"Fig. 14"});
  opens(&Wake::extremes, 2, {"Fig. 14"});
  opens(&Wake::lowest_regularised, 1, {"Fig. 15"});
  opens(&Wake::lowest_pressure, -0.01, {"Fig. 15"}, false);
  opens(&Wake::static_decades, 5, {"Fig. 16"});
  opens(&Wake::dynamic_decades, 1, {"Fig. 16"});
  opens(&Wake::largest_dynamic_at, -0.6, {"Fig. 16"}, false);
  opens(&Wake::lowest_viscosity, 1, {"Fig. 16"});
  opens(&Wake::lowest_viscosity_at, 3, {"Fig. 16"}, false);
  CylinderPage page;
  page.own_wakes = page.well_posed_wakes = {};  // not found
  BOOST_TEST((page.open() == std::set<std::string>{"Fig. 13", "Fig. 14", "Fig. 15", "Fig. 16"}));
  page = {};
  page.well_posed_wakes = {};
  BOOST_TEST((page.open() == std::set<std::string>{"Fig. 13", "Fig. 14", "Fig. 15"}));
}

// What the registry says of panels is what is drawn.
BOOST_AUTO_TEST_CASE(the_figure_of_the_drag_has_the_panels_that_take_curves) {
  const auto figure = twod::drag_figure(drag_curve(1e-6).sweep, confining_pressures);
  const auto open = open_figures_of_the_paper();
  const auto found = std::ranges::find(open, "12", &OpenFigure::number);
  BOOST_REQUIRE((found != open.end()));
  BOOST_TEST(static_cast<int>(figure.panels.size()) == found->panels);
  for (const io::Panel& panel : figure.panels)
    BOOST_TEST(panel.curves.size() == confining_pressures.size());
  // From Fr = 0.005 on; what the pressure leaves is the same everywhere.
  BOOST_TEST(figure.panels[0].curves[0].x.size() == 6U);
  BOOST_TEST(figure.panels[3].curves[0].x.size() == 4U);
  BOOST_TEST(figure.panels[3].curves[4].y[0] == figure.panels[2].curves[4].y[0] / 10);
}

BOOST_AUTO_TEST_SUITE_END()
