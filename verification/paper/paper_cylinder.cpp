// The paper's Figs 12 to 16: the flow around the cylinder, with eq. (12) and with the law that is
// well-posed where (12) is not.
#include "verification/paper/paper_cylinder.hpp"

#include "twod/cylinder_report.hpp"
#include "verification/harness/fit.hpp"

namespace talus::verification {
namespace {

constexpr double creep_loading = 0.044, flow_loading = 0.054;  // the paper's loadings
const std::vector<double> loadings = {0.01,  0.02,  0.03,         0.04,  creep_loading,
                                      0.046, 0.048, 0.049,        0.050, 0.051,
                                      0.052, 0.053, flow_loading, 0.055, 0.056};
const io::Window whole_box{{-10, -15}, {10, 15}}, vicinity{{-2, -3}, {2, 2}};
// Of the sweep that shows where a coarse λr puts the break.
const std::vector<double> loadings_of_break = {0.01, 0.02, 0.03, 0.04, 0.044, 0.048, 0.049, 0.05};

// NaN where it was not reached.
Wake wake_at(const LawFlows& law, double loading) {
  const auto& state = law.state_at(loading);
  return state.size() == 0 ? Wake{} : wake_of(*law.flows.cylinder, state);
}

io::Curve upright(const std::string& label, double x, const std::vector<io::Curve>& curves) {
  Range range;
  for (const io::Curve& curve : curves)
    for (const double y : curve.y) range.add(y);
  return {label, {x, x}, {range.lower(), range.upper()}, io::Style::dashed};
}

// Through the first point of a curve that has one, with exponent -2.
io::Curve inverse_square(const io::Curve& curve) {
  io::Curve line{"slope -2, the paper", curve.x, {}, io::Style::dashed};
  for (const double x : curve.x)
    line.y.push_back(curve.y.front() * curve.x.front() * curve.x.front() / (x * x));
  return line;
}

// Fig. 12 of a law; `coarse`: drag over Fr with another λr, for its close-up.
void add_drag(PaperPage& page, const LawFlows& law, const std::string& mesh,
              const io::Curve& coarse) {
  io::Figure figure = twod::drag_figure(law.flows.measures, confining_pressures);
  figure.name = "fig12" + law.suffix;
  figure.caption = "Fig. 12 with " + law.law + ", " + mesh +
                   ": drag for five confining pressures (in φρgD), all from one sweep of F, and "
                   "where flow sets in; its coefficient from Fr = 0.005 on, and over p_ext.";
  std::vector<io::Panel>& panels = figure.panels;
  if (panels.size() == 4) {  // else it was not reached
    if (!coarse.x.empty()) panels[1].curves.push_back(coarse);
    panels[1].curves.push_back(upright("break, the paper", 0.005, panels[1].curves));
    for (const std::size_t i : {2, 3})
      panels[i].curves.push_back(inverse_square(panels[i].curves.back()));
  }
  page.figure(std::move(figure), "12",
              {{"c", "experiments (not distributed)"}, {"d", "experiments (not distributed)"}});
}

io::Curve drag_over_froude(const std::string& label,
                           const std::vector<twod::CylinderMeasures>& sweep) {
  io::Curve curve{label, {}, {}, io::Style::dashed};
  for (const auto& m : sweep) {
    curve.x.push_back(m.froude(1));
    curve.y.push_back(m.drag);
  }
  return curve;
}

void add_perimeter(PaperPage& page, const LawFlows& law, const std::string& mesh) {
  io::Figure figure{"fig15" + law.suffix,
                    "Fig. 15 with " + law.law + ", " + mesh +
                        ": along the perimeter, pressures for θ < 0 and stresses for θ > 0; the "
                        "paper has F = 0.054. The viscosity of τ has p_regu in it as it is: one "
                        "curve.",
                    {},
                    2};
  for (const double loading : {flow_loading, creep_loading})
    if (law.state_at(loading).size() > 0)
      figure.panels.push_back(twod::perimeter_panel(*law.flows.cylinder, law.state_at(loading),
                                                    "F = " + io::rounded(loading)));
  page.figure(std::move(figure), "15");
}

LawFlows solved(LawFlows law, const twod::Cylinder& scene, const PaperPage& page, double done) {
  law.flows = flows_at(scene, loadings,
                       [&](double fraction) { page.context().progress(done + 0.4 * fraction); });
  return law;
}

// A figure of fields, if there is a flow to show.
void add_fields(PaperPage& page, io::Figure figure, const std::string& name,
                const std::string& number, const std::string& caption) {
  if (figure.panels.empty()) return;
  figure.name = name;
  figure.caption = caption;
  page.figure(std::move(figure), number);
}

// For the front page.
void show_flow(Chapter& chapter, const LawFlows& law, const Wake& wake, const std::string& mesh) {
  io::Figure figure = primary_variables(law, flow_loading, vicinity);
  if (figure.panels.empty()) return;
  figure.panels.pop_back();
  figure.name = "cylinder_flow";
  figure.caption = "Around the cylinder with " + law.law + ", F = 0.054, " + mesh + ".";
  chapter.headline(Question::flows, std::move(figure),
                   "Down past a cylinder at F = 0.054 with " + law.law +
                       ": the pressure is up to " + known(wake.largest_pressure, 2) +
                       " p_ext in front and " + known(wake.lowest_pressure, 1) + " behind.");
}

}  // namespace

void paper_cylinder(Chapter& chapter, const Context& context) {
  const int around = context.full ? 40 : 24;
  const std::string mesh = std::to_string(around) + " elements around, λr = 1e-6";
  PaperPage page(
      chapter, context,
      "The flow around a cylinder (section 4.2), on half of the plane with " + mesh +
          " (the paper: 160, one element thick" + (context.full ? "" : "; --full: 40") +
          "). F = φρgD/p_ext, with D where the paper prints L_x; Fr = U/sqrt(gD) with p_ext in "
          "φρgD; C_D = F_D/(½φρU²D). The solution depends on F alone: five confining pressures are "
          "one sweep. Each figure with eq. (12) and with barker-gray, which is well-posed at small "
          "I.");
  const LawFlows own = solved({"eq. (12)", "", {}}, cylinder_around(around), page, 0);
  const rheology::Regularisation control = laws_of_paths().back();
  const LawFlows well_posed =
      solved({rheology::name_of(control), "_" + rheology::name_of(control), {}},
             cylinder_around(around, control), page, 0.4);
  twod::Cylinder scene = cylinder_around(around);
  scene.lambda_r = 1e-3;
  const Flows coarse = flows_at(scene, loadings_of_break);
  const LawFlows* laws[] = {&own, &well_posed};

  const DragCurve own_drag{own.flows.measures}, posed_drag{well_posed.flows.measures};
  judge_drag(page, own_drag, posed_drag, {coarse.measures});
  judge_coefficient(page, own_drag, posed_drag);
  add_drag(page, own, mesh, drag_over_froude("λr = 1e-3, p_ext = 1", coarse.measures));
  add_drag(page, well_posed, mesh, {});

  const Wakes own_wakes{wake_at(own, creep_loading), wake_at(own, flow_loading)};
  const Wakes posed_wakes{wake_at(well_posed, creep_loading), wake_at(well_posed, flow_loading)};
  judge_fields(page, own_wakes.flowing, posed_wakes.flowing);
  for (const LawFlows* law : laws)
    add_fields(page, primary_variables(*law, flow_loading, whole_box), "fig13" + law->suffix, "13",
               "Fig. 13 with " + law->law + ", F = 0.054, " + mesh + ". It flows downwards.");
  judge_close_up(page, own_wakes.flowing, posed_wakes.flowing);
  for (const LawFlows* law : laws)
    add_fields(page, primary_variables(*law, flow_loading, vicinity), "fig14" + law->suffix, "14",
               "Fig. 14, the close-up of Fig. 13, with " + law->law + ", F = 0.054, " + mesh + ".");
  judge_perimeter(page, own_wakes, posed_wakes);
  for (const LawFlows* law : laws) add_perimeter(page, *law, mesh);
  judge_viscosity(page, own_wakes);
  for (const LawFlows* law : laws)
    add_fields(
        page, viscosities(*law, creep_loading, flow_loading, whole_box), "fig16" + law->suffix,
        "16",
        "Fig. 16 with " + law->law + ", " + mesh +
            ": F = 0.044 on the left half, 0.054 on the right one." +
            (law == &own ? "" : " This law has no yield stress, and no part that stands for one."));
  show_flow(chapter, well_posed, posed_wakes.flowing, mesh);
  page.conclude();
}

}  // namespace talus::verification
