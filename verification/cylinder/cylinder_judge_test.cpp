// What is said of the cylinder's runs: made-up runs that are as they should be hold every check,
// and each thing that may go wrong fails one and turns the sentence that rests on it.
#include <cmath>
#include <numbers>

#include <boost/test/unit_test.hpp>

#include "verification/cylinder/cylinder_parts.hpp"
#include "verification/stability/cylinder_atlas.hpp"

BOOST_AUTO_TEST_SUITE(cylinder_judge_test)

using namespace talus;
using namespace talus::verification;
using twod::Continuation;
using twod::CylinderMeasures;

namespace {

const rheology::Regularisation yielding = rheology::ChauchatMedale{},
                               control = laws_of_paths().back();

std::string text_of(const Chapter& chapter) {
  std::string text;
  for (const auto& block : chapter.blocks)
    if (const auto* paragraph = std::get_if<std::string>(&block)) text += *paragraph + '\n';
  return text;
}

// Every check holds, and the sentence says so.
void holds(const Chapter& chapter, const std::string& sentence = "") {
  for (const Check& check : chapter.checks) BOOST_TEST(check.passed(), check.what);
  BOOST_TEST(!chapter.checks.empty());
  BOOST_TEST(text_of(chapter).find(sentence) != std::string::npos, text_of(chapter));
}

// A check fails, and the sentence says so.
void fails(const Chapter& chapter, const std::string& sentence = "", const std::string& of = "") {
  BOOST_TEST(!chapter.passed(), of);
  BOOST_TEST(text_of(chapter).find(sentence) != std::string::npos, of << ": " << text_of(chapter));
  BOOST_TEST(text_of(chapter).find("nan") == std::string::npos, of << ": " << text_of(chapter));
}

// In equilibrium, with walls and drag.
CylinderMeasures measures(double loading, double velocity, double drag, double lambda_r = 1e-6) {
  CylinderMeasures m;
  m.loading = loading;
  m.lambda_r = lambda_r;
  m.mean_velocity = velocity;
  m.drag = drag;
  m.wall_force = 1;
  m.weight = drag + m.wall_force;
  return m;
}

// A column that stands on something: its drag is its buoyancy.
CylinderMeasures at_rest(double loading, double lambda_r = 1e-6) {
  return measures(loading, 0, -std::numbers::pi / 4 * loading, lambda_r);
}

CylinderMeasures not_found() {
  return Followed{}.last();
}

Creep creep(const CylinderMeasures& m) {
  return {.measures = m, .seconds = 1};
}

// A path with one point at each of these.
Followed path(const std::vector<CylinderMeasures>& measures,
              solve::PathEnd end = solve::PathEnd::target_reached) {
  return {
      .end = end, .measures = measures, .points = std::vector<solve::PathPoint>(measures.size())};
}

Followed with_fold(Followed followed) {
  followed.points.back().is_fold_passed = true;
  return followed;
}

template <class Judge, class... Runs>
Chapter judged(const Judge& judge, const Runs&... runs) {
  Chapter chapter;
  judge(chapter, runs...);
  return chapter;
}

}  // namespace

BOOST_AUTO_TEST_CASE(creep_on_a_mesh_that_is_wrong_fails_a_check_and_turns_its_sentence) {
  std::vector<FinerMeshes> right(2);
  right[0] = {0.01, {creep(measures(0.01, 4.9e-7, 1.66)), creep(measures(0.01, 4.97e-7, 1.643))}};
  right[1] = {0.04, {creep(measures(0.04, 3.2e-6, 4.7)), creep(measures(0.04, 3.22e-6, 4.617))}};
  for (auto& runs : right) {
    runs.creeps[0].measures.divergence = 0.04;
    runs.creeps[1].measures.divergence = 0.02;
  }
  holds(judged(judge_meshes, right, 0.01), "drag balance to round-off.");
  const auto wrong = [&](const CylinderMeasures& m, std::size_t mesh) {
    auto runs = right;
    runs[1].creeps[mesh] = creep(m);
    return judged(judge_meshes, runs, 0.01);
  };
  for (const std::size_t mesh : {0, 1}) {
    fails(wrong(not_found(), mesh), "should balance to round-off, but a check fails", "failed");
    CylinderMeasures m = right[1].creeps[mesh].measures;
    m.weight *= 1.001;
    fails(wrong(m, mesh), "should balance", "out of balance");
    m = right[1].creeps[mesh].measures;
    m.projected_divergence = 1e-6;
    fails(wrong(m, mesh), "should be round-off", "compressible");
  }
  CylinderMeasures m = right[1].creeps[1].measures;
  m.divergence = 0.04;
  fails(wrong(m, 1), "should fall with their size", "no better than the coarser mesh");
  fails(wrong(at_rest(0.04), 1), "", "at rest");
}

BOOST_AUTO_TEST_CASE(halves_that_differ_fail_or_rest_are_told) {
  const Creep right = creep(measures(0.03, 1.89e-6, 4));
  holds(judged(judge_halves, right, right), "half the domain gives the same digits");
  const std::string told = "should give the digits of the whole, but a check fails";
  const Creep other = creep(measures(0.03, 1.89e-6, 4 * (1 + 1e-8)));
  fails(judged(judge_halves, right, other), told, "other digits");
  for (const auto& m : {not_found(), at_rest(0.03)}) {
    fails(judged(judge_halves, creep(m), right), told, "half");
    fails(judged(judge_halves, right, creep(m)), told, "full");
    fails(judged(judge_halves, creep(m), creep(m)), told, "both");
  }
}

BOOST_AUTO_TEST_CASE(an_outlet_that_fails_or_holds_the_column_is_told) {
  const Creep right = creep(measures(0.044, 4e-6, 5)), near = creep(measures(0.044, 4.4e-6, 5.1)),
              resting = creep(at_rest(0.044, 0.1));
  const std::vector<OutletPair> pairs = {{15, right, near}, {5, right, near}};
  holds(judged(judge_outlets, pairs, resting), "nothing flows");
  holds(judged(judge_outlets, pairs, resting), "the drag differs by 2% at most, U by 10%");
  const std::string told =
      "should be near those of the developed outlet, but a check of that fails";
  for (const auto& m : {not_found(), at_rest(0.044)})
    for (const int place : {0, 1}) {
      for (Creep OutletPair::*which : {&OutletPair::developed, &OutletPair::open}) {
        auto wrong = pairs;
        wrong[place].*which = creep(m);
        fails(judged(judge_outlets, wrong, resting), told, "one outlet");
      }
      auto wrong = pairs;
      wrong[place] = {1, creep(m), creep(m)};
      fails(judged(judge_outlets, wrong, resting), told, "both outlets");
    }
  auto far = pairs;
  far[0].open = creep(measures(0.044, 4e-6, 5.5));
  fails(judged(judge_outlets, far, resting), told, "far apart");
  CylinderMeasures no_drag = resting.measures;
  no_drag.drag = std::nan("");
  for (const auto& m : {not_found(), no_drag, right.measures})
    fails(judged(judge_outlets, pairs, creep(m)), "should rest on the outlet, but a check",
          "all open");
  fails(judged(judge_outlets, std::vector<OutletPair>{}, resting), told, "no outlet at all");
}

BOOST_AUTO_TEST_CASE(a_sweep_that_fails_rests_folds_or_stops_short_fails_a_check) {
  CylinderMeasures ill_posed = measures(0.052, 0.1, 5.7), flow = measures(0.054, 0.15, 6.1),
                   fast = measures(0.07, 4, 7);
  ill_posed.ill_posed_share = 0.1;
  const CylinderMeasures creeping = measures(0.044, 4e-6, 5);
  struct Case {
    Sweep sweep;
    Followed right;
  };
  std::vector<Case> cases;
  for (const auto way : {Continuation::arclength, Continuation::natural, Continuation::primal_dual})
    cases.push_back({{yielding, way}, path({creeping, ill_posed}, solve::PathEnd::out_of_points)});
  for (const auto way : {Continuation::arclength, Continuation::natural})
    cases.push_back({{control, way}, path({creeping, flow})});
  for (const bool inertia : {true, false})
    cases.push_back({{control, Continuation::primal_dual, inertia}, path({creeping, fast})});
  for (const auto& [sweep, right] : cases) {
    const auto wrong = [&](const Followed& f, const std::string& of) {
      fails(judged(judge_sweep, sweep, f), "", sweep.label() + ": " + of);
    };
    holds(judged(judge_sweep, sweep, right));
    wrong({}, "did not start");
    wrong(path({creeping, not_found()}, right.end), "not a number");
    const double reached = right.last().loading;
    wrong(path({at_rest(0.044), at_rest(reached)}, right.end), "stuck at rest");
    if (sweep.is_natural() && rheology::has_yield_stress(sweep.law)) continue;  // its end is a fold
    wrong(path({creeping}, solve::PathEnd::step_too_small), "no step");
    CylinderMeasures slow = right.last();
    slow.mean_velocity = 8e-6;
    wrong(path({creeping, slow}, right.end), "creeps still");
    if (sweep.goes_beyond()) continue;
    CylinderMeasures other = right.last();
    other.ill_posed_share = 0.1 - other.ill_posed_share;
    wrong(path({creeping, other}, right.end), "well-posed where it is not, or the reverse");
    if (rheology::has_yield_stress(sweep.law)) continue;
    wrong(with_fold(right), "a fold where none should be");
    wrong(path(right.measures, solve::PathEnd::step_too_small), "not arrived");
  }
}

BOOST_AUTO_TEST_CASE(a_path_of_the_atlas_that_fails_rests_or_folds_is_told) {
  const CylinderMeasures start = measures(0.054, 0.3, 6, 0.1), end = measures(0.054, 0.15, 6.1);
  const Followed right = path({start, end});
  const WayDown arclength = ways_down()[0], primal_dual = ways_down()[1];
  const auto atlas = [&](const Followed& first, const Followed& second) {
    return judged(judge_atlas, std::vector<LambdaPath>{{control, arclength, 16, first},
                                                       {control, primal_dual, 16, second},
                                                       {yielding, primal_dual, 24, second}});
  };
  holds(atlas(right, right), "3 of 3 arrive");
  holds(atlas(right, right), "Newton's method converges");
  fails(atlas(with_fold(right), right), "3 of 3 arrive", "a fold where none should be");
  const Followed stopped = path({start}, solve::PathEnd::step_too_small);
  fails(atlas(stopped, right), "2 of 3 arrive", "arclength stops");
  fails(atlas(stopped, right), "arclength, 16 around (step_too_small)", "arclength stops");
  const std::string told = "should converge, but a check of that fails";
  fails(atlas(right, stopped), "1 of 3 arrive", "primal-dual stops");
  for (const Followed& f :
       {Followed{}, stopped, path({start, at_rest(0.054)}), path({start, not_found()}),
        path({start, measures(0.054, 1e-5, 6)}), path({start, measures(0.054, 0.15, 6, 1e-5)})}) {
    fails(atlas(right, f), told, "primal-dual");
    fails(atlas(f, right), "", "arclength");
  }
}

BOOST_AUTO_TEST_CASE(a_penalty_that_does_not_arrive_or_moves_the_drag_is_told) {
  const Followed right = path({measures(0.052, 0.09, 5.934)});
  const auto penalties = [&](const Followed& usual, const Followed& iterated,
                             const Followed& plain) {
    return judged(judge_penalties, PenaltyPaths{control,
                                                usual,
                                                {{{mixed::Penalty::iterated, 1e-4}, right},
                                                 {{mixed::Penalty::iterated, 1e-8}, iterated},
                                                 {{mixed::Penalty::iterated, 1e-12}, plain},
                                                 {{mixed::Penalty::plain, 1e-4}, plain}}});
  };
  const Followed stopped = path(right.measures, solve::PathEnd::step_too_small);
  holds(penalties(right, right, right), "every path arrived; the iterated penalty leaves");
  holds(penalties(right, right, stopped),
        "did not arrive: iterated 1e-12, plain 1e-4; the iterated");
  const std::string told = "should leave the drag as it is, λp from 1e-8 to 1e-4, but a check";
  fails(penalties(right, stopped, right), "did not arrive: iterated 1e-8; ", "one stops");
  for (const Followed& f : {Followed{}, stopped, path({not_found()}), path({at_rest(0.052)}),
                            path({measures(0.052, 0.09, 5.936)})}) {
    fails(penalties(right, f, right), told, "one");
    fails(penalties(f, right, right), told, "the usual one");
  }
  const Followed resting = path({at_rest(0.052)});
  PenaltyPaths all_rest{control, resting, {{{mixed::Penalty::iterated, 1e-4}, resting}}};
  fails(judged(judge_penalties, all_rest), told, "all at rest");
  fails(judged(judge_penalties, PenaltyPaths{control, right, {}}), told, "none tried");
}

BOOST_AUTO_TEST_SUITE_END()
