// The paper's Figs 10 and 11: the heap, from its cross-section alone.
#include <algorithm>
#include <cmath>

#include "twod/flow_rate_search.hpp"
#include "twod/section_report.hpp"
#include "verification/harness/fit.hpp"
#include "verification/paper/paper_parts.hpp"
#include "verification/references/references.hpp"

namespace talus::verification {
namespace {

// The paper's computed flow rates, and the experiment's that they stand for.
struct FlowRate {
  double computed, measured;
};
constexpr FlowRate flow_rates[] = {{14.85, 14.9}, {39.71, 40.2}, {88.72, 90.1}};

// What becomes of them: the two figures and the numbers beside them.
struct Heaps {
  io::Panel velocity{"velocity at the surface", "y / d", "u / sqrt(gd)", false, false, {}};
  io::Panel depth{"depth of the flowing layer (1%)", "y / d", "depth / d", false, false, {}};
  std::vector<io::Panel> profiles;
  io::Table table;
  std::vector<double> found, angles;  // NaN where none was found
  double largest_rise = 0;            // of a velocity downwards, over that at the surface
};

// How much a profile, from the bottom up, falls where it should rise, over its largest value.
double largest_rise_downwards(const io::Curve& profile) {
  double rise = 0;
  for (std::size_t i = 1; i < profile.x.size(); ++i)
    rise = solve::nan_max(rise, profile.x[i - 1] - profile.x[i]);
  return rise / *std::ranges::max_element(profile.x);
}

// What is drawn and listed of a flow that was found.
void add_found(Heaps& heaps, const std::string& label, const twod::SectionSolution& solution,
               const shear::CrossSection<2>& space) {
  const auto surface = twod::surface_profile(solution, space);
  heaps.velocity.curves.push_back({label, surface.y, surface.velocity, io::Style::line});
  heaps.depth.curves.push_back({label, surface.y, surface.depth_1, io::Style::line});
  heaps.profiles.push_back(twod::profiles(solution, space, label));
  for (const io::Curve& profile : heaps.profiles.back().curves)
    heaps.largest_rise = solve::nan_max(heaps.largest_rise, largest_rise_downwards(profile));
  heaps.table.rows.push_back(
      {label, io::rounded(solution.section.angle, 9), io::rounded(surface.velocity.front(), 6),
       io::rounded(surface.depth_1.front(), 4), io::rounded(surface.depth_5.front(), 4),
       io::rounded(surface.depth_yield.front(), 4)});
  heaps.found.back() = twod::flow_rate(solution, space);
  heaps.angles.back() = solution.section.angle;
}

void add_rate(Heaps& heaps, double rate, const twod::Section& section,
              const twod::SectionMesh& mesh) {
  heaps.found.push_back(std::nan(""));
  heaps.angles.push_back(std::nan(""));
  auto space = twod::space_of(section, mesh);
  try {
    const auto solution =
        twod::solve_for_flow_rate(rate, section, mesh, space, twod::newton_options(1e-5));
    add_found(heaps, io::rounded(rate, 4), solution, space);
  } catch (const twod::FlowRateError&) {
    heaps.largest_rise = std::nan("");
  }
}

// The inclination that another code finds on the paper's mesh.
Reference known_angle() {
  for (const auto& known : references::known_cases({"heap"}))
    for (const auto& result : known.results)
      if (result.name == "angle") return result.reference;
  return {};
}

std::string list_of(const std::vector<double>& angles) {
  std::string list;
  for (const double angle : angles) list += (list.empty() ? "" : ", ") + known(angle, 6);
  return list;
}

void figure_10(PaperPage& page, const Heaps& heaps, const std::string& mesh) {
  Chapter& chapter = page.chapter();
  bool holds = true;
  for (std::size_t i = 0; i < std::size(flow_rates); ++i) {
    const auto [computed, measured] = flow_rates[i];
    const std::string label = "Fig. 10: Q* = " + io::rounded(computed, 4);
    holds &= chapter.check(Kind::publication, label + ": relative miss",
                           heaps.found[i] / computed - 1, -1e-8, 1e-8);
    holds &= chapter.check(Kind::publication, label + ": apart from the experiment's",
                           heaps.found[i] / measured - 1, -0.02, 0.02);
  }
  const Reference theirs = known_angle();
  const double angle = heaps.angles[1];
  holds &= chapter.check("Fig. 10: α at Q* = 39.71", angle,
                         page.context().full ? theirs : theirs.within(3e-4));
  page.item(
      "Fig. 10",
      "α by trial and error, Q* within 2% of the experiments; velocity at the surface and "
      "flowing layer agree with them, the layer slightly too thick",
      "α = " + list_of(heaps.angles) + " for Q* = 14.85, 39.71, 88.72; drawn", holds,
      "Q* agrees, and α with another code's at Q* = 39.71; the curves of others are to be had "
      "only from their owners");
  const std::vector<Awaited> others = {{"a", "experiments (not distributed)"},
                                       {"b", "experiments (not distributed)"},
                                       {"a", "Jop et al. 2006 (not distributed)"},
                                       {"b", "Jop et al. 2006 (not distributed)"}};
  page.figure({"fig10",
               "Fig. 10: the heap between rough walls, W = 140, H = 50, eq. (12), λr = 1e-5, from "
               "the cross-section alone, " +
                   mesh + ".",
               {heaps.velocity, heaps.depth},
               2},
              "10", others);
  chapter.table(heaps.table);
}

void figure_11(PaperPage& page, const Heaps& heaps, const std::string& mesh) {
  const bool holds = page.chapter().check(
      Kind::self_consistency,
      "Fig. 11: a velocity that rises downwards, over the largest of its profile",
      heaps.largest_rise, 0, 1e-6);
  page.item("Fig. 11", "velocity in the cross-section for the three flow rates",
            "as profiles over the height; the largest rise of a velocity downwards is " +
                known(heaps.largest_rise, 1) + " of its profile's largest",
            holds, "drawn; falls from the surface to the bed, no numbers to compare");
  page.figure({"fig11",
               "Fig. 11: velocity in the section of Fig. 10, as profiles over the height at four "
               "places across, " +
                   mesh + ", λr = 1e-5.",
               heaps.profiles, 3},
              "11");
}

}  // namespace

void paper_heap_of(Chapter& chapter, const twod::Section& section, const Context& context) {
  const twod::SectionMesh mesh = context.full ? twod::SectionMesh{} : twod::SectionMesh{35, 50};
  const std::string elements =
      std::to_string(mesh.across) + " x " + std::to_string(mesh.up) + " elements on half of it" +
      (context.full ? ", the paper's" : " (the paper's 70 x 100 with --full)");
  PaperPage page(chapter, context,
                 "The heap (section 4.1): unidirectional, so its cross-section is all of it.");
  Heaps heaps;
  heaps.table = {"The paper's flow rates, eq. (12), λr = 1e-5, " + elements,
                 {"Q*", "α", "surface velocity", "depth, 1%", "depth, 5%", "depth, yield"},
                 {}};
  for (const FlowRate& rate : flow_rates) {
    add_rate(heaps, rate.computed, section, mesh);
    context.progress(static_cast<double>(heaps.found.size()) / std::size(flow_rates));
  }
  figure_10(page, heaps, elements);
  figure_11(page, heaps, elements);
  page.conclude();
}

void paper_heap(Chapter& chapter, const Context& context) {
  paper_heap_of(chapter, {}, context);
}

}  // namespace talus::verification
