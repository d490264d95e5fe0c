// The paper's Figs 6 to 8 and Table 1: the inclined plane.
#include <algorithm>
#include <cmath>

#include "oned/report.hpp"
#include "verification/harness/fit.hpp"
#include "verification/paper/paper_parts.hpp"

namespace talus::verification {
namespace {

NamedMethod bagnold_method() {
  return newton_method(rheology::ChauchatMedale{}, 1e-8);
}

void figure_6(PaperPage& page, const oned::ShearScene& scene) {
  const oned::Solution profile = solve_uniform(scene, 40, bagnold_method());
  io::Figure figure = oned::profile_figure(scene, {{"eq. (12)", &profile}});
  figure.name = "fig6";
  figure.caption =
      "Fig. 6: the inclined plane, α = 0.406, H = 14, h = H/40, eq. (12), λr = 1e-8: velocity, "
      "shear rate and stress; then I, and the errors.";
  std::swap(figure.panels[2], figure.panels[3]);  // the paper has no I
  const double error = oned::errors(profile, scene).max;
  // Half an element below the surface the profile bends as (H - z)^{3/2}: 0.1 (h/2)^{3/2} of it.
  const bool agrees =
      page.chapter().check(Kind::exact, "Fig. 6: largest velocity error, h = H/40", error, 0, 2e-3);
  page.item("Fig. 6", "very good agreement with (18)",
            "largest velocity error " + io::rounded(error, 2), agrees, "agrees");
  page.figure(std::move(figure), "6");
}

// The power law of an order that the paper fitted, through the coarsest point of a curve.
io::Curve fit_of_the_paper(const io::Curve& curve, double order) {
  io::Curve fit{
      "order " + io::rounded(order) + ", the paper's fit", curve.x, {}, io::Style::dashed};
  fit.x.resize(4);  // its four coarsest meshes
  for (const double h : fit.x) fit.y.push_back(curve.y[0] * std::pow(h / curve.x[0], order));
  return fit;
}

// Fig. 7: convergence in the paper's norms and in L2, on its meshes and on graded ones.
void figure_7(PaperPage& page, const oned::ShearScene& scene) {
  io::Curve rms{"paper's RMS", {}, {}}, nodal{"paper's infinity norm (nodes)", {}, {}};
  io::Curve l2{"true L2", {}, {}}, graded{"true L2, graded mesh (exponent 2)", {}, {}};
  const NamedMethod method = bagnold_method();
  for (const int elements : paper_meshes) {
    const oned::Errors error = oned::errors(solve_uniform(scene, elements, method), scene);
    const oned::Solution on_graded = solve_or_nan(
        scene, oned::boundaries(scene, {.elements = elements, .grading = 2}), method.options);
    for (io::Curve* curve : {&rms, &nodal, &l2, &graded}) curve->x.push_back(1.0 / elements);
    rms.y.push_back(error.paper_rms);
    nodal.y.push_back(error.nodal_max);
    l2.y.push_back(error.l2);
    graded.y.push_back(oned::errors(on_graded, scene).l2);
  }
  const auto coarsest = [](const std::vector<double>& values) {
    return std::vector<double>(values.begin(), values.begin() + 4);
  };
  const double rms_order = fitted_order(coarsest(rms.x), coarsest(rms.y));
  const double max_order = fitted_order(coarsest(nodal.x), coarsest(nodal.y));
  io::Panel panel{"λr = 1e-8", "h / H", "error", true, true, {rms, nodal, l2, graded}};
  panel.curves.push_back(fit_of_the_paper(rms, 2.46));
  panel.curves.push_back(fit_of_the_paper(nodal, 1.5));
  const double l2_order = fitted_order(l2.x, l2.y), graded_order = fitted_order(graded.x, graded.y);
  Chapter& chapter = page.chapter();
  bool agrees = chapter.check(Kind::publication,
                              "Fig. 7: order of the paper's RMS on the four coarsest meshes",
                              rms_order, 2.36, 2.56);
  agrees &= chapter.check(Kind::publication,
                          "Fig. 7: order in the maximum norm on the four coarsest meshes",
                          max_order, 1.4, 1.6);
  agrees &= chapter.check(Kind::exact, "Fig. 7: order in L2, all meshes", l2_order, 1.9, 2.1);
  agrees &=
      chapter.check(Kind::exact, "Fig. 7: order in L2 on graded meshes", graded_order, 2.9, 3.1);
  page.item("Fig. 7", "orders 2.46 (RMS) and 1.5 (maximum), blamed on λr",
            io::fixed(rms_order, 2) + " and " + io::fixed(max_order, 2) + "; true L2 " +
                io::fixed(l2_order, 2) + ", graded " + io::fixed(graded_order, 2),
            agrees, "numbers agree; the cause is the singular profile, and grading cures it");
  page.figure({"fig7",
               "Fig. 7: the inclined plane, α = 0.406, H = 14, eq. (12), h = H/5 to H/160. The "
               "paper's RMS has order " +
                   io::fixed(rms_order, 2) + " on the four coarsest meshes, the true L2 norm " +
                   io::fixed(l2_order, 2) +
                   " on all: ½ comes from the norm, and 2 is what the singular second derivative "
                   "at the free surface allows. On graded meshes it is " +
                   io::fixed(graded_order, 2) + ".",
               {panel},
               1},
              "7");
}

// Table 1: Newton iterations on the meshes of Fig. 7.
void table_1(PaperPage& page, const oned::ShearScene& scene) {
  io::Table table{"Table 1: Newton iterations, λr = 1e-8",
                  {"h", "paper", "ours, from rest, energy line search", "ours, full steps"},
                  {}};
  const std::vector<std::string> of_the_paper = {"10 000", "10 000", "13", "9", "8", "8"};
  const NamedMethod method = bagnold_method();
  NamedMethod full_steps = method;
  full_steps.options.newton.line_search = solve::LineSearch::none;
  double most = 0;
  for (std::size_t i = 0; i < paper_meshes.size(); ++i) {
    const int elements = paper_meshes[i];
    const oned::Solution solution = solve_uniform(scene, elements, method);
    const oned::Solution plain = solve_uniform(scene, elements, full_steps);
    table.rows.push_back({"H/" + std::to_string(elements), of_the_paper[i],
                          std::to_string(solution.iterations()),
                          std::to_string(plain.iterations()) +
                              (solve::is_success(plain.end) ? "" : ", " + name_of(plain.end))});
    most = solve::nan_max({most, counted_iterations(solution), counted_iterations(plain)});
  }
  const bool is_refuted = page.chapter().check(
      Kind::publication,
      "Table 1: most iterations on the six meshes, with a line search or full steps", most, 1, 12);
  page.item("Table 1", "10 000 iterations on the two coarsest meshes",
            "at most " + io::rounded(most) + " on all six, full steps too", is_refuted,
            "not reproduced: a failure of their solver, not of the problem");
  page.chapter().table(std::move(table));
}

// Fig. 8: surface velocity against inclination.
void figure_8(PaperPage& page) {
  io::Panel panel{"H = 14, h = H/80", "α", "u(H) / sqrt(gd)", false, false, {}};
  io::Curve exact{"eq. (31)", {}, {}, io::Style::line},
      newton{"eq. (12), λr = 1e-8", {}, {}, io::Style::points};
  io::Curve reference{"interior point", {}, {}, io::Style::points};
  double largest = 0;
  for (double angle = 0.34; angle <= 0.5401; angle += page.context().full ? 0.005 : 0.01) {
    const auto scene = scene_of(oned::Bagnold{.angle = angle});
    const double of_theory = scene.exact_velocity(scene.length);
    const double of_newton = oned::velocity_at(
        solve_uniform(scene, 80, newton_method(rheology::ChauchatMedale{}, 1e-8)), scene.length);
    for (io::Curve* curve : {&exact, &newton, &reference}) curve->x.push_back(angle);
    exact.y.push_back(of_theory);
    newton.y.push_back(of_newton);
    reference.y.push_back(
        oned::velocity_at(solve_uniform(scene, 80, reference_method()), scene.length));
    if (of_theory > 0)
      largest = solve::nan_max(largest, std::abs(of_newton - of_theory) / of_theory);
  }
  panel.curves = {exact,
                  newton,
                  reference,
                  {"the paper's threshold, 0.37",
                   {0.37, 0.37},
                   {0, *std::ranges::max_element(exact.y)},
                   io::Style::dashed}};

  // The threshold, from the interior point's certificate of rest.
  double rest = 0.34, flow = 0.40;
  int failures = 0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (rest + flow);
    const auto scene = scene_of(oned::Bagnold{.angle = middle});
    const auto certified = solve_uniform(scene, 80, reference_method());
    failures += solve::is_success(certified.end) ? 0 : 1;
    (certified.interior_point.at_rest ? rest : flow) = middle;
  }
  const double offset = 0.5 * (rest + flow) - std::atan(rheology::FrictionLaw{}.mu_s);
  Chapter& chapter = page.chapter();
  bool agrees = chapter.check(Kind::exact, "Fig. 8: threshold of motion minus arctan μs",
                              if_counts(failures == 0, offset), -1e-6, 1e-6);
  agrees &= chapter.check(Kind::exact, "Fig. 8: largest relative error of u(H) in flow", largest, 0,
                          1e-3);
  page.item("Fig. 8", "threshold of motion α ≈ 0.37",
            io::fixed(0.5 * (rest + flow), 6) +
                "; arctan μs = " + io::fixed(std::atan(rheology::FrictionLaw{}.mu_s), 6),
            agrees, "agrees");
  page.figure({"fig8",
               "Fig. 8: velocity at the free surface of the inclined plane against the "
               "inclination, h = H/80, eq. (12) at λr = 1e-8 and the interior point.",
               {panel},
               1},
              "8");
}

}  // namespace

void add_bagnold(PaperPage& page, const oned::ShearScene& scene) {
  figure_6(page, scene);
  figure_7(page, scene);
  table_1(page, scene);
}

void add_onset(PaperPage& page) {
  figure_8(page);
}

}  // namespace talus::verification
