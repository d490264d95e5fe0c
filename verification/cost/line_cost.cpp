// Work and precision on a line: error against CPU time, the Pareto front, and the cheapest way to
// an error.
#include <algorithm>
#include <array>
#include <limits>

#include "common/solve/stopwatch.hpp"
#include "verification/cost/cost_parts.hpp"
#include "verification/harness/methods.hpp"

namespace talus::verification {
namespace {

/// One way to solve a scene: what it costs and how far it gets.
struct Run {
  std::string method, mesh;
  int elements;
  int iterations;
  double seconds, error;
  bool on_front = false;
};

// The smallest of several repetitions: other processes only ever add time.
oned::Solution timed(const oned::ShearScene& scene, const std::vector<double>& line,
                     const oned::SolveOptions& options, double enough = 5e-3) {
  constexpr int most = 20;
  oned::Solution best = oned::solve(scene, line, options);
  double total = best.seconds;
  for (int i = 1; i < most && total < enough; ++i) {
    oned::Solution again = oned::solve(scene, line, options);
    total += again.seconds;
    if (again.seconds < best.seconds) best = std::move(again);
  }
  return best;
}

constexpr std::array drawn_lambda_r{1e-4, 1e-6, 1e-8, 1e-12};

std::string labelled(const NamedMethod& method, double lambda_r) {
  return method.label + ", λr " + short_power(lambda_r);
}

std::vector<NamedMethod> compared_methods() {
  std::vector<NamedMethod> methods;
  for (const double lambda_r : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12})
    for (NamedMethod method : newton_methods(lambda_r)) {
      method.label = labelled(method, lambda_r);
      // On the finest meshes a few need the way down in λr; it is part of what they cost.
      method.options.continuation = shear::Continuation::on_failure;
      methods.push_back(method);
    }
  methods.push_back(reference_method());
  return methods;
}

void mark_front(std::vector<Run>& runs) {
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.seconds < b.seconds; });
  double best = std::numeric_limits<double>::infinity();
  for (Run& run : runs) {
    run.on_front = run.error < best;
    best = std::min(best, run.error);
  }
}

// Of one method on the meshes of a family, the coarsest first.
io::Curve curve_of(const std::vector<Run>& runs, const std::string& mesh, const std::string& method,
                   const std::string& label) {
  std::vector<const Run*> of_method;
  for (const Run& run : runs)
    if (run.mesh == mesh && run.method == method) of_method.push_back(&run);
  std::ranges::sort(of_method, {}, &Run::elements);
  io::Curve curve{label, {}, {}};
  for (const Run* run : of_method) {
    curve.x.push_back(run->seconds);
    curve.y.push_back(run->error);
  }
  return curve;
}

// Every λr has a panel of its own, so that laws can be told apart; of a single law all share one.
std::vector<std::vector<double>> panels_of(const std::vector<Run>& runs) {
  const auto is_drawn = [&](const NamedMethod& method) {
    return std::ranges::find(runs, labelled(method, drawn_lambda_r[0]), &Run::method) != runs.end();
  };
  if (std::ranges::count_if(newton_methods(drawn_lambda_r[0]), is_drawn) == 1)
    return {{drawn_lambda_r.begin(), drawn_lambda_r.end()}};
  std::vector<std::vector<double>> panels;
  for (const double lambda_r : drawn_lambda_r) panels.push_back({lambda_r});
  return panels;
}

// For each family of meshes, with every law and what has no λr.
io::Figure front_figure(const oned::ShearScene& scene, const std::string& name,
                        const std::vector<Run>& runs) {
  io::Figure figure{name,
                    "The " + scene.title +
                        " on a line: L2 error of the velocity against CPU time "
                        "of one solve (best of several); every point is a mesh. In the last panel "
                        "every run, and their Pareto front: nothing cheaper is as "
                        "accurate.",
                    {},
                    2};
  for (const auto& order_case : scene.order_cases)
    for (const std::vector<double>& shared : panels_of(runs)) {
      io::Panel panel{scene.name + ", " + order_case.name,
                      "CPU seconds",
                      "L2 error / (d sqrt(g))",
                      true,
                      true,
                      {}};
      if (shared.size() == 1) panel.title += ", λr " + short_power(shared[0]);
      for (const double lambda_r : shared)
        for (const NamedMethod& method : newton_methods(lambda_r)) {
          const std::string label = labelled(method, lambda_r);
          panel.curves.push_back(
              curve_of(runs, order_case.name, label, shared.size() == 1 ? method.label : label));
        }
      const std::string without = reference_method().label;
      panel.curves.push_back(curve_of(runs, order_case.name, without, without));
      std::erase_if(panel.curves, [](const io::Curve& curve) { return curve.x.empty(); });
      figure.panels.push_back(panel);
    }
  io::Panel front{scene.name + ", all meshes and methods",
                  "CPU seconds",
                  "L2 error / (d sqrt(g))",
                  true,
                  true,
                  {}};
  io::Curve all{"every run", {}, {}, io::Style::points}, best{"Pareto front", {}, {}};
  for (const Run& run : runs) {
    io::Curve& curve = run.on_front ? best : all;
    curve.x.push_back(run.seconds);
    curve.y.push_back(run.error);
  }
  front.curves = {all, best};
  figure.panels.push_back(front);
  return figure;
}

void cheapest(io::Table& table, const std::string& scene, const std::vector<Run>& runs) {
  for (const double target : {1e-3, 1e-6, 1e-9}) {
    const auto found = std::find_if(runs.begin(), runs.end(), [&](const Run& run) {
      return run.error <= target;
    });  // runs ascend in time
    if (found == runs.end()) {
      table.rows.push_back({scene, short_power(target), "none of them", "", "", "", "", ""});
      continue;
    }
    table.rows.push_back({scene, short_power(target), found->method, found->mesh,
                          std::to_string(found->elements), std::to_string(found->iterations),
                          io::rounded(found->error, 2), io::rounded(1e3 * found->seconds, 2)});
  }
}

// Residual, tangent and solve of one Newton iteration, per element.
void kernel_speed(Chapter& chapter) {
  io::Table table{
      "Nanoseconds of CPU time per element and Newton iteration (residual, tangent, "
      "condensation, solve and line search), and per factorisation of the interior "
      "point; one thread",
      {"scene", "method", "elements", "ns"},
      {}};
  constexpr int repetitions = 9;
  for (const auto& scene : oned::scenes())
    for (const int elements : {1000, 4000}) {
      const auto line = oned::boundaries(scene, {.elements = elements});
      std::vector<NamedMethod> methods = newton_methods(1e-6);
      methods.push_back(reference_method());
      for (const NamedMethod& method : methods) {
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i < repetitions; ++i) {
          auto space = oned::space_of(scene, line);
          const auto load = oned::load_of(scene);
          double seconds;
          int iterations;
          if (method.options.method == oned::Method::newton) {
            auto problem = shear::regularised_problem(space, load, method.options);
            shear::ShearFlow<1>::State w(space.node_count());
            const solve::Stopwatch watch;
            iterations = solve::newton(problem, w, method.options.newton).iterations();
            seconds = watch.seconds();
          } else {
            auto problem = shear::InteriorPoint<1>(space, load.law, load.pressure, load.body_force);
            auto state = problem.start();
            const solve::Stopwatch watch;
            iterations = problem.solve(state, method.options.interior_point).factorisations();
            seconds = watch.seconds();
          }
          best = std::min(best, seconds / iterations / elements);
        }
        table.rows.push_back(
            {scene.name, method.label, std::to_string(elements), io::rounded(1e9 * best, 3)});
      }
    }
  chapter.table(std::move(table));
}

// What keeping the iterate's rounding costs.
void precision_cost(Chapter& chapter) {
  io::Table table{
      "Newton's iterate in double, and in double with its rounding kept; eq. (12), 320 "
      "elements",
      {"scene", "λr", "precision", "end", "iterations", "residual",
       "L2 distance to the "
       "interior point",
       "CPU ms", "ratio of times"},
      {}};
  for (const auto& scene : oned::scenes()) {
    const auto line = oned::boundaries(scene, {.elements = 320});
    const auto reference = oned::solve(scene, line, reference_method().options);
    for (const double lambda_r : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      NamedMethod method = newton_method(rheology::ChauchatMedale{}, lambda_r);
      double plain_seconds = 0;
      for (const auto precision : {solve::Precision::plain, solve::Precision::compensated}) {
        method.options.precision = precision;
        const auto solution = timed(scene, line, method.options);
        const bool is_plain = precision == solve::Precision::plain;
        if (is_plain) plain_seconds = solution.seconds;
        table.rows.push_back({scene.name, short_power(lambda_r), is_plain ? "plain" : "compensated",
                              solve::name_of(solution.end), std::to_string(solution.iterations()),
                              io::rounded(solution.newton.newton.final_residual(), 2),
                              io::rounded(oned::distance(solution, reference).l2, 3),
                              io::rounded(1e3 * solution.seconds, 3),
                              is_plain ? "" : io::rounded(solution.seconds / plain_seconds, 2)});
      }
    }
  }
  chapter.table(std::move(table));
}

}  // namespace

void line_costs(Chapter& chapter, const Context& context) {
  chapter.text(
      "CPU time of the process, set-up included, best of several runs. Times depend on the "
      "machine; compare within one report only. No time is a pass or a failure here. The control "
      "law "
      "without yield stress is measured against its own exact profile, on fronts of its own.");
  io::Table table{
      "Cheapest way to an L2 error",
      {"scene", "L2 error", "method", "mesh", "elements", "iterations", "reached", "CPU ms"},
      {}};
  const auto scenes = oned::scenes();
  const auto methods = compared_methods();
  const double enough = context.full ? 5e-3 : 1e-3;  // seconds of repetitions
  std::size_t done = 0;
  int failures = 0;
  for (const auto& scene : scenes) {
    // Laws without yield stress solve another problem: an error of theirs is to their own profile,
    // and a time of theirs does not compete.
    std::vector<Run> runs, control_runs;
    for (const NamedMethod& method : methods) {
      const oned::ShearScene own = scene_for(scene, method);
      for (const auto& order_case : own.order_cases)
        for (const auto& mesh : doubled_meshes(order_case.mesh, context.full ? 10240 : 2560)) {
          const auto solution = timed(own, oned::boundaries(own, mesh), method.options, enough);
          failures += solve::is_success(solution.end) ? 0 : 1;
          (has_yield_stress(method) ? runs : control_runs)
              .push_back({method.label, order_case.name, mesh.elements, solution.iterations(),
                          solution.seconds, oned::errors(solution, own).l2});
        }
      context.progress(0.9 * static_cast<double>(++done) /
                       static_cast<double>(scenes.size() * methods.size()));
    }
    mark_front(runs);
    chapter.figure(front_figure(scene, "cost_" + scene.name, runs));
    cheapest(table, scene.name, runs);
    mark_front(control_runs);
    chapter.figure(front_figure(scene, "cost_" + scene.name + "_control", control_runs));
    cheapest(table, scene.name + ", control law", control_runs);
  }
  chapter.check(Kind::self_consistency, "solves that did not succeed", failures, 0, 0);
  chapter.table(std::move(table));
  precision_cost(chapter);
  kernel_speed(chapter);
}

}  // namespace talus::verification
