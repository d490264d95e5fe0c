#include "verification/references/references.hpp"

#include <algorithm>
#include <stdexcept>

namespace talus::verification::references {
namespace {

constexpr const char* dolfinx = "FEniCSx/dolfinx 0.5.2 on the same elements";
constexpr const char* dolfinx_on_its_mesh = "FEniCSx/dolfinx 0.5.2 on a mesh of its own";
constexpr const char* line_analysis = "an analysis of P2 elements apart from this code";

// As many digits as are given.
constexpr Reference rounded(double value, double last_digit, const char* source) {
  return {value, 0.5 * last_digit * (1 + 1e-9), source};
}
// In full, to what the two solvers' tolerances leave.
constexpr Reference in_full(double value) {
  return Reference{value, 0, dolfinx}.within(1e-9);
}

// The heap on 18x25 elements: flow rate, surface velocity and depths in the middle.
KnownCase heap_at(const std::string& angle, double flow_rate, double velocity, double depth_1,
                  double depth_5) {
  return {"heap",
          "--elements 18x25 --method newton --lambda-r 1e-5 --angle " + angle,
          {{"flow_rate", in_full(flow_rate)},
           {"surface_velocity", in_full(velocity)},
           {"depth_1_percent", rounded(depth_1, 1e-4, dolfinx)},
           {"depth_5_percent", rounded(depth_5, 1e-4, dolfinx)}}};
}

// Creep on 40 elements around. The other mesh is built otherwise, and neither resolves more.
KnownCase creep_at(const std::string& loading, double drag, double mean, double largest,
                   double walls) {
  constexpr double meshes = 0.01;
  const auto near = [](double value) {
    return Reference{value, 0, dolfinx_on_its_mesh}.within(meshes);
  };
  return {"cylinder",
          "--around 40 --lambda-r 1e-6 --loading " + loading,
          {{"drag", near(drag)},
           {"mean_velocity", near(mean)},
           {"largest_velocity", near(largest)},
           {"wall_force", near(walls)}}};
}

// Above yield U is what a small difference of large forces leaves.
KnownCase flow_at(const std::string& words, double drag, double mean, bool full_only) {
  constexpr double of_drag = 0.005, of_velocity = 0.01;
  return {"cylinder",
          words + " --lambda-r 1e-6",
          {{"drag", Reference{drag, 0, dolfinx_on_its_mesh}.within(of_drag)},
           {"mean_velocity", Reference{mean, 0, dolfinx_on_its_mesh}.within(of_velocity)}},
          full_only};
}

KnownCase mean_velocity_at(const std::string& loading, double mean) {
  return {"cylinder",
          "--around 80 --regularisation barker-gray --lambda-r 1e-6 --loading " + loading,
          {{"mean_velocity", Reference{mean, 0, dolfinx_on_its_mesh}.within(0.02)}},
          true};
}

KnownCase bagnold_graded(const std::string& exponent, double error, double last_digit) {
  return {"bagnold",
          "--elements 160 --lambda-r 1e-8 --grading " + exponent,
          {{"error_l2", rounded(error, last_digit, line_analysis)}}};
}

std::vector<KnownCase> all_cases() {
  const std::string unregularised = "--method interior-point --angle 0.42 --elements ";
  const std::string barker_gray = " --regularisation barker-gray --loading ";
  return {
      bagnold_graded("2", 2.5e-8, 1e-9),
      bagnold_graded("3", 6.0e-8, 1e-9),
      bagnold_graded("4", 1.3e-7, 1e-8),
      {"chute",
       "--method interior-point --pressure 21.8 --elements 40",
       {{"max_velocity", rounded(23.49, 0.01, line_analysis)},
        {"exact_max_velocity", rounded(27.39, 0.01, line_analysis)}}},
      {"chute", "--elements 40", {{"exact_max_velocity", rounded(1.230760, 1e-6, line_analysis)}}},
      {"chute",
       "--pressure 40 --lambda-r 1e-5 --elements 40",
       {{"max_velocity", rounded(9.1e-5, 1e-6, line_analysis)}}},
      heap_at("0.38", 3.197164611636507, 0.44707680415954487, 21.2965, 19.1031),
      heap_at("0.41", 48.8170049828537, 3.7243220237316548, 38.9233, 34.8959),
      heap_at("0.45", 244.97601639461197, 13.69802199448382, 49.2871, 46.3262),
      heap_at("0.5", 764.3792312326035, 39.336467621928875, 49.498, 47.4353),
      {"heap",
       "--elements 70x100 --method newton --lambda-r 1e-5 --angle 0.41",
       {{"flow_rate", rounded(49.19365195, 1e-8, dolfinx)},
        {"surface_velocity", rounded(3.734911, 1e-6, dolfinx)}}},
      {"heap",
       "--elements 70x100 --method newton --lambda-r 1e-5 --flow-rate 39.71",
       {{"angle", rounded(0.406354315, 2e-9, dolfinx)}},  // to 1e-8 of Q*
       true},
      {"heap", unregularised + "18x25", {{"flow_rate", heap_flow_rate_on_18x25}}},
      {"heap", unregularised + "35x50", {{"flow_rate", heap_flow_rate_on_35x50}}},
      {"heap",
       unregularised + "35x50 --grading-to-wall 3 --grading-to-surface 3",
       {{"flow_rate", rounded(82.4839, 1e-4, "another interior point, a prototype of this one")}}},
      {"heap",
       unregularised + "140x200 --grading-to-wall 2 --grading-to-surface 2 --wall friction",
       {{"flow_rate", heap_flow_rate_limit}},
       true},
      creep_at("0.01", 1.6456246413666615, 4.96326084935233e-07, 7.397786473707355e-07,
               4.3465213869527455),
      creep_at("0.02", 2.966595352654943, 1.1042059306867494e-06, 1.6439353102857743e-06,
               9.017696703985512),
      creep_at("0.03", 3.9408376333874626, 1.919325825984976e-06, 2.8303545667872263e-06,
               14.035600451572883),
      creep_at("0.04", 4.683432278139259, 3.1911541362472596e-06, 4.583512896031616e-06,
               19.28515183514073),
      flow_at("--around 40 --loading 0.054", 6.239, 0.1129, false),
      flow_at("--around 40" + barker_gray + "0.044", 4.854234143539288, 0.0010763003440789733,
              false),
      flow_at("--around 40" + barker_gray + "0.046", 5.104974129541217, 0.0035193383399949193,
              false),
      flow_at("--around 40" + barker_gray + "0.05", 5.604445897142774, 0.02909510699275599, false),
      flow_at("--around 40" + barker_gray + "0.054", 6.077, 0.1618, false),
      flow_at("--around 80" + barker_gray + "0.054", 6.012, 0.1697, true),
      mean_velocity_at("0.046", 0.0037),
      mean_velocity_at("0.049", 0.0189),
      mean_velocity_at("0.05", 0.0307),
      mean_velocity_at("0.052", 0.0752),
      flow_at("--around 160" + barker_gray + "0.05", 5.532, 0.03142, true)};
}

}  // namespace

CylinderCreep cylinder_creep(double loading) {
  constexpr const char* source = "another code, Q2/P1, 160 elements around, of first order";
  constexpr double good_to = 0.005;
  const auto creep = [&](double drag, double velocity) {
    return CylinderCreep{Reference{drag, 0, source}.within(good_to),
                         Reference{velocity, 0, source}.within(good_to)};
  };
  if (loading == 0.01) return creep(1.64313, 4.97e-7);
  if (loading == 0.04) return creep(4.61716, 3.22e-6);
  throw std::out_of_range("no creep of the cylinder is known at F = " + std::to_string(loading));
}

std::vector<KnownCase> known_cases(const std::vector<std::string>& scenes) {
  std::vector<KnownCase> cases = all_cases();
  std::erase_if(cases, [&](const KnownCase& each) {
    return std::ranges::find(scenes, each.scene) == scenes.end();
  });
  return cases;
}

const std::vector<KnownSurface>& known_surfaces() {
  static const std::vector<KnownSurface> all = {{0.41,
                                                 {{0, 3.73133, 38.9615, 34.9436},
                                                  {10, 3.71414, 38.6287, 34.6282},
                                                  {20, 3.65871, 37.5969, 33.6623},
                                                  {30, 3.55602, 35.8156, 31.9871},
                                                  {40, 3.39124, 33.1466, 29.4885},
                                                  {50, 3.13623, 29.3278, 25.9117},
                                                  {60, 2.71999, 23.6845, 20.6024},
                                                  {65, 2.37849, 19.5045, 16.6243}}},
                                                {0.45,
                                                 {{0, 13.72257, 49.2947, 46.3457},
                                                  {10, 13.66647, 49.2288, 46.082},
                                                  {20, 13.48566, 48.9292, 45.2026},
                                                  {30, 13.15167, 47.9043, 43.5085},
                                                  {40, 12.61884, 45.5838, 40.7837},
                                                  {50, 11.80304, 41.6629, 36.6817},
                                                  {60, 10.50478, 35.3795, 30.3621},
                                                  {65, 9.49431, 30.5061, 25.4291}}}};
  return all;
}

Reference KnownSurface::velocity(const At& at) {
  return rounded(at.velocity, 1e-5, dolfinx);
}
Reference KnownSurface::depth_1(const At& at) {
  return rounded(at.depth_1, 1e-4, dolfinx);
}
Reference KnownSurface::depth_5(const At& at) {
  return rounded(at.depth_5, 1e-4, dolfinx);
}

}  // namespace talus::verification::references
