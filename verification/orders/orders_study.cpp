// Errors on a line against element size: fitted orders for every case a scene declares.
#include <cmath>

#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"
#include "verification/orders/orders_parts.hpp"

namespace talus::verification {
namespace {

// Meshes on which the distance to the reference (of the reference: to a second answer as good as
// it) exceeds this share of the mesh error are left out of fits.
constexpr double floor_share = 0.03;
constexpr std::size_t fewest_meshes = 4;

struct Measured {
  double h;
  oned::Errors error;
  oned::Errors lambda_error, mesh_error;

  bool at_floor(double oned::Errors::*norm) const {
    return lambda_error.*norm > floor_share * (mesh_error.*norm);
  }
};

using Family = std::vector<Measured>;

std::vector<oned::MeshOptions> meshes_of(const oned::OrderCase& order_case) {
  std::vector<oned::MeshOptions> meshes;
  for (const int elements : order_case.elements) {
    meshes.push_back(order_case.mesh);
    meshes.back().elements = elements;
  }
  return meshes;
}

// Errors of one method on the meshes of a case; the reference tells mesh error from λr error.
Family measure(const oned::ShearScene& scene, const oned::OrderCase& order_case,
               const NamedMethod& method, const std::vector<oned::Solution>& references) {
  Family family;
  const auto meshes = meshes_of(order_case);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const oned::MeshOptions& mesh = meshes[i];
    const auto solution = solve_or_nan(scene, oned::boundaries(scene, mesh), method.options);
    family.push_back({scene.length / mesh.elements, oned::errors(solution, scene),
                      oned::distance(solution, references[i]), oned::errors(references[i], scene)});
  }
  return family;
}

std::vector<double> column(const Family& family, double oned::Errors::*norm, bool at_floor) {
  std::vector<double> values;
  for (const Measured& each : family)
    if (each.at_floor(norm) == at_floor) values.push_back(each.error.*norm);
  return values;
}

std::vector<double> sizes(const Family& family, double oned::Errors::*norm, bool at_floor) {
  std::vector<double> values;
  for (const Measured& each : family)
    if (each.at_floor(norm) == at_floor) values.push_back(each.h);
  return values;
}

struct Norm {
  std::string name;
  double oned::Errors::*error;
  double oned::Orders::*order;
  std::string unit = "error / sqrt(gd)";
};

const std::vector<Norm> norms = {
    {"L2", &oned::Errors::l2, &oned::Orders::l2, "error / (d sqrt(g))"},
    {"maximum", &oned::Errors::max, &oned::Orders::max},
    {"nodal maximum", &oned::Errors::nodal_max, &oned::Orders::nodal_max},
    {"paper's RMS", &oned::Errors::paper_rms, &oned::Orders::paper_rms}};

void fit_orders(Chapter& chapter, io::Table& table, const std::string& label,
                const oned::OrderCase& order_case, const std::string& method,
                const Family& family) {
  std::vector<std::string> row = {label, method};
  for (const Norm& norm : norms) {
    const auto h = sizes(family, norm.error, false);
    if (!order_case.expected || h.size() < fewest_meshes) {
      row.push_back(order_case.expected ? "floor (" + std::to_string(h.size()) + " meshes above)"
                                        : "none can be fitted");
      continue;
    }
    const double order = fitted_order(h, column(family, norm.error, false));
    const double expected = (*order_case.expected).*norm.order;
    row.push_back(io::fixed(order, 3) + " (" + io::rounded(expected, 3) + "), " +
                  std::to_string(h.size()) + " meshes");
    chapter.check(Kind::exact, label + ", " + method + ": order in " + norm.name, order,
                  expected - order_case.expected->tolerance,
                  expected + order_case.expected->tolerance);
  }
  table.rows.push_back(row);
}

io::Panel panel_of(const std::string& title, const Norm& norm) {
  return {title + ": " + norm.name, "h / d", norm.unit, true, true, {}};
}

void add_curves(io::Panel& panel, const std::string& label, const Family& family,
                const Norm& norm) {
  std::vector<double> h, error;
  for (const Measured& each : family) {
    h.push_back(each.h);
    error.push_back(each.error.*norm.error);
  }
  panel.curves.push_back({label, h, error});
}

void add_floor(io::Curve& at_floor, const Family& family, const Norm& norm) {
  for (const Measured& each : family) {
    if (!each.at_floor(norm.error)) continue;
    at_floor.x.push_back(each.h);
    at_floor.y.push_back(each.error.*norm.error);
  }
}

void add_guide(io::Panel& panel, const oned::OrderCase& order_case, const Family& reference,
               const Norm& norm) {
  if (!order_case.expected) return;
  const double order = (*order_case.expected).*norm.order;
  io::Curve guide{"order " + io::rounded(order, 3), {}, {}, io::Style::slope};
  for (const Measured& each : reference) {
    guide.x.push_back(each.h);
    guide.y.push_back(0.4 * reference.front().error.*norm.error *
                      std::pow(each.h / reference.front().h, order));
  }
  panel.curves.push_back(guide);
}

// Methods that tend to one law: the reference has no λr error, or next to none.
struct Compared {
  NamedMethod reference;
  NamedMethod second;  ///< as good as the reference: their distance is what both are good for
  std::vector<NamedMethod> fitted, drawn;
};

std::vector<NamedMethod> over_lambda_r(const rheology::Regularisation& regularisation,
                                       const std::string& label,
                                       const std::vector<double>& lambdas) {
  std::vector<NamedMethod> methods;
  for (const double lambda_r : lambdas) {
    methods.push_back(newton_method(regularisation, lambda_r));
    methods.back().label = label + ", λr " + short_power(lambda_r);
  }
  return methods;
}

Compared tending_to_eq_4() {
  Compared compared{reference_method(), newton_method(rheology::ChauchatMedale{}, 1e-14),
                    yield_stress_methods(1e-14),
                    over_lambda_r(rheology::ChauchatMedale{}, "eq. (12)", {1e-4, 1e-6, 1e-8})};
  for (NamedMethod& method : compared.fitted) method.label += ", λr 1e-14";
  for (NamedMethod method : yield_stress_methods(1e-6)) {
    if (method.label == rheology::ChauchatMedale::name) continue;  // drawn above
    method.label += ", λr 1e-6";
    compared.drawn.push_back(method);
  }
  return compared;
}

// A law without yield stress is compared with its own exact profile and its own limit.
Compared tending_to_limit_of(const NamedMethod& method) {
  const auto& law = method.options.regularisation;
  return {over_lambda_r(law, method.label, {1e-14}).front(),
          newton_method(law, 1e-14),
          {},
          over_lambda_r(law, method.label, {1e-6, 1e-8, 1e-10})};
}

void study_case(Chapter& chapter, io::Table& table, io::Figure& figure,
                const oned::ShearScene& scene, const oned::OrderCase& order_case,
                const Compared& compared) {
  const std::string label = scene.name + ", " + order_case.name;
  const NamedMethod& reference = compared.reference;
  std::vector<oned::Solution> references;
  for (const oned::MeshOptions& mesh : meshes_of(order_case))
    references.push_back(solve_or_nan(scene, oned::boundaries(scene, mesh), reference.options));
  std::vector<io::Panel> panels = {panel_of(label, norms[0]), panel_of(label, norms[1])};
  std::vector<io::Curve> at_floor(panels.size(), {"at the λr floor", {}, {}, io::Style::rings});
  std::vector<oned::Solution> seconds;
  for (const oned::MeshOptions& mesh : meshes_of(order_case))
    seconds.push_back(solve_or_nan(scene, oned::boundaries(scene, mesh), compared.second.options));
  const Family exact_law = measure(scene, order_case, reference, seconds);
  fit_orders(chapter, table, label, order_case, reference.label, exact_law);
  const auto fit = [&](const std::string& method, const Family& family) {
    if (order_case.expected) fit_orders(chapter, table, label, order_case, method, family);
  };
  const auto show = [&](const std::string& name, const Family& family) {
    for (std::size_t i = 0; i < panels.size(); ++i) add_curves(panels[i], name, family, norms[i]);
  };
  show(reference.label, exact_law);
  for (const NamedMethod& method : compared.fitted)
    fit(method.label, measure(scene, order_case, method, references));
  for (const NamedMethod& method : compared.drawn) {
    const Family family = measure(scene, order_case, method, references);
    fit(method.label, family);
    show(method.label, family);
    for (std::size_t i = 0; i < panels.size(); ++i) add_floor(at_floor[i], family, norms[i]);
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].curves.push_back(at_floor[i]);
    add_guide(panels[i], order_case, exact_law, norms[i]);
    figure.panels.push_back(panels[i]);
  }
}

}  // namespace

void answer_orders(Chapter& chapter, const std::string& where, Kind kind) {
  double farthest = 0;
  int count = 0;
  for (const Check& each : chapter.checks) {
    if (each.kind != kind || each.what.find("order ") == std::string::npos) continue;
    farthest = solve::nan_max(farthest, std::abs(each.value - (each.lower + each.upper) / 2));
    ++count;
  }
  chapter.answer(where + " the " + std::to_string(count) + " fitted orders are within " +
                 known(farthest, 2) + " of theory.");
}

void orders_of(Chapter& chapter, const std::vector<oned::ShearScene>& scenes,
               const Context& context) {
  chapter.text(
      "Quadratic elements, exact solutions (17) and (18). Three norms are true ones; the paper's "
      "“RMS” is the root mean square divided by sqrt(N), which adds ½ to every order. Bagnold's "
      "profile has a singular second derivative at the free surface: expected are order 2 on "
      "uniform meshes, 3 on graded ones. The chute's profile has a kink in its slope at y0: order "
      "3 with a node "
      "there, 2 with y0 at a fixed place inside an element, and none that could be fitted on plain "
      "uniform meshes, where y0 falls elsewhere in its element each time. The control law has no "
      "yield stress and no plug; its slope jumps by 5% where its creep ends, at y0 = μ(I1) p, and "
      "its λr error is measured against λr = 1e-14, since the interior point solves eq. (4).");
  io::Table table{
      "Fitted orders (expected). Meshes where the λr error, measured against the "
      "first method of the case on the same mesh (of that one: its distance from eq. (12) at "
      "1e-14, round-off), exceeds 3% of the mesh error in the same norm are left out.",
      {"case", "method", "L2", "maximum", "nodal maximum", "paper's RMS"},
      {}};
  struct Drawn {
    oned::ShearScene scene;
    Compared compared;
    std::string figure, caption;
  };
  std::vector<Drawn> all;
  for (const auto& scene : scenes) {
    all.push_back({scene, tending_to_eq_4(), "orders_" + scene.name,
                   "The interior point has no λr and so no floor; a regularised law leaves the "
                   "mesh order where λr takes over."});
    for (const NamedMethod& method : newton_methods(1e-14))
      if (!has_yield_stress(method))
        all.push_back({scene_for(scene, method), tending_to_limit_of(method),
                       "orders_" + scene.name + "_" + method.label,
                       "The control law " + method.label + " against its own exact profile."});
  }
  std::size_t cases = 0, done = 0;
  for (const Drawn& each : all) cases += each.scene.order_cases.size();
  for (const Drawn& each : all) {
    const oned::ShearScene& scene = each.scene;
    io::Figure figure{each.figure,
                      "Errors of the " + scene.title +
                          " on a line against element size, methods and λr in the key. " +
                          each.caption,
                      {},
                      2};
    for (oned::OrderCase order_case : scene.order_cases) {
      if (context.full) order_case.elements.push_back(2 * order_case.elements.back());
      study_case(chapter, table, figure, scene, order_case, each.compared);
      context.progress(static_cast<double>(++done) / static_cast<double>(cases));
    }
    const bool has_rings = std::ranges::any_of(figure.panels, [](const io::Panel& panel) {
      return std::ranges::any_of(panel.curves, [](const io::Curve& curve) {
        return curve.style == io::Style::rings && !curve.x.empty();
      });
    });
    if (has_rings) figure.caption += " Rings: left out of the fits.";
    chapter.figure(std::move(figure));
  }
  chapter.table(std::move(table));
}

void line_orders(Chapter& chapter, const Context& context) {
  orders_of(chapter, oned::scenes(), context);
  // The reference value of the graded mesh.
  const auto bagnold = scene_of(oned::Bagnold{});
  const auto solution =
      solve_or_nan(bagnold, oned::boundaries(bagnold, {.elements = 160, .grading = 2}),
                   newton_method(rheology::ChauchatMedale{}, bagnold.lambda_r).options);
  chapter.check(Kind::exact, "bagnold, graded (exponent 2), 160 elements: L2 error",
                oned::errors(solution, bagnold).l2, 0.9 * 2.5e-8, 1.1 * 2.5e-8);
  answer_orders(chapter, "On a line", Kind::exact);
}

}  // namespace talus::verification
