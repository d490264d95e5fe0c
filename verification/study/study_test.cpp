// Do studies ask for the cases they say, and find in their records what is there?
#include <cmath>
#include <limits>

#include <boost/test/unit_test.hpp>

#include "common/io/result_folder.hpp"
#include "verification/study/kinds.hpp"
#include "verification/study/option_values.hpp"

BOOST_AUTO_TEST_SUITE(study_test)

using namespace talus::study;
using talus::io::UserError;
using Texts = std::vector<std::string>;
using nlohmann::json;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

bool refuses(const std::string& type, const std::string& text, const std::string& why) {
  try {
    values_of("--option", type, text);
  } catch (const UserError& error) {
    const std::string message = error.what();
    return message.find("--option") != std::string::npos &&
           message.find(text) != std::string::npos && message.find(why) != std::string::npos;
  }
  return false;
}

// A scene of made-up cases: error = constant * h^order, time = 1/h².
Program made_up() {
  return {"/nowhere/made-up",
          {{"scene", "made-up"},
           {"mesh_option", "--elements"},
           {"main_quantity", "flow"},
           {"main_error", "error_flow"},
           {"problem_options", {"--load"}},
           {"quantities", {{{"name", "flow"}, {"unit", "m"}, {"meaning", ""}}}},
           {"options", json::array()}}};
}

Row row(const Options& options, const json& results, const json& beside = json::object()) {
  json record = {{"status", results.empty() ? "stagnated" : "converged"},
                 {"command", "./run made-up"},
                 {"results", results}};
  record.update(beside);
  return {options, record};
}

Table falling(double order, double floor = 0) {
  Table table{made_up(), {{"--elements", {"4", "8", "16", "32", "64", "128"}}}, {}};
  for (const std::string& n : table.varied[0].values) {
    const double h = 1 / std::stod(n);
    table.rows.push_back(row({{"--elements", n}}, {{"error_flow", std::pow(h, order) + floor}},
                             {{"element_size", h}, {"cpu_seconds", 1 / h / h}}));
  }
  return table;
}

}  // namespace

BOOST_AUTO_TEST_CASE(lists_and_ranges_give_the_values_they_say) {
  const auto is = [](const std::string& type, const std::string& text, const Texts& expected) {
    const Texts values = values_of("--option", type, text);
    BOOST_TEST(values == expected, boost::test_tools::per_element());
  };
  is("INT", "5,10,20", {"5", "10", "20"});
  is("INT", "5:320:x2", {"5", "10", "20", "40", "80", "160", "320"});
  is("INT", "16:48:+8", {"16", "24", "32", "40", "48"});
  is("INT", "48:16:-16", {"48", "32", "16"});
  is("INT", "1,10:30:3", {"1", "10", "20", "30"});
  is("FLOAT", "1e-2:1e-6:/10", {"0.01", "0.001", "1e-04", "1e-05", "1e-06"});
  is("FLOAT", "0:1:3", {"0", "0.5", "1"});
  is("FLOAT", "0.1:0.35:+0.1", {"0.1", "0.2", "0.3"});
  is("ANGLE", "20deg:30deg:3", {"20deg", "25deg", "30deg"});
  is("MESH", "9x13,18x25", {"9x13", "18x25"});
  is("MESH", "9x13:36x52:x2", {"9x13", "18x26", "36x52"});
  is("NAME", "newton,interior-point", {"newton", "interior-point"});
  is("TEXT", "0.383,0.26,0.279", {"0.383,0.26,0.279"});
  BOOST_TEST(values_of("--angle", "ANGLE", "0.37:0.5:27").size() == 27U);
  BOOST_TEST(values_of("--angle", "ANGLE", "0.37:0.5:27")[1] == "0.375");
}

BOOST_AUTO_TEST_CASE(ranges_that_lead_nowhere_are_refused_by_name) {
  BOOST_TEST(refuses("INT", "5:10", "no range"));
  BOOST_TEST(refuses("INT", "5:10:", "no range"));
  BOOST_TEST(refuses("INT", "5:10:x", "no number"));
  BOOST_TEST(refuses("INT", "1:2:3", "no whole number"));
  BOOST_TEST(refuses("FLOAT", "1:10:x0.5", "does not come from A to B"));
  BOOST_TEST(refuses("FLOAT", "1:10:/2", "does not come from A to B"));
  BOOST_TEST(refuses("FLOAT", "1:10:x1", "does not come from A to B"));
  BOOST_TEST(refuses("FLOAT", "-1:10:x2", "does not come from A to B"));
  BOOST_TEST(refuses("FLOAT", "1:10:+-1", "does not come from A to B"));
  BOOST_TEST(refuses("FLOAT", "1:10:+0", "does not come from A to B"));
  BOOST_TEST(refuses("FLOAT", "1:10:1", "2 ..."));
  BOOST_TEST(refuses("FLOAT", "1:10:1e9", "2 ..."));
  BOOST_TEST(refuses("FLOAT", "1:nan:3", "no number"));
  BOOST_TEST(refuses("FLOAT", "1,,2", "empty"));
  BOOST_TEST(refuses("FLOAT", "1,1", "twice"));
  BOOST_TEST(refuses("ANGLE", "20deg:1:3", "different kinds"));
  BOOST_TEST(refuses("MESH", "9x13:36:x2", "different kinds"));
  BOOST_TEST(refuses("MESH", "9x13:36x52:3", "no range of meshes"));
}

BOOST_AUTO_TEST_CASE(cases_are_all_combinations_the_first_option_slowest) {
  const auto all = combinations({{"--a", {"1", "2"}}, {"--flag", {""}}, {"--b", {"x", "y"}}});
  BOOST_TEST(all.size() == 4U);
  BOOST_TEST(words_of(all[1]) == (Texts{"--a", "1", "--flag", "--b", "y"}),
             boost::test_tools::per_element());
  BOOST_CHECK_THROW(combinations({{"--a", Texts(101, "")}, {"--b", Texts(100, "")}}), UserError);
}

BOOST_AUTO_TEST_CASE(orders_are_fitted_where_errors_fall) {
  for (const double order : {1.0, 2.5, 4.0}) {
    Table table = falling(order);
    const Findings found = converge(table);
    BOOST_TEST(found.fits.size() == 1U);
    BOOST_TEST(std::abs(found.fits[0].order - order) < 1e-10);
    BOOST_TEST(found.fits[0].points == 4);
  }
  // Round-off at the fine end, and a coarse end not yet on its way, do not count.
  Table floored = falling(4, 1e-7);
  floored.rows[0].record["results"]["error_flow"] = 1e-3;
  const Fit fit = converge(floored).fits[0];
  BOOST_TEST(fit.points == 3);
  BOOST_TEST(std::abs(fit.order - 4) < 0.1);
  // Errors that do not fall, one that is no number, and too few: no order.
  BOOST_TEST(fitted({1, 0.5, 0.25, 0.125}, {1, 1, 1, 1}).order == 0);
  BOOST_TEST(fitted({1, 0.5, 0.25}, {1, not_a_number, 0.1}).points == 2);
  BOOST_TEST(std::isnan(fitted({1}, {1}).order));
}

BOOST_AUTO_TEST_CASE(the_front_is_what_no_other_case_beats) {
  Table table{made_up(), {{"--method", {"a", "b", "c", "d"}}}, {}};
  const std::vector<std::pair<double, double>> points = {{1, 1}, {2, 0.1}, {3, 0.5}, {0.5, 2}};
  for (std::size_t i = 0; i < points.size(); ++i)
    table.rows.push_back(row({{"--method", table.varied[0].values[i]}},
                             {{"error_flow", points[i].second}},
                             {{"cpu_seconds", points[i].first}}));
  table.rows.push_back(row({{"--method", "failed"}}, json::object(), {{"cpu_seconds", 1e-9}}));
  const Findings found = cost(table);
  Texts front;
  for (const auto& [_, each] : found.front) front.push_back(each->option("--method"));
  BOOST_TEST(front == (Texts{"d", "a", "b"}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(where_nothing_is_exact_the_finest_mesh_of_the_same_problem_is_the_measure) {
  Table table{made_up(), {{"--elements", {"1", "2"}}, {"--load", {"1", "2"}}}, {"flow"}};
  const auto add = [&](const std::string& n, const std::string& load, double flow) {
    table.rows.push_back(row({{"--elements", n}, {"--load", load}}, {{"flow", flow}},
                             {{"elements", std::stod(n)}, {"cpu_seconds", 1}}));
  };
  add("1", "1", 9), add("1", "2", 30), add("2", "1", 10), add("2", "2", 20);
  const auto names = errors_to_show(table, {"--load"});
  BOOST_TEST(names == Texts{"error_flow"}, boost::test_tools::per_element());
  BOOST_TEST(std::abs(table.rows[0].number("error_flow") - 0.1) < 1e-12);
  BOOST_TEST(std::abs(table.rows[1].number("error_flow") - 0.5) < 1e-12);
  // Nor the measure itself nor another case on its mesh has one.
  BOOST_TEST(std::isnan(table.rows[2].number("error_flow")));
  table.rows.push_back(table.rows[2]);
  table.rows.back().record["results"]["flow"] = 10.001;
  for (Row& each : table.rows) each.record["results"].erase("error_flow");
  errors_to_show(table, {"--load"});
  BOOST_TEST(std::isnan(table.rows.back().number("error_flow")));
}

BOOST_AUTO_TEST_CASE(a_law_without_yield_stress_is_measured_against_itself) {
  Table table{made_up(),
              {{"--elements", {"1", "2"}}, {"--regularisation", {"simple", "barker-gray"}}},
              {"flow"}};
  const auto add = [&](const std::string& n, const std::string& law, double flow) {
    table.rows.push_back(row({{"--elements", n}, {"--regularisation", law}}, {{"flow", flow}},
                             {{"elements", std::stod(n)}, {"cpu_seconds", 1}}));
  };
  add("1", "simple", 9), add("2", "simple", 10), add("1", "barker-gray", 30);
  add("2", "barker-gray", 20);
  errors_to_show(table, {});
  BOOST_TEST(std::abs(table.rows[0].number("error_flow") - 0.1) < 1e-12);
  BOOST_TEST(std::abs(table.rows[2].number("error_flow") - 0.5) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_case_that_failed_is_a_mark_with_the_name_of_its_end) {
  Table table{made_up(), {{"--lambda-r", {"1", "0.1"}}, {"--elements", {"4", "8"}}}, {}};
  for (const char* lambda : {"1", "0.1"})
    for (const char* n : {"4", "8"})
      table.rows.push_back(row({{"--lambda-r", lambda}, {"--elements", n}},
                               std::string(n) == "8" ? json::object() : json{{"flow", 1}},
                               {{"factorisations", 7}}));
  const Findings found = stability(table);
  const auto& figure = std::get<talus::io::Figure>(found.chapter.blocks[0]);
  BOOST_TEST(figure.caption.find("A: stagnated") != std::string::npos);
  BOOST_TEST(figure.panels[0].map->marks[0] == (Texts{"7", "A"}), boost::test_tools::per_element());
  BOOST_TEST(std::isnan(figure.panels[0].map->values[0][1]));
  BOOST_TEST(count_of_ends(all_rows(table)) == "2 of 4 arrive; 2 stagnated");
}

BOOST_AUTO_TEST_CASE(a_ladder_says_which_model_will_do_and_nothing_of_one_that_failed) {
  const auto sentence = [](double richer) {
    Table table{made_up(), {{"--model", {"line", "space"}}}, {}};
    const json beside = {{"cpu_seconds", 1}, {"peak_memory", 1}, {"unknowns", 9}};
    table.rows.push_back(row({{"--model", "line"}}, {{"flow", 1}}, beside));
    table.rows.push_back(row({{"--model", "space"}},
                             std::isnan(richer) ? json::object() : json{{"flow", richer}}, beside));
    return std::get<std::string>(ladder(table).chapter.blocks[0]);
  };
  BOOST_TEST(sentence(1).find("use line") != std::string::npos);
  BOOST_TEST(sentence(1.1).find("use space") != std::string::npos);
  BOOST_TEST(sentence(not_a_number).find("no verdict") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
