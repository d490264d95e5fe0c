// The harness itself: does it fail where it should?
#include <cmath>
#include <limits>
#include <set>

#include <boost/test/unit_test.hpp>

#include "verification/cost/scene_cost.hpp"
#include "verification/cylinder/cylinder_runs.hpp"
#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"
#include "verification/heap/heap_study.hpp"
#include "verification/orders/orders_parts.hpp"
#include "verification/paper/paper_parts.hpp"
#include "verification/references/references_study.hpp"
#include "verification/stability/line_answer.hpp"
#include "verification/stability/model_maps.hpp"

BOOST_AUTO_TEST_SUITE(verification_test)

using namespace talus;
using verification::Chapter;
using verification::Kind;

namespace {

int failures(const Chapter& chapter) {
  int count = 0;
  for (const auto& check : chapter.checks) count += check.passed() ? 0 : 1;
  return count;
}

int failures_of_orders(const oned::ShearScene& scene) {
  Chapter chapter;
  verification::orders_of(chapter, {scene}, {});
  return failures(chapter);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_check_keeps_both_bounds_and_nan_keeps_none) {
  Chapter chapter;
  chapter.check(Kind::self_consistency, "inside", 2, 1, 3);
  BOOST_TEST(chapter.passed());
  for (const double outside : {0.9, 3.1, std::numeric_limits<double>::quiet_NaN()}) {
    Chapter other = chapter;
    other.check(Kind::self_consistency, "outside", outside, 1, 3);
    BOOST_TEST(!other.passed());
  }
}

BOOST_AUTO_TEST_CASE(every_kind_of_check_has_a_name_of_its_own_and_is_read_back) {
  for (const Kind kind : verification::kinds_of_checks)
    BOOST_TEST((verification::kind_named(verification::name_of(kind)) == kind));
  BOOST_CHECK_THROW(verification::kind_named("hearsay"), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(a_number_of_another_code_is_held_within_its_uncertainty_and_names_its_source) {
  const verification::Reference known{10, 0.5, "a book", Kind::publication};
  Chapter chapter;
  BOOST_TEST(chapter.check("ours", 10.4, known));
  BOOST_TEST(chapter.checks.front().what == "ours (a book)");
  BOOST_TEST((chapter.checks.front().kind == Kind::publication));
  for (const double apart : {9.4, 10.6, std::numeric_limits<double>::quiet_NaN()})
    BOOST_TEST(!chapter.check("ours", apart, known));
  BOOST_TEST(chapter.check("ours", 10.9, known.within(0.1)));
  BOOST_TEST(verification::references::cylinder_creep(0.04).drag.value == 4.61716);
  BOOST_CHECK_THROW(verification::references::cylinder_creep(0.02), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(the_fitted_order_of_a_power_law_is_its_exponent) {
  std::vector<double> h, error;
  for (int k = 0; k < 5; ++k) {
    h.push_back(std::pow(0.5, k));
    error.push_back(7 * std::pow(h.back(), 2.5));
  }
  BOOST_TEST(verification::fitted_order(h, error) == 2.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::isnan(verification::fitted_order({1}, {1})));
}

BOOST_AUTO_TEST_CASE(studies_and_parts_have_names_of_their_own_and_a_question) {
  std::set<std::string> names, parts;
  std::size_t count = 0;
  for (const auto& study : verification::studies()) {
    names.insert(study.name);
    BOOST_TEST(study.question.back() == '?');
    BOOST_TEST(!study.parts.empty());
    for (const auto& part : study.parts) {
      ++count;
      parts.insert(study.name_of(part));
      BOOST_TEST(part.name.find('/') == std::string::npos);
      BOOST_TEST(part.name.empty() == (study.parts.size() == 1));
      BOOST_TEST(part.minutes.quick > 0);
      BOOST_TEST(part.minutes.full >= part.minutes.quick);
    }
  }
  BOOST_TEST(names.size() == verification::studies().size());
  BOOST_TEST(parts.size() == count);
}

// Negative controls of the orders study: each breaks one thing it rests on.
BOOST_AUTO_TEST_CASE(a_wrong_exact_solution_destroys_the_orders) {
  for (oned::ShearScene scene : oned::scenes()) {
    const auto right = scene.exact_velocity;
    scene.exact_velocity = [right](double x) { return (1 + 1e-4) * right(x); };
    BOOST_TEST(failures_of_orders(scene) > 0, scene.name);
  }
}

BOOST_AUTO_TEST_CASE(a_wrong_pressure_destroys_the_orders) {
  for (oned::ShearScene scene : oned::scenes()) {
    const auto right = scene.pressure;
    scene.pressure = [right](double x) { return (1 + 1e-4) * right(x); };
    BOOST_TEST(failures_of_orders(scene) > 0, scene.name);
  }
}

BOOST_AUTO_TEST_CASE(an_order_half_off_is_rejected) {
  for (oned::ShearScene scene : oned::scenes()) {
    for (auto& each : scene.order_cases)
      if (each.expected) each.expected->l2 += 0.5;
    BOOST_TEST(failures_of_orders(scene) > 0, scene.name);
  }
}

BOOST_AUTO_TEST_CASE(a_solve_that_fails_leaves_no_number_that_a_check_lets_pass) {
  const auto scene = scene_of(oned::Chute{});
  const auto line = oned::boundaries(scene, {.elements = 5});
  auto method = verification::newton_method(rheology::ChauchatMedale{}, 1e-6);
  const auto found = verification::solve_or_nan(scene, line, method.options);
  BOOST_TEST(std::isfinite(oned::errors(found, scene).max));
  BOOST_TEST(verification::counted_iterations(found) > 0);
  method.options.newton.max_iterations = 1;
  const auto failed = verification::solve_or_nan(scene, line, method.options);
  for (const auto& error : {oned::errors(failed, scene), oned::distance(found, failed)})
    for (const double each : {error.l2, error.max, error.nodal_max, error.paper_rms,
                              error.shear_rate.l2, error.stress.max})
      BOOST_TEST(std::isnan(each));
  BOOST_TEST(std::isnan(verification::counted_iterations(failed)));
  BOOST_TEST(std::isnan(oned::velocity_at(failed, 0)));
}

// Newton and the interior point against an answer that neither had a part in.
BOOST_AUTO_TEST_CASE(the_answer_element_by_element_is_that_of_the_solvers) {
  for (const auto& scene : oned::scenes())
    for (const int elements : {3, 20}) {
      const auto line = oned::boundaries(scene, {.elements = elements, .grading = 1.5});
      const auto apart = [&](const verification::NamedMethod& method,
                             const verification::RateLaw& law) {
        const auto solution = oned::solve(scene, line, method.options);
        return (solution.velocity.value() - line_answer(scene, solution.space, law))
            .lpNorm<Eigen::Infinity>();
      };
      BOOST_TEST(apart(verification::reference_method(), verification::rate_of(scene.law())) <
                 1e-11);
      for (const auto& kind : rheology::regularisations()) {
        auto method = verification::newton_method(kind, 1e-3);
        method.options.newton.tolerance = 1e-16;
        const rheology::Rheology law(scene.law(), kind, 1e-3);
        BOOST_TEST(apart(method, verification::rate_of(law)) < 1e-11, method.label);
        rheology::Rheology other = law;
        other.lambda_r *= 1 + 1e-4;
        BOOST_TEST(apart(method, verification::rate_of(other)) > 1e-11, method.label);
      }
    }
}

// The paper's table of findings: its verdicts follow their checks.
BOOST_AUTO_TEST_CASE(a_wrong_scene_turns_the_verdicts_on_the_paper) {
  const auto verdicts = [](const oned::ShearScene& chute, const oned::ShearScene& bagnold) {
    Chapter chapter;
    const verification::Context quick;
    verification::paper_lines_of(chapter, chute, bagnold, quick);
    std::set<std::string> open;
    for (const auto& row : std::get<io::Table>(chapter.blocks[1]).rows)
      if (row.back() == verification::open_verdict) open.insert(row.front());
    return open;
  };
  auto chute = scene_of(oned::Chute{}), bagnold = scene_of(oned::Bagnold{});
  BOOST_TEST(verdicts(chute, bagnold).empty());
  for (oned::ShearScene* scene : {&chute, &bagnold}) {
    const auto velocity = scene->exact_velocity, rate = scene->exact_shear_rate;
    scene->exact_velocity = [velocity](double x) { return 1.01 * velocity(x); };
    scene->exact_shear_rate = [rate](double x) { return 1.1 * rate(x); };
  }
  const auto open = verdicts(chute, bagnold);
  for (const std::string item : {"Fig. 2", "Fig. 3a", "Fig. 4", "Fig. 6", "Fig. 7", "Fig. 7 in 3D"})
    BOOST_TEST(open.contains(item), item);
}

// Another law, another mesh, a solve that fails: each is further from what is known than its room.
BOOST_AUTO_TEST_CASE(numbers_of_others_are_missed_by_whatever_is_not_their_scene) {
  using verification::references::KnownCase;
  const auto missed = [](std::vector<KnownCase> cases, const std::string& words) {
    for (KnownCase& each : cases) each.words += words;
    Chapter chapter;
    verification::check_known(chapter, "heap", cases, {});
    return std::pair(failures(chapter), chapter.checks.size());
  };
  const std::string command = "--elements 18x25 --method newton --lambda-r 1e-5 --angle 0.41";
  std::vector<KnownCase> cases = verification::references::known_cases({"heap"});
  std::erase_if(cases, [&](const KnownCase& each) { return each.words != command; });
  BOOST_REQUIRE(cases.size() == 1U);
  BOOST_TEST((missed(cases, "") == std::pair(0, std::size_t{4})));
  for (const std::string wrong :
       {" --regularisation papanastasiou", " --grading-to-wall 1.1", " --friction 0.384,0.26,0.279",
        " --max-iterations 1 --no-continuation"})
    BOOST_TEST((missed(cases, wrong) == std::pair(4, std::size_t{4})), wrong);
}

BOOST_AUTO_TEST_CASE(a_heap_of_another_friction_misses_every_flow_rate_that_is_known) {
  twod::Section section;
  section.angle = 0.42;
  section.law.mu_s += 1e-4;
  Chapter chapter;
  verification::heap_mesh_error(chapter, {}, section);
  int missed = 0, known = 0;
  for (const auto& check : chapter.checks) {
    if (check.kind != Kind::other_code) continue;
    ++known;
    missed += check.passed() ? 0 : 1;
  }
  BOOST_TEST(known == 2);
  BOOST_TEST(missed == known);
}

BOOST_AUTO_TEST_CASE(a_path_without_a_point_has_no_number) {
  const verification::Followed none;
  for (const double each :
       {none.last().drag, none.last().mean_velocity, none.last().imbalance(),
        none.last().ill_posed_share, none.largest_loading(), none.smallest_lambda_r()})
    BOOST_TEST(std::isnan(each));
}

// What a caption gives is computed.
BOOST_AUTO_TEST_CASE(a_range_in_words_is_that_of_its_numbers_and_nan_is_not_known) {
  verification::Range range;
  BOOST_TEST(range.text(2) == "not known");
  range.add(2);
  BOOST_TEST(range.text(2) == "2");
  range.add(-1.234);
  BOOST_TEST(range.text(2) == "-1.2 to 2");
  range.add(std::numeric_limits<double>::quiet_NaN());
  range.add(3);
  BOOST_TEST(range.text(2) == "not known");
  BOOST_TEST(verification::known(std::numeric_limits<double>::quiet_NaN(), 2) == "not known");
}

BOOST_AUTO_TEST_CASE(cases_that_do_not_arrive_fail_the_work_and_the_map_of_their_scene) {
  const auto told = [](double) {};
  const auto failed_of = [&](const std::string& words) {
    Chapter work, map;
    verification::add_work_precision(work, {{"chute", "chute", "--elements 5,20 " + words}}, told);
    verification::add_model_maps(
        map, {{"chute", "chute", "chute", "--elements 5,20 " + words, 1, 1, 0.5}}, told);
    return std::pair(failures(work), failures(map));
  };
  BOOST_TEST((failed_of("--lambda-r 1e-8") == std::pair(0, 0)));
  BOOST_TEST((failed_of("--max-iterations 1 --no-continuation") == std::pair(1, 1)));
  // A broken tangent that arrives would not be one.
  BOOST_TEST(failed_of("--lambda-r 1e-1,1 --tangent frozen").second == 1);
}

BOOST_AUTO_TEST_CASE(every_law_of_the_registry_is_in_the_work_of_every_scene_and_model) {
  std::set<std::string> models;
  for (const bool full : {false, true})
    for (const auto& question : verification::work_questions(full)) {
      models.insert(question.scene + question.title.substr(question.title.find(',')));
      if (question.title == "cylinder, above yield") continue;  // eq. (9)-(12) fold on these meshes
      for (const auto& law : rheology::regularisations())
        BOOST_TEST(question.words.find(rheology::name_of(law)) != std::string::npos,
                   question.title << " lacks " << rheology::name_of(law));
    }
  BOOST_TEST(models.size() == 12U);
}

BOOST_AUTO_TEST_SUITE_END()
