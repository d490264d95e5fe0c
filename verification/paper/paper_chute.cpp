// The paper's Figs 2 to 5: the vertical chute.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <gsl/gsl_integration.h>

#include "oned/report.hpp"
#include "verification/harness/fit.hpp"
#include "verification/paper/paper_parts.hpp"
#include "verification/stability/line_answer.hpp"

namespace talus::verification {
namespace {

// Velocity and I above shear rate and stress, as the paper has them; below, the errors.
io::Figure in_the_paper_s_layout(io::Figure figure) {
  std::swap(figure.panels[1], figure.panels[2]);
  figure.columns = 2;
  return figure;
}

struct ProfileErrors {
  double flow = 0, plug = 0;  // of the shear rate beyond y0 + h, and within y0 - h
};

// Figs 2 and 4: profiles of the four regularisations, and the errors of eq. (10)-(12).
ProfileErrors add_profiles(io::Figure& figure, const oned::ShearScene& scene, int elements) {
  std::vector<oned::Solution> solutions;
  std::vector<std::pair<std::string, const oned::Solution*>> labelled;
  const auto methods = yield_stress_methods(1e-4);
  solutions.reserve(methods.size());
  const double h = scene.length / elements;
  ProfileErrors errors;
  for (const NamedMethod& method : methods) {
    solutions.push_back(solve_uniform(scene, elements, method));
    labelled.emplace_back(method.label, &solutions.back());
    if (method.label == rheology::Simple::name) continue;
    for (std::size_t k = 0; k < solutions.back().shear_rate.size(); ++k) {
      const double y = solutions.back().space.points()[k].position[0];
      const double rate = solutions.back().shear_rate[k];
      if (y < *scene.kink - h) errors.plug = solve::nan_max(errors.plug, rate);
      if (y > *scene.kink + h)
        errors.flow = solve::nan_max(errors.flow, std::abs(rate - scene.exact_shear_rate(y)));
    }
  }
  figure.panels = in_the_paper_s_layout(oned::profile_figure(scene, labelled)).panels;
  return errors;
}

// Whether they are within what the mesh allows.
bool check_profiles(Chapter& chapter, const std::string& label, const ProfileErrors& errors,
                    double largest) {
  const bool holds =
      chapter.check(Kind::exact, label + ": largest shear-rate error in the flow, eq. (10)-(12)",
                    errors.flow, 0, largest);
  return chapter.check(Kind::exact, label + ": largest shear rate in the plug, eq. (10)-(12)",
                       errors.plug, 0, 5e-3) &&
         holds;
}

void figure_2(PaperPage& page, const oned::ShearScene& scene) {
  io::Figure figure{"fig2",
                    "Fig. 2: the chute, p = b = 28, h = b/80 (40 elements on half of it), λr = "
                    "1e-4, all four regularisations; below, the errors.",
                    {},
                    2};
  const ProfileErrors errors = add_profiles(figure, scene, 40);
  const bool holds = check_profiles(page.chapter(), "Fig. 2, h = b/80", errors, 5e-3);
  page.item("Fig. 2", "very good agreement with (17)",
            "largest shear-rate error beyond y0 + h: " + io::rounded(errors.flow, 2), holds,
            "agrees");
  page.figure(std::move(figure), "2");
}

void figure_4(PaperPage& page, const oned::ShearScene& scene) {
  io::Figure figure{
      "fig4", "Fig. 4: as Fig. 2 with h = b/320 (160 elements on half of it), λr = 1e-4.", {}, 2};
  const ProfileErrors errors = add_profiles(figure, scene, 160);
  const bool holds = check_profiles(page.chapter(), "Fig. 4, h = b/320", errors, 1e-3);
  page.item(
      "Fig. 4", "all but (12) oscillate in dw/dy at h = b/320",
      "(10), (11), (12): largest shear-rate error beyond y0 + h " + io::rounded(errors.flow, 2) +
          ", largest shear rate in the plug " + io::rounded(errors.plug, 2),
      holds, "not reproduced: no regularisation oscillates once evaluated without cancellation");
  page.figure(std::move(figure), "4");
}

// Fig. 3a: error against mesh size for the four regularisations.
io::Panel figure_3a(PaperPage& page, const oned::ShearScene& scene) {
  io::Panel panel{"λr = 1e-4", "h / b", "paper's RMS error", true, true, {}};
  std::vector<NamedMethod> methods = yield_stress_methods(1e-4);
  methods.push_back(reference_method());
  std::vector<std::pair<std::string, double>> finest;
  for (const NamedMethod& method : methods) {
    io::Curve curve{method.label, {}, {}};
    for (const int elements : paper_meshes) {
      curve.x.push_back(0.5 / elements);
      curve.y.push_back(oned::errors(solve_uniform(scene, elements, method), scene).paper_rms);
    }
    finest.emplace_back(method.label, curve.y.back());
    panel.curves.push_back(curve);
  }
  const auto error_of = [&](const auto& law) {
    const auto found = std::ranges::find(finest, law.name, &std::pair<std::string, double>::first);
    return found == finest.end() ? std::nan("") : found->second;
  };
  const double ours = error_of(rheology::ChauchatMedale{});
  const double simple = error_of(rheology::Simple{}) / ours;
  const double be = error_of(rheology::BercovierEngelman{}) / ours;
  const double exponential = error_of(rheology::Papanastasiou{}) / ours;
  bool agrees = page.chapter().check(
      Kind::publication, "Fig. 3a: error of (9) over that of (12), h = b/320", simple, 3, 100);
  agrees &= page.chapter().check(
      Kind::publication, "Fig. 3a: error of (10) over that of (12), h = b/320", be, 0.8, 1.25);
  agrees &=
      page.chapter().check(Kind::publication, "Fig. 3a: error of (11) over that of (12), h = b/320",
                           exponential, 0.8, 1.25);
  page.item("Fig. 3a", "(9) worst; on the finest mesh (12) ten times better than (10), (11)",
            "h = b/320: (9) " + io::rounded(simple, 3) + " times, (10) " + io::rounded(be, 3) +
                " times, (11) " + io::rounded(exponential, 3) + " times the error of (12)",
            agrees, "(9) worst: agrees; the advantage of (12) over (10), (11) is not reproduced");
  return panel;
}

// Fig. 3b: error against Newton iterations from rest.
io::Panel figure_3b(PaperPage& page, const oned::ShearScene& scene) {
  io::Panel panel{"h = b/160, λr = 1e-4", "Newton iteration", "paper's RMS error", false, true, {}};
  double most = 0;
  for (NamedMethod method : yield_stress_methods(1e-4)) {
    io::Curve curve{method.label, {}, {}};
    const auto line = oned::boundaries(scene, {.elements = 80});
    oned::Solution iterate{{}, oned::space_of(scene, line)};
    method.options.observe = [&](const solve::CompensatedVector& w) {
      iterate.velocity = w;
      curve.x.push_back(static_cast<double>(curve.x.size()));
      curve.y.push_back(oned::errors(iterate, scene).paper_rms);
    };
    const oned::Solution solution = oned::solve(scene, line, method.options);
    most = solve::nan_max(most, counted_iterations(solution));
    panel.curves.push_back(curve);
  }
  const bool is_refuted = page.chapter().check(
      Kind::publication, "Fig. 3b: most Newton iterations from rest", most, 1, 25);
  page.item("Fig. 3b", "(11) must be started from another regularisation",
            "all four from rest, at most " + io::rounded(most) + " iterations", is_refuted,
            "(11) is well defined at rest with expm1 and its series");
  return panel;
}

void figure_3(PaperPage& page, const oned::ShearScene& scene) {
  io::Panel a = figure_3a(page, scene), b = figure_3b(page, scene);
  page.figure({"fig3",
               "Fig. 3: the chute, p = b = 28. a: on uniform meshes y0 sits elsewhere in its "
               "element on each, and the error need not fall regularly; the interior point has no "
               "λr that could stop it. b: the iterates, from rest for every regularisation.",
               {std::move(a), std::move(b)},
               2},
              "3");
}

// Fig. 5: the two errors, from the mesh and from λr.
void figure_5(PaperPage& page, const oned::ShearScene& scene) {
  io::Panel a{"error over h, eq. (12)", "h / b", "paper's RMS error", true, true, {}};
  io::Panel b{"error over λr, eq. (12)", "λr", "paper's RMS error", true, true, {}};
  io::Panel c{
      "λr error alone: distance to the interior point", "λr", "L2 distance", true, true, {}};
  const rheology::ChauchatMedale law;
  for (const double lambda_r : {1e-4, 1e-5, 1e-6}) {
    io::Curve curve{"λr = " + short_power(lambda_r), {}, {}};
    for (const int elements : paper_meshes) {
      curve.x.push_back(0.5 / elements);
      curve.y.push_back(
          oned::errors(solve_uniform(scene, elements, newton_method(law, lambda_r)), scene)
              .paper_rms);
    }
    a.curves.push_back(curve);
  }
  double smallest_order = std::numeric_limits<double>::infinity(), largest_order = 0;
  for (const int elements : paper_meshes) {
    io::Curve total{"h = b/" + std::to_string(2 * elements), {}, {}}, alone = total;
    const oned::Solution reference = solve_uniform(scene, elements, reference_method());
    for (const double lambda_r : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const oned::Solution solution = solve_uniform(scene, elements, newton_method(law, lambda_r));
      total.x.push_back(lambda_r);
      total.y.push_back(oned::errors(solution, scene).paper_rms);
      alone.x.push_back(lambda_r);
      alone.y.push_back(oned::distance(solution, reference).l2);
    }
    const double order = fitted_order(alone.x, alone.y);
    smallest_order = solve::nan_min(smallest_order, order);
    largest_order = solve::nan_max(largest_order, order);
    b.curves.push_back(total);
    c.curves.push_back(alone);
  }
  // As the paper draws it, a line of order 1: here through the last point of the finest mesh.
  const io::Curve& finest = b.curves.back();
  io::Curve linear{"linear", finest.x, {}, io::Style::dashed};
  for (const double lambda_r : linear.x)
    linear.y.push_back(finest.y.front() * lambda_r / finest.x.front());
  b.curves.push_back(std::move(linear));
  Chapter& chapter = page.chapter();
  bool agrees =
      chapter.check(Kind::publication, "Fig. 5b: smallest order of the λr error over the meshes",
                    smallest_order, 0.95, 1.05);
  agrees &=
      chapter.check(Kind::publication, "Fig. 5b: largest order of the λr error over the meshes",
                    largest_order, 0.95, 1.05);
  page.item("Fig. 5", "at h = b/320 the error falls linearly with λr",
            "the λr error falls with order " + io::fixed(smallest_order, 3) + " to " +
                io::fixed(largest_order, 3) + " on every mesh; the total stops at the mesh error",
            agrees, "agrees");
  page.figure({"fig5",
               "Fig. 5: the chute, p = b = 28, eq. (12). What the paper shows in two plots is a "
               "sum: a mesh error that no λr lowers, and a λr error that no mesh lowers. The third "
               "panel isolates it; its orders in λr are " +
                   io::fixed(smallest_order, 3) + " to " + io::fixed(largest_order, 3) +
                   ". Dashed: linear, as in the paper.",
               {a, b, c},
               3},
              "5");
}

// What a law adds to the velocity in the middle: the integral of its shear rate under the stress
// that equilibrium leaves no choice of, less that of eq. (4).
double exact_creep(const oned::ShearScene& scene, const rheology::Rheology& rheology) {
  const RateLaw regularised = rate_of(rheology), limit = rate_of(rheology.law);
  const auto added = [&](double y) {
    const double stress = scene.exact_stress(y), pressure = scene.pressure(y);
    return regularised(stress, pressure).value - limit(stress, pressure).value;
  };
  double points[] = {0, *scene.kink, scene.length}, creep = 0, error = 0;
  gsl_function integrand{[](double y, void* f) { return (*static_cast<decltype(added)*>(f))(y); },
                         const_cast<void*>(static_cast<const void*>(&added))};
  constexpr std::size_t intervals = 1000;
  const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> space(
      gsl_integration_workspace_alloc(intervals), &gsl_integration_workspace_free);
  gsl_integration_qagp(&integrand, points, 3, 0, 1e-8, intervals, space.get(), &creep, &error);
  return creep;
}

// The creep of the plug, which the paper describes without a figure: of first order in λr, with the
// factor that its law gives.
void creep(PaperPage& page, const oned::ShearScene& scene) {
  // Towards the edge of the plug the added rate grows as one over the square root of the distance,
  // of which a mesh misses a share that falls as the square root of its elements.
  const auto line = oned::boundaries(scene, {.elements = 21760, .align = 0.0});
  constexpr double lambda_r = 1e-5;
  const auto reference = solve_or_nan(scene, line, reference_method().options);
  bool agrees = true;
  double of_eq_12 = std::nan("");
  for (const NamedMethod& method : yield_stress_methods(lambda_r)) {
    const auto regular = solve_or_nan(scene, line, method.options);
    const double found = oned::velocity_at(regular, 0) - oned::velocity_at(reference, 0);
    const double exact = exact_creep(scene, {scene.law(), method.options.regularisation, lambda_r});
    agrees &=
        page.chapter().check(Kind::exact, "creep of the plug over its integral, " + method.label,
                             found / exact, 1 - 1e-3, 1 + 1e-3);
    if (method.label == rheology::ChauchatMedale::name) of_eq_12 = found / lambda_r;
  }
  page.item("section 3.1", "creep of the plug “of order of the regularisation parameter”",
            io::fixed(of_eq_12, 2) + " λr with eq. (12)", agrees,
            "agrees; the factor is that of this p and b");
}

}  // namespace

void add_chute(PaperPage& page, const oned::ShearScene& scene) {
  figure_2(page, scene);
  figure_3(page, scene);
  page.context().progress(0.3);
  creep(page, scene);
  figure_4(page, scene);
  figure_5(page, scene);
}

}  // namespace talus::verification
