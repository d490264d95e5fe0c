#include <cmath>
#include <functional>

#include "common/io/table.hpp"
#include "verification/fuzz/relations.hpp"

namespace talus::fuzz {
namespace {

using nlohmann::json;

double result(const json& summary, const char* name) {
  const auto& results = summary.at("results");
  return results.contains(name) && results[name].is_number() ? results[name].get<double>() : NAN;
}

// NaN fails.
void expect_close(Trial& trial, double a, double b, double relative, const std::string& what) {
  trial.expect(std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b)),
               what + ": " + io::exact(a) + " and " + io::exact(b) + ", further apart than " +
                   io::rounded(relative, 2) + " of it");
}

void expect_less(Trial& trial, double a, double b, const std::string& what) {
  trial.expect(a < b, what + ": " + io::exact(a) + " is not less than " + io::exact(b));
}

// A scene on a line that flows, far from its limits.
struct LineScene {
  std::string program;
  Arguments arguments;
};

LineScene draw_line_scene(Random& random, bool with_elements = true) {
  LineScene scene;
  const double size = random.magnitude(1, 100);
  if (random.chance(0.5))  // the plug's edge at p = 0.383 to 0.643 of the load
    scene = {"chute",
             {"--width", io::exact(size), "--pressure", io::exact(size * random.real(0.85, 1.2))}};
  else
    scene = {"bagnold",
             {"--height", io::exact(size), "--angle", io::exact(random.real(0.4, 0.55))}};
  if (with_elements)
    scene.arguments =
        scene.arguments + Arguments{"--elements", std::to_string(random.whole(5, 100))};
  return scene;
}

const char* const limiting[] = {"simple", "bercovier-engelman", "papanastasiou", "chauchat-medale"};

// Distance of a regularised flow from the limiting one: some thousand λr at most in these scenes.
void newton_and_interior_point(Trial& trial) {
  const LineScene scene = draw_line_scene(trial.random);
  const auto a =
      solved(trial, scene.program, scene.arguments + Arguments{"--method", "interior-point"}, "a");
  const auto b = solved(trial, scene.program,
                        scene.arguments + Arguments{"--lambda-r", "1e-10", "--regularisation",
                                                    trial.random.one_of(limiting)},
                        "b");
  if (a && b)
    expect_close(trial, result(*a, "max_velocity"), result(*b, "max_velocity"), 1e-6, "velocity");
}

void regularisations_agree(Trial& trial) {
  const LineScene scene = draw_line_scene(trial.random);
  const auto run = [&](const char* subfolder) {
    return solved(trial, scene.program,
                  scene.arguments + Arguments{"--lambda-r", "1e-10", "--regularisation",
                                              trial.random.one_of(limiting)},
                  subfolder);
  };
  const auto a = run("a"), b = run("b");
  if (a && b)
    expect_close(trial, result(*a, "max_velocity"), result(*b, "max_velocity"), 1e-6, "velocity");
}

void tangents_agree(Trial& trial) {
  const LineScene scene = draw_line_scene(trial.random);
  const Arguments line =
      scene.arguments + Arguments{"--lambda-r", trial.random.chance(0.5) ? "1e-4" : "1e-6"};
  const auto a = solved(trial, scene.program, line + Arguments{"--tangent", "full"}, "a");
  const auto b = solved(trial, scene.program, line + Arguments{"--tangent", "primal-dual"}, "b");
  if (a && b)
    expect_close(trial, result(*a, "max_velocity"), result(*b, "max_velocity"), 1e-9, "velocity");
}

void precisions_agree(Trial& trial) {
  const LineScene scene = draw_line_scene(trial.random);
  const auto a =
      solved(trial, scene.program, scene.arguments + Arguments{"--precision", "plain"}, "a");
  const auto b = solved(trial, scene.program, scene.arguments, "b");
  if (a && b)
    expect_close(trial, result(*a, "max_velocity"), result(*b, "max_velocity"), 1e-7, "velocity");
}

// All lengths and the pressure times s: shear rates times sqrt(s), velocities times s sqrt(s).
void scales(Trial& trial) {
  Random& random = trial.random;
  const double size = random.magnitude(1, 50), s = random.magnitude(1.5, 30);
  const double load = random.real(0.85, 1.2), angle = random.real(0.4, 0.5);
  const int scene = random.whole(0, 2);
  const auto run = [&](double length, const char* subfolder) {
    const Arguments method = {"--method", "interior-point", "--tolerance", "1e-10"};
    if (scene == 0)
      return solved(
          trial, "chute",
          method + Arguments{"--width", io::exact(length), "--pressure", io::exact(length * load)},
          subfolder);
    if (scene == 1)
      return solved(trial, "bagnold",
                    method + Arguments{"--height", io::exact(length), "--angle", io::exact(angle)},
                    subfolder);
    return solved(trial, "heap",
                  method + Arguments{"--elements", "5x6", "--angle", io::exact(angle), "--width",
                                     io::exact(3 * length), "--height", io::exact(length)},
                  subfolder);
  };
  const auto a = run(size, "a"), b = run(s * size, "b");
  const char* const name = scene == 2 ? "surface_velocity" : "max_velocity";
  if (a && b)
    expect_close(trial, std::pow(s, 1.5) * result(*a, name), result(*b, name), 1e-5,
                 "scaled velocity");
}

void finer_is_closer(Trial& trial) {
  const LineScene scene = draw_line_scene(trial.random, false);
  const int n = trial.random.whole(3, 12);
  const auto run = [&](int elements, const char* subfolder) {
    return solved(trial, scene.program,
                  scene.arguments + Arguments{"--method", "interior-point", "--elements",
                                              std::to_string(elements)},
                  subfolder);
  };
  const auto a = run(n, "a"), b = run(16 * n, "b");
  if (a && b)
    expect_less(trial, result(*b, "error_l2"), result(*a, "error_l2"), "error of the finer mesh");
}

void more_load_flows_faster(Trial& trial) {
  Random& random = trial.random;
  const int scene = random.whole(0, 2);
  const double load = scene == 0 ? random.real(23, 33) : random.real(0.4, 0.5),
               more = random.real(1.02, 1.1);
  const auto run = [&](double value, const char* subfolder) {
    if (scene == 0) return solved(trial, "chute", {"--pressure", io::exact(value)}, subfolder);
    const Arguments angle = {"--angle", io::exact(value)};
    return scene == 1 ? solved(trial, "bagnold", angle, subfolder)
                      : solved(trial, "heap", angle + Arguments{"--elements", "5x6"}, subfolder);
  };
  const auto slow = run(scene == 0 ? load * more : load, "a"),
             fast = run(scene == 0 ? load : load * more, "b");
  const char* const name = scene == 2 ? "flow_rate" : "max_velocity";
  if (slow && fast)
    expect_less(trial, result(*slow, name), result(*fast, name), "flow under less load");
}

void section_by_both_methods(Trial& trial) {
  const Arguments line = {
      "--elements",
      std::to_string(trial.random.whole(3, 9)) + "x" + std::to_string(trial.random.whole(4, 13)),
      "--angle", io::exact(trial.random.real(0.4, 0.5))};
  const auto a = solved(trial, "heap", line, "a");
  const auto b =
      solved(trial, "heap", line + Arguments{"--method", "newton", "--lambda-r", "1e-9"}, "b");
  if (a && b)
    expect_close(trial, result(*a, "flow_rate"), result(*b, "flow_rate"), 1e-5, "flow rate");
}

void section_and_space(Trial& trial) {
  const std::string mesh =
      std::to_string(trial.random.whole(2, 5)) + "x" + std::to_string(trial.random.whole(3, 7));
  const Arguments line = {"--angle",          io::exact(trial.random.real(0.4, 0.5)),
                          "--lambda-r",       "1e-4",
                          "--regularisation", trial.random.one_of(limiting)};
  const auto a =
      solved(trial, "heap", line + Arguments{"--method", "newton", "--elements", mesh}, "a");
  const auto b =
      solved(trial, "heap", line + Arguments{"--model", "space", "--elements", "1x" + mesh}, "b");
  if (a && b)
    expect_close(trial, result(*a, "flow_rate"), result(*b, "flow_rate"), 1e-7, "flow rate");
}

// Velocity and pressure have no other solution than the line's, on the same elements across. Near
// the fast limit rounding is seen in the eighth digit of velocities, and in the sixth of errors.
void line_and_richer_models(Trial& trial) {
  const char* const richer[] = {"plane", "space"};
  const LineScene scene = draw_line_scene(trial.random, false);
  const Arguments line =
      scene.arguments + Arguments{"--elements",       std::to_string(trial.random.whole(3, 16)),
                                  "--lambda-r",       "1e-4",
                                  "--regularisation", trial.random.one_of(limiting)};
  const auto a = solved(trial, scene.program, line, "a");
  const auto b =
      solved(trial, scene.program, line + Arguments{"--model", trial.random.one_of(richer)}, "b");
  if (a && b)
    for (const auto& [name, apart] : {std::pair{"max_velocity", 1e-6},
                                      {"error_shear_rate_l2", 1e-4},
                                      {"error_stress_max", 1e-4}})
      expect_close(trial, result(*a, name), result(*b, name), apart, name);
}

void finer_is_closer_to_a_manufactured_flow(Trial& trial) {
  Random& random = trial.random;
  const char* const flows[] = {"sheared", "turning"};
  const char* const meshes[] = {"uniform", "stretched", "distorted", "sector"};
  const bool space = random.chance(0.2);
  const int n = space ? 1 : random.whole(2, 5);
  Arguments line = {"--flow",           random.one_of(flows),
                    "--mesh",           meshes[random.below(space ? 3 : 4)],
                    "--regularisation", random.one_of(limiting)};
  if (space) line = line + Arguments{"--model", "space"};
  const auto run = [&](int elements, const char* subfolder) {
    return solved(trial, "manufactured", line + Arguments{"--elements", std::to_string(elements)},
                  subfolder);
  };
  const auto a = run(n, "a"), b = run(4 * n, "b");
  if (a && b)
    for (const char* name : {"error_velocity_l2", "error_velocity_h1", "error_pressure_l2"})
      expect_less(trial, result(*b, name), result(*a, name), name);
}

void flow_rate_finds_the_angle(Trial& trial) {
  const std::string angle = io::exact(trial.random.real(0.39, 0.56));
  const bool space = trial.random.chance(0.3);
  const Arguments line =
      space ? Arguments{"--model", "space", "--elements", "1x3x4", "--lambda-r", "1e-4"}
            : Arguments{"--elements", "5x7"};
  const auto a = solved(trial, "heap", line + Arguments{"--angle", angle}, "a");
  if (!a) return;
  const std::string flow_rate = io::exact(result(*a, "flow_rate"));
  const auto b = solved(trial, "heap", line + Arguments{"--flow-rate", flow_rate}, "b");
  if (b) expect_close(trial, std::stod(angle), result(*b, "angle"), 1e-5, "angle");
}

void both_halves_of_the_channel(Trial& trial) {
  const Arguments line = {"--around",   "16",
                          "--lambda-r", trial.random.chance(0.5) ? "1e-2" : "1e-3",
                          "--loading",  io::exact(trial.random.real(0.005, 0.035))};
  const auto a = solved(trial, "cylinder", line, "a");
  const auto b = solved(trial, "cylinder", line + Arguments{"--full"}, "b");
  if (a && b)
    expect_close(trial, result(*a, "drag_coefficient"), result(*b, "drag_coefficient"), 1e-6,
                 "drag coefficient");
}

void ways_of_continuation_agree(Trial& trial) {
  const Arguments line = {"--around", "16",        "--lambda-r",
                          "1e-3",     "--loading", io::exact(trial.random.real(0.005, 0.04))};
  const char* const ways[] = {"arclength", "natural"};
  const auto a = solved(trial, "cylinder", line, "a");
  const auto b =
      solved(trial, "cylinder", line + Arguments{"--continuation", trial.random.one_of(ways)}, "b");
  if (a && b)
    expect_close(trial, result(*a, "mean_velocity"), result(*b, "mean_velocity"), 1e-7,
                 "mean velocity");
}

// A looser tolerance may cost digits, but not the answer.
void tolerance_stands_for_the_answer(Trial& trial) {
  const LineScene scene = draw_line_scene(trial.random);
  const bool interior = trial.random.chance(0.4);
  const double tolerance = trial.random.magnitude(1e-10, 1e-3);
  const Arguments line =
      scene.arguments + (interior
                             ? Arguments{"--method", "interior-point"}
                             : Arguments{"--lambda-r", trial.random.chance(0.5) ? "1e-4" : "1e-7"});
  const auto a = solved(trial, scene.program, line, "a");
  const auto b =
      solved(trial, scene.program, line + Arguments{"--tolerance", io::exact(tolerance)}, "b");
  if (a && b)
    expect_close(trial, result(*a, "max_velocity"), result(*b, "max_velocity"),
                 std::max(100 * tolerance, 1e-7),
                 "velocity with --tolerance " + io::rounded(tolerance, 2));
}

}  // namespace

const std::vector<Relation>& relations_of_flows() {
  static const std::vector<Relation> all = {
      {"newton and interior point", newton_and_interior_point},
      {"regularisations", regularisations_agree},
      {"tangents", tangents_agree},
      {"precisions", precisions_agree},
      {"scales", scales},
      {"finer is closer", finer_is_closer},
      {"more load", more_load_flows_faster},
      {"section by both methods", section_by_both_methods},
      {"section and space", section_and_space},
      {"line and richer models", line_and_richer_models},
      {"manufactured", finer_is_closer_to_a_manufactured_flow},
      {"flow rate and angle", flow_rate_finds_the_angle},
      {"both halves", both_halves_of_the_channel},
      {"continuations", ways_of_continuation_agree},
      {"tolerance", tolerance_stands_for_the_answer}};
  return all;
}

}  // namespace talus::fuzz
