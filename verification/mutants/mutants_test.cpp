// The instrumented copy means what the catalogue says, and a mutant that is no longer of the code
// is refused.
#include <cmath>
#include <fstream>

#include <boost/test/unit_test.hpp>

#include "common/io/result_folder.hpp"
#include "common/testing/temporary_folder.hpp"
#include "verification/mutants/expression.hpp"
#include "verification/mutants/instrument.hpp"
#include "verification/mutants/verdicts.hpp"

BOOST_AUTO_TEST_SUITE(mutants_test)

using namespace talus;
using namespace talus::mutants;
namespace fs = std::filesystem;

namespace {

Mutant mutant(const std::string& original, const std::string& mutated) {
  return {"area/name", "", "file.cpp", original, mutated};
}

// The second line of what the line becomes, the first includes the choice.
std::string instrumented_line(const std::string& line, const std::vector<Mutant>& mutants) {
  std::vector<Numbered> numbered;
  for (std::size_t i = 0; i < mutants.size(); ++i)
    numbered.push_back({static_cast<int>(i) + 7, &mutants[i]});
  const std::string text = instrumented("first;\n" + line + "\nlast;\n", numbered);
  const std::size_t begin = text.find("first;\n") + 7;
  return text.substr(begin, text.find("\nlast;") - begin);
}

std::string instrumented_as(const std::string& line, const std::string& mutated) {
  return instrumented_line(line, {mutant(line, mutated)});
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_smallest_whole_expression_is_chosen_at_run_time) {
  BOOST_TEST(instrumented_as("  return a + f(b * c, d);", "return a + f(b / c, d);") ==
             "return a + f((talus::mutant::is(7) ? (b / c) : (b * c)), d);");
  BOOST_TEST(instrumented_as("const double x = a + b;  // why", "const double x = a - b;") ==
             "const double x = (talus::mutant::is(7) ? (a - b) : (a + b));");
  BOOST_TEST(instrumented_as("if (a < b && c) x = 1;", "if (a <= b && c) x = 1;") ==
             "if ((talus::mutant::is(7) ? (a <= b && c) : (a < b && c))) x = 1;");
  BOOST_TEST(instrumented_as("return a ? b : -c;", "return a ? b : c;") ==
             "return a ? b : (talus::mutant::is(7) ? (c) : (-c));");
  BOOST_TEST(instrumented_as("double share = 0.02;", "double share = 0.01;") ==
             "double share = (talus::mutant::is(7) ? (0.01) : (0.02));");
  BOOST_TEST(instrumented_as("f(a ? 1 : 0);", "f(a ? 0 : 1);") ==
             "(talus::mutant::is(7) ? (f(a ? 0 : 1)) : (f(a ? 1 : 0)));");
  BOOST_TEST(instrumented_as("for (i = 0; i < n; i += 2) {", "for (i = 0; i < n; i -= 2) {") ==
             "for (i = 0; i < n; (talus::mutant::is(7) ? (i -= 2) : (i += 2))) {");
  BOOST_TEST(instrumented_as("a[i] * b[j] + c;", "a[j] * b[i] + c;") ==
             "(talus::mutant::is(7) ? (a[j] * b[i] + c) : (a[i] * b[j] + c));");
  BOOST_TEST(instrumented_as("out << \"a, (b\" << a;", "out << \"a, (b\" << b;") ==
             "(talus::mutant::is(7) ? (out << \"a, (b\" << b) : (out << \"a, (b\" << a));");
  BOOST_TEST(
      instrumented_as("rows.push_back({f(a), f(b), c});", "rows.push_back({f(b), f(a), c});") ==
      "(talus::mutant::is(7) ? (rows.push_back({f(b), f(a), c})) : (rows.push_back({f(a), "
      "f(b), c})));");
}

BOOST_AUTO_TEST_CASE(statements_are_chosen_whole) {
  BOOST_TEST(instrumented_as("sum += a;", "sum -= a;") ==
             "if (talus::mutant::is(7)) { sum -= a; } else { sum += a; }");
  BOOST_TEST(instrumented_as("sum += a;", "") ==
             "if (talus::mutant::is(7)) {  } else { sum += a; }");
  BOOST_TEST(instrumented_as("if (a) break;", "if (a) continue;") ==
             "if (talus::mutant::is(7)) { if (a) continue; } else { if (a) break; }");
}

BOOST_AUTO_TEST_CASE(several_mutants_share_a_line) {
  const std::string line = "return a * b + c;";
  BOOST_TEST(
      instrumented_line(line,
                        {mutant(line, "return a / b + c;"), mutant(line, "return a * b - c;")}) ==
      "return (talus::mutant::is(7) ? (a / b + c) : (talus::mutant::is(8) ? (a * b - c) : (a "
      "* b + c)));");
  const std::string call = "f(a, b);";
  BOOST_TEST(instrumented_line(call, {mutant(call, "f(b, b);"), mutant(call, "f(a, a);")}) ==
             "f((talus::mutant::is(7) ? (b) : (a)), (talus::mutant::is(8) ? (a) : (b)));");
}

BOOST_AUTO_TEST_CASE(constants_become_variables_and_expressions_of_eigen_plain_objects) {
  BOOST_TEST(instrumented_as("constexpr double c = 2;", "constexpr double c = 3;") ==
             "const double c = (talus::mutant::is(7) ? (3) : (2));");
  Mutant eigen = mutant("x = a + b;", "x = a - b;");
  eigen.form = Form::plain_object;
  BOOST_TEST(instrumented_line("x = a + b;", {eigen}).find("talus::mutant::plain(a - b)") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(stale_ambiguous_and_overlapping_mutants_are_refused) {
  BOOST_CHECK_THROW(instrumented_line("a;", {mutant("b;", "c;")}), io::UserError);
  BOOST_CHECK_THROW(instrumented_line("a;\na;", {mutant("a;", "c;")}), io::UserError);
  BOOST_CHECK_THROW(instrumented_line("a;\nb;", {mutant("a;\nb;", "c;"), mutant("b;", "c;")}),
                    io::UserError);
}

BOOST_AUTO_TEST_CASE(a_catalogue_that_cannot_be_read_names_the_line) {
  const testing::TemporaryFolder folder;
  BOOST_CHECK_THROW(read_catalogue(folder.path()), io::UserError);
  write(folder.path() / "a.txt",
        "# comment\n== f.cpp\none: two\n- a;\n- b;\n+ c;\n= same\nother: three\n- a;\n");
  const std::vector<Mutant> mutants = read_catalogue(folder.path());
  BOOST_REQUIRE(mutants.size() == 2);
  BOOST_TEST(mutants[0].name == "a/one");
  BOOST_TEST(mutants[0].original == "a;\nb;");
  BOOST_TEST(mutants[0].is_equivalent());
  BOOST_TEST(mutants[1].mutated.empty());
  for (const char* wrong :
       {"one: two\n", "== f\n- a;\n", "== f\none two\n", "== f\none: two\n+ a;\n"}) {
    write(folder.path() / "a.txt", wrong);
    BOOST_CHECK_THROW(read_catalogue(folder.path()), io::UserError);
  }
  write(folder.path() / "a.txt", "== f\none: two\n- a;\none: two\n- b;\n");
  BOOST_CHECK_THROW(read_catalogue(folder.path()), io::UserError);
}

BOOST_AUTO_TEST_CASE(a_score_counts_what_is_killed_of_what_is_not_equivalent) {
  std::vector<Mutant> mutants(4, mutant("a", "b"));
  mutants[3].equivalent = "rounding";
  mutants[2].name = "other/name";
  const std::vector<std::optional<Verdict>> verdicts{
      Verdict{"", {"fem_test"}}, Verdict{"", {}}, Verdict{"", {"verify_paper"}}, Verdict{"", {}}};
  const std::vector<Score> all = scores(mutants, {0, 1, 2, 3}, verdicts);
  BOOST_REQUIRE(all.size() == 3);
  BOOST_TEST(all[0].share() == 0.5);
  BOOST_TEST(all.back().mutants == 3);
  BOOST_TEST(all.back().equivalent == 1);
  BOOST_TEST(all.back().killed == 2);
  BOOST_TEST(all.back().killed_by_studies == 1);
  BOOST_TEST(all.back().not_run == 0);
  BOOST_TEST(survivor_table(mutants, verdicts).rows.size() == 1);
}

// Mutants that survive take longest: what an interrupted run has killed is no share of anything.
BOOST_AUTO_TEST_CASE(there_is_no_score_while_a_mutant_has_no_verdict) {
  const std::vector<Mutant> mutants(3, mutant("a", "b"));
  const std::vector<std::optional<Verdict>> verdicts{Verdict{"", {"fem_test"}}, std::nullopt,
                                                     std::nullopt};
  BOOST_TEST(scores(mutants, {0}, verdicts).back().share() == 1);
  const std::vector<Score> cut_short = scores(mutants, {0, 1}, verdicts);
  BOOST_TEST(cut_short.back().mutants == 2);
  BOOST_TEST(cut_short.back().not_run == 1);
  BOOST_TEST(std::isnan(cut_short.back().share()));
  BOOST_TEST(score_table(cut_short, Pursuit::first_kill).rows.back().at(3) == "-");
  BOOST_TEST(std::isnan(scores(mutants, {}, verdicts).back().share()));
}

BOOST_AUTO_TEST_CASE(the_catalogue_is_of_this_code) {
  const testing::TemporaryFolder folder;
  const std::vector<Mutant> mutants =
      read_catalogue(fs::path(TREE) / "verification/mutants/catalogue");
  BOOST_TEST(mutants.size() >= 200);
  make_copy(TREE, folder.path(), mutants);
}

BOOST_AUTO_TEST_SUITE_END()
