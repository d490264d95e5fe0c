// What an error of the cylinder's drag costs: meshes, half and full domain, and the two penalties.
#include <cmath>
#include <limits>

#include "verification/cost/cost_parts.hpp"
#include "verification/cylinder/cylinder_runs.hpp"
#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"

namespace talus::verification {
namespace {

constexpr double creep_loading = 0.04;
// Limits at λr = 1e-6 as the first layer thins: 24 elements around, extrapolated from layers of
// 0.04, 0.02 and 0.01. More elements around change the fourth digit.
constexpr double limit_drag = 4.609, limit_velocity = 3.222e-6;

struct Family {
  std::string label;
  std::vector<int> arounds;
  double layer = 1;  // first layer, over the default of 3.2/around
  bool full = false;
  mixed::PenaltyOptions penalty = {};
};

std::vector<Family> families(const Context& context) {
  const std::vector<int> arounds =
      context.full ? std::vector{16, 24, 32, 40, 80, 160} : std::vector{16, 24, 32};
  const std::vector<int> full =
      context.full ? std::vector{16, 24, 32, 40, 80} : std::vector{16, 24};
  // In thinner layers than these Newton from rest loses its way.
  const std::vector<int> thin = context.full ? std::vector{16, 24, 32, 40} : full;
  const std::vector<int> few = context.full ? arounds : full;
  return {{"half", arounds},
          {"thin first layer", thin, 0.1},
          {"full", full, 1, true},
          {"plain penalty, 1e-8", few, 1, false, {mixed::Penalty::plain, 1e-8}}};
}

// Extrapolates three values on meshes that are halved each time.
double richardson(double coarse, double middle, double fine) {
  return fine + (fine - middle) * (fine - middle) / ((middle - coarse) - (fine - middle));
}

// Distances of a family from the limits.
struct Errors {
  io::Curve drag, traction, velocity;  // against CPU seconds

  explicit Errors(const std::string& label)
      : drag{label, {}, {}}, traction{label + ", traction integral", {}, {}}, velocity(drag) {}
  void add(const Creep& creep) {
    const auto& m = creep.measures;
    for (io::Curve* curve : {&drag, &traction, &velocity}) curve->x.push_back(creep.seconds);
    drag.y.push_back(std::abs(m.drag / limit_drag - 1));
    traction.y.push_back(std::abs(m.drag_traction / limit_drag - 1));
    velocity.y.push_back(std::abs(m.mean_velocity / limit_velocity - 1));
  }
};

double error_of(double drag) {
  return std::abs(drag / limit_drag - 1);
}

// What the meshes say of the choices, in the order of `families`.
std::string caption_of(const std::vector<std::vector<Creep>>& found) {
  const auto &half = found[0], &thin = found[1], &full = found[2], &plain = found[3];
  Range full_time, full_apart, plain_time, plain_apart;
  const auto compare = [&](const std::vector<Creep>& creeps, Range& time, Range& apart) {
    for (std::size_t i = 0; i < creeps.size(); ++i) {  // the meshes of the half, from the coarsest
      time.add(creeps[i].seconds / half[i].seconds);
      apart.add(std::abs(creeps[i].measures.drag / half[i].measures.drag - 1));
    }
  };
  compare(full, full_time, full_apart);
  compare(plain, plain_time, plain_apart);
  const auto& finest = half.back().measures;
  return "Error of the drag on the finest mesh: " + known(error_of(finest.drag), 2) +
         " by the reactions, " + known(error_of(finest.drag_traction), 2) +
         " by the traction integral; with a first layer ten times thinner " +
         known(error_of(thin.front().measures.drag), 2) +
         " on the coarsest mesh. The whole domain "
         "takes " +
         full_time.text(2) + " times the time of the half and is apart from it by " +
         known(full_apart.upper(), 2) + " at most; the plain penalty takes " + plain_time.text(2) +
         " times the time of the iterated one, and is apart by " + known(plain_apart.upper(), 2) +
         " at most.";
}

void check_limits(Chapter& chapter) {
  std::vector<twod::CylinderMeasures> thinner;
  for (const double layer : {0.04, 0.02, 0.01}) {
    twod::Cylinder scene = cylinder_around(32);
    scene.mesh.first_layer = layer;
    thinner.push_back(creep_at(scene, creep_loading).measures);
  }
  const auto limit = [&](double twod::CylinderMeasures::*measure) {
    return richardson(thinner[0].*measure, thinner[1].*measure, thinner[2].*measure);
  };
  chapter.check(Kind::self_consistency,
                "cylinder: Richardson's limit of the drag over the one used",
                limit(&twod::CylinderMeasures::drag) / limit_drag, 0.999, 1.001);
  chapter.check(Kind::self_consistency, "cylinder: Richardson's limit of U over the one used",
                limit(&twod::CylinderMeasures::mean_velocity) / limit_velocity, 0.999, 1.001);
}

void meshes(Chapter& chapter, const Context& context) {
  io::Panel drag{"Cylinder: drag at F = 0.04", "CPU seconds", "relative error", true, true, {}};
  io::Panel velocity{"Cylinder: U at F = 0.04", "CPU seconds", "relative error", true, true, {}};
  io::Table table{"Creep past the cylinder at F = 0.04, λr = 1e-6",
                  {"case", "around", "elements", "drag", "U", "factorisations", "CPU s"},
                  {}};
  int not_found = 0;
  std::vector<std::vector<Creep>> found;  // by family
  io::Curve traction;  // of the first family, drawn last: its colour is the drag's alone
  for (const Family& family : families(context)) {
    Errors errors(family.label);
    found.emplace_back();
    for (const int around : family.arounds) {
      twod::Cylinder scene = cylinder_around(around);
      scene.mesh.full = family.full;
      scene.mesh.first_layer *= family.layer;
      scene.penalty = family.penalty;
      const Creep creep = creep_at(scene, creep_loading);
      errors.add(creep);
      found.back().push_back(creep);
      not_found += std::isnan(creep.measures.drag) ? 1 : 0;
      table.rows.push_back({family.label, std::to_string(around), std::to_string(creep.elements),
                            io::rounded(creep.measures.drag, 6),
                            io::rounded(creep.measures.mean_velocity, 6),
                            std::to_string(creep.factorisations), io::rounded(creep.seconds, 3)});
    }
    drag.curves.push_back(errors.drag);
    velocity.curves.push_back(errors.velocity);
    if (drag.curves.size() > 1) continue;
    traction = errors.traction;
    std::vector<double> sizes(family.arounds.begin(), family.arounds.end());
    for (double& size : sizes) size = 1 / size;
    chapter.check(Kind::self_consistency, "cylinder: order of the drag in the size of the elements",
                  fitted_order(sizes, errors.drag.y), 0.7, 1.3);
  }
  chapter.check(Kind::self_consistency, "cylinder: meshes on which creep was not found", not_found,
                0, 0);
  drag.curves.push_back(traction);
  chapter.figure({"cost_cylinder",
                  "Error of drag and mean velocity of creep past the cylinder, F = 0.04, λr = "
                  "1e-6, against CPU "
                  "time from rest, every point a mesh. " +
                      caption_of(found),
                  {drag, velocity},
                  2});
  chapter.table(std::move(table));
}

// d drag/dλp of a plain penalty where there is none: the solution moves by -J⁻¹ dR/dλp. NaN if a
// solve fails.
double drag_over_penalty(const twod::Cylinder& scene, double loading) {
  constexpr double failed = std::numeric_limits<double>::quiet_NaN(), step = 1e-9;
  twod::CylinderFlow without(scene);
  twod::CylinderFlow::State state, shift;
  if (!solve::is_success(twod::solve_creep(without, loading, state).end)) return failed;
  twod::Cylinder penalised = scene;
  penalised.penalty = {mixed::Penalty::plain, 1};  // the residual is linear in λp
  twod::CylinderFlow with(penalised);
  with.flow().set_load_factor(loading);
  with.flow().set_lambda_r(scene.lambda_r);
  const Eigen::VectorXd of_penalty = with.flow().evaluate(state).value;
  if (!without.flow().linear_solve(without.flow().evaluate(state).value - of_penalty, shift))
    return failed;
  const auto drag = [&](double lambda_p) {
    return twod::measure(without, state.moved(lambda_p, shift)).drag;
  };
  return (drag(step) - drag(-step)) / (2 * step);
}

// λp from 1e-2 to 1e-12, plain and iterated, against the iterated one at its default.
void penalties(Chapter& chapter) {
  twod::Cylinder scene = cylinder_around(16);
  scene.lambda_r = 1e-4;
  const auto reference = creep_at(scene, 0.03).measures;
  const twod::Cylinder of_reference = scene;
  const double drag = reference.drag;
  // At rest the drag is the buoyancy, whatever the penalty.
  chapter.check(Kind::self_consistency, "penalty: U over λr of the reference",
                reference.mean_velocity / scene.lambda_r, 1.5, 2.5);
  double order = 0, off_at_1e_8 = std::numeric_limits<double>::quiet_NaN();
  double largest_iterated = 0;
  std::string all_iterations;  // in words
  io::Panel error{"Cylinder: penalty", "λp", "relative error of the drag", true, true, {}};
  io::Panel work{"Newton iterations from rest", "λp", "factorisations", true, false, {}};
  io::Panel time{"CPU time from rest", "λp", "CPU seconds", true, false, {}};
  io::Table table{
      "Penalty at F = 0.03, λr = 1e-4, 16 elements around: plain (div u = -λp p) and "
      "iterated (div u = 0, λp only conditions the solves)",
      {"penalty", "λp", "drag", "relative error", "projected div u", "factorisations", "CPU s"},
      {}};
  for (const auto kind : {mixed::Penalty::plain, mixed::Penalty::iterated}) {
    const bool is_plain = kind == mixed::Penalty::plain;
    io::Curve errors{is_plain ? "plain" : "iterated", {}, {}}, iterations = errors,
                                                               seconds = errors;
    double largest = 0;
    Range factorisations;
    for (const double lambda_p : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      scene.penalty = {kind, lambda_p};
      const Creep creep = creep_at(scene, 0.03);
      const double off = std::abs(creep.measures.drag / drag - 1);
      if (is_plain && lambda_p == 1e-8) off_at_1e_8 = creep.measures.drag - drag;
      largest = solve::nan_max(largest, off);
      for (io::Curve* curve : {&errors, &iterations, &seconds}) curve->x.push_back(lambda_p);
      errors.y.push_back(solve::nan_max(off, 1e-16));
      iterations.y.push_back(creep.factorisations);
      factorisations.add(if_counts(std::isfinite(creep.measures.drag), creep.factorisations));
      seconds.y.push_back(creep.seconds);
      table.rows.push_back({errors.label, short_power(lambda_p),
                            io::rounded(creep.measures.drag, 7), io::rounded(off, 2),
                            io::rounded(creep.measures.projected_divergence, 2),
                            std::to_string(creep.factorisations), io::rounded(creep.seconds, 3)});
    }
    all_iterations += (is_plain ? "" : ", ") + errors.label + " " + factorisations.text(4);
    if (is_plain) {  // from larger λp the pressure answers too strongly
      order = std::log10(errors.y[2] / errors.y[3]) / 2;
      chapter.check(Kind::self_consistency, "plain penalty: order of its error in λp, 1e-6 to 1e-8",
                    order, 0.9, 1.1);
      chapter.check(
          Kind::other_method,
          "plain penalty: error of the drag at 1e-8 over what the linearised problem says",
          off_at_1e_8 / (1e-8 * drag_over_penalty(of_reference, 0.03)), 0.98, 1.02);
    } else {
      largest_iterated = largest;
      chapter.check(Kind::self_consistency,
                    "iterated penalty: largest error of the drag, λp from 1e-2 to 1e-12", largest,
                    0, 1e-9);
    }
    error.curves.push_back(errors);
    work.curves.push_back(iterations);
    time.curves.push_back(seconds);
  }
  chapter.figure({"cost_penalty",
                  "What the penalty parameter does to the drag of creep past the cylinder at F = "
                  "0.03, λr = 1e-4, 16 elements around, and what it costs. The error of the plain "
                  "penalty has order " +
                      known(order, 2) + " in λp from 1e-6 to 1e-8, the iterated one is off by " +
                      known(largest_iterated, 2) + " at most. Factorisations: " + all_iterations +
                      ".",
                  {error, work, time},
                  3});
  chapter.table(std::move(table));
}

}  // namespace

void cylinder_costs(Chapter& chapter, const Context& context) {
  if (context.full) check_limits(chapter);
  meshes(chapter, context);
  penalties(chapter);
}

}  // namespace talus::verification
