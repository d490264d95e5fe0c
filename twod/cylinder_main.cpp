// Granular flow down a channel past a cylinder, scaled by the confining pressure: one number, the
// loading F = φρgD/p_ext, decides between creep and flow.
//
// Sample runs (the test suite runs them):
//   cylinder --around 24 --loading 0.02
//   cylinder --around 24 --sweep 0.044:0.052:3 --regularisation barker-gray --plot
//   cylinder --around 16 --full --loading 0.03 --penalty plain --lambda-r 1e-4
//   cylinder --around 16 --lambda-r 1e-4 --check-jacobian
//   cylinder --around 16 --loading 0.02 --tangent full
//   cylinder --around 16 --loading 0.044 --outflow open-viscous --outlet 8 --route lambda-r
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>

#include "common/io/options.hpp"
#include "common/mixed/mixed_jacobian.hpp"
#include "common/program/method_options.hpp"
#include "common/program/penalty_options.hpp"
#include "common/program/summary.hpp"
#include "common/program/work.hpp"
#include "common/scene/case.hpp"
#include "common/solve/parallel.hpp"
#include "common/solve/stopwatch.hpp"
#include "twod/cylinder_sweep.hpp"

using namespace talus;

namespace {

struct Options {
  twod::SweepOptions run;
  program::PenaltyOptions penalty{.plain = 1e-8};
  program::PictureOptions picture;
  std::string sweep, regularisation = "chauchat-medale", friction;
  std::string outflow = "fully-developed", continuation, route, method = "newton",
              tangent = "primal-dual";
  std::string output = "results/cylinder";
  bool no_pressure_regularisation = false, no_inertia = false, plot = false;
  bool check_jacobian = false;
  double tolerance = 0;  // 0: the sweep's own defaults
  int threads = 1;
};

constexpr double smallest_loading = 1e-6, largest_loading = 0.07;

// "A:B:N": N loadings from A to B.
std::vector<double> read_sweep(const std::string& text) {
  const std::vector<std::string> parts = io::split(text, ':');
  if (parts.size() != 3)
    throw io::UserError("--sweep: '" + text + "' is not A:B:N, such as 0.044:0.054:6");
  const double a = io::real_in_range("--sweep", parts[0], smallest_loading, largest_loading);
  const double b = io::real_in_range("--sweep", parts[1], smallest_loading, largest_loading);
  const int n = io::whole_in_range("--sweep", parts[2], 2, 1000);
  std::vector<double> loadings;
  for (int i = 0; i < n; ++i)  // 0.05, not the 0.049999999999999996 of the formula
    loadings.push_back(io::number_in(io::rounded(a + (b - a) * i / (n - 1), 12)));
  return loadings;
}

void read(Options& o) {
  twod::Cylinder& scene = o.run.scene;
  if (scene.mesh.around % 8 != 0)
    throw io::UserError("--around: '" + std::to_string(scene.mesh.around) +
                        "' is not a multiple of 8 in 16 ... 640");
  scene.regularisation = *rheology::regularisation_named(o.regularisation);
  scene.penalty = program::penalty_of(o.penalty);
  scene.inertia = !o.no_inertia;
  scene.tangent = program::tangent_named(o.tangent);
  scene.regularises_pressure = !o.no_pressure_regularisation;
  for (const mixed::Open open : {mixed::Open::no, mixed::Open::viscous, mixed::Open::all})
    if (o.outflow == twod::name_of_outflow(open)) scene.open_outlet = open;
  if (o.tolerance > 0) o.run.tolerance = o.run.distance = o.tolerance;
  if (!o.sweep.empty()) o.run.loadings = read_sweep(o.sweep);
  if (!o.friction.empty()) scene.law = program::friction_law(o.friction, scene.law);
  using twod::Continuation, twod::Route;
  for (const auto each :
       {Continuation::arclength, Continuation::natural, Continuation::primal_dual})
    if (o.continuation == twod::name_of(each)) o.run.continuation = each;
  for (const auto each : {Route::cheapest, Route::loading, Route::lambda_r})
    if (o.route == twod::name_of(each)) o.run.route = each;
  if (o.route.empty() && !o.continuation.empty())
    o.run.route =
        o.run.continuation == Continuation::primal_dual ? Route::lambda_r : Route::loading;
}

// With so many elements around, at a share of what was asked for. From rest to a loading by the way
// that is the default takes some 50 factorisations, some 10 if it creeps (docs/cylinder.md).
program::Task task_at(const Options& options, double share) {
  twod::CylinderMeshOptions mesh = options.run.scene.mesh;
  mesh.around = std::max(16, static_cast<int>(share * mesh.around) / 8 * 8);
  mesh.first_layer *= static_cast<double>(options.run.scene.mesh.around) / mesh.around;
  const double elements = static_cast<double>(twod::element_count(mesh));
  const double width = (mesh.full ? 2 : 1) * mesh.half_width;
  const int across =
      static_cast<int>(std::ceil(std::sqrt(elements * width / (mesh.half_height + mesh.outlet))));
  int factorisations = 0;
  for (const double loading : options.run.loadings)
    factorisations +=
        options.run.route == twod::Route::cheapest && twod::may_creep(options.run.scene, loading)
            ? 10
            : 50;
  return {std::to_string(mesh.around),
          program::mixed_work({across, static_cast<int>(std::ceil(elements / across)), 0}, 2,
                              factorisations)};
}

// What to try when a path does not arrive.
std::string advice_for(const Options& options) {
  std::string advice = "a larger --lambda-r, or --max-points to follow the path further";
  if (options.outflow == "open") return "nothing fixes the pressure: try --outflow open-viscous";
  if (options.run.continuation != twod::Continuation::arclength)
    return "try --continuation arclength, or " + advice;
  if (rheology::has_yield_stress(options.run.scene.regularisation))
    advice += ", or the well-posed --regularisation barker-gray";
  return "try the other --route, " + advice + "; past some loading there is no steady flow at all";
}

nlohmann::json summary_of(const Options& options, const twod::CylinderSweep& sweep,
                          bool reached_all) {
  const auto& cylinder = sweep.cylinder();
  nlohmann::json summary = {
      {"scene", "cylinder"},
      {"model", "plane"},
      {"parameters", sweep.parameters()},
      {"status", sweep.status()},
      {"elements", cylinder.space().element_count()},
      {"element_size", std::numbers::pi / options.run.scene.mesh.around},  // on the cylinder
      {"unknowns", cylinder.space().size()},
      {"condensed_unknowns", cylinder.flow().system().unknowns()},
      {"iterations", sweep.iterations()},
      {"factorisations", sweep.factorisations()},
      {"folds", sweep.folds()},
      {"reached", nlohmann::json::array()},
      {"sweep", nlohmann::json::array()},
      {"results", nlohmann::json::object()}};
  for (const auto& arrival : sweep.arrivals()) summary["reached"].push_back(twod::as_json(arrival));
  for (const auto& measures : sweep.reached_loadings())
    summary["sweep"].push_back(twod::as_json(measures));
  if (reached_all) summary["results"] = summary["sweep"].back();
  return summary;
}

// The summary last: where it is, the others are. Those of a path that failed say how it went.
// Returns the names of the files.
std::string write_files(const io::ResultFolder& folder, const Options& options,
                        const twod::CylinderSweep& sweep, bool reached_all,
                        const nlohmann::json& summary) {
  std::vector<io::Figure> figures;
  std::string written = " summary.json sweep.pvd";
  folder.write("sweep.pvd", io::to_pvd(sweep.series()));
  if (!sweep.records().empty()) {  // none if no path set out
    folder.write("path.csv", io::to_csv(twod::path_table(sweep.records())));
    figures.push_back(twod::path_figure(sweep.records()));
    written += " path.csv";
  }
  if (!sweep.reached_loadings().empty()) {
    figures.push_back(twod::drag_figure(sweep.reached_loadings(), options.run.confining_pressures));
    written += " sweep.csv";
  }
  if (reached_all) {
    folder.write("perimeter.csv",
                 io::to_csv(twod::perimeter_table(sweep.cylinder(), sweep.state())));
    figures.push_back(twod::perimeter_figure(sweep.cylinder(), sweep.state()));
    written += " perimeter.csv";
    if (options.plot)
      for (const io::Figure& each :
           twod::pictures(sweep.cylinder(), sweep.state(), options.picture))
        figures.push_back(each);
  }
  if (options.plot) written += io::draw(folder, figures);
  folder.write("summary.json", summary.dump(2) + "\n");
  return written;
}

int run(Options& options, scene::Case& a_case) {
  // 1. The scene: mesh, boundary conditions, law.
  read(options);
  program::admit("cylinder", "--around", [&](double share) { return task_at(options, share); });
  solve::set_threads(options.threads);
  if (a_case.is_dry_run()) return 0;
  if (options.check_jacobian) {
    const twod::CylinderFlow cylinder(options.run.scene);
    return program::report("cylinder", mixed::check_jacobian(cylinder.flow(), 1));  // p_ext
  }
  const io::ResultFolder folder = a_case.folder(options.output);
  const solve::Stopwatch watch;

  // 2. From rest to every loading, each in the cheapest way unless told otherwise.
  bool reached_all = false;
  const auto solved = a_case.timed([&] {
    auto sweep = std::make_unique<twod::CylinderSweep>(options.run, folder);
    reached_all = sweep->run();
    return sweep;
  });
  const twod::CylinderSweep& sweep = *solved;

  // 3. What came out, and the files.
  nlohmann::json summary = summary_of(options, sweep, reached_all);
  summary["seconds"] = watch.seconds();
  a_case.complete(summary);
  const std::string written = write_files(folder, options, sweep, reached_all, summary);
  a_case.write(summary);
  std::cout << sweep.factorisations() << " factorisations, " << sweep.folds() << " folds, "
            << io::rounded(watch.seconds(), 3) << " s";
  if (!folder.is_nowhere())
    std::cout << "; results in " << folder.path().string() << ":" << written;
  std::cout << '\n';
  if (reached_all) return 0;
  std::cerr << "cylinder: " << sweep.status()
            << " at F = " << io::rounded(sweep.cylinder().flow().load_factor(), 8)
            << ", λr = " << io::rounded(sweep.cylinder().flow().rheology().lambda_r, 4) << " after "
            << sweep.folds() << (sweep.folds() == 1 ? " fold" : " folds")
            << (sweep.records().empty() ? ": " : ": see path.csv; ") << advice_for(options) << '\n';
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{"Granular flow around a cylinder, in velocity and pressure", "cylinder"};
  Options o;
  const io::Option loading =
      io::add_reals(line, "--loading", o.run.loadings, "Loadings F = φρgD/p_ext, one or several",
                    smallest_loading, largest_loading);
  io::add_text(line, "--sweep", o.sweep, "N loadings from A to B instead, as A:B:N")
      .excludes(loading);
  io::add_integer(line, "--around", o.run.scene.mesh.around,
                  "Elements around the whole cylinder, a multiple of 8", 16, 640);
  io::add_real(line, "--first-layer", o.run.scene.mesh.first_layer,
               "Thickness of the elements on the cylinder, in D; default 3.2/around", 1e-4, 0.5)
      .without_default();
  io::add_flag(line, "--full", o.run.scene.mesh.full,
               "Both halves of the channel, without symmetry");
  io::add_real(line, "--outlet", o.run.scene.mesh.outlet, "Distance of the outlet below, in D", 4,
               60);
  io::add_choice(line, "--outflow", o.outflow,
                 "At the outlet: developed, or open with or without its pressure",
                 {"fully-developed", "open-viscous", "open"});
  program::add_regularisation(line, o.regularisation);
  program::add_threads(line, o.threads);
  io::add_real(line, "--lambda-r", o.run.scene.lambda_r, "Regularisation parameter, scaled", 1e-12,
               1);
  io::add_real(line, "--pressure-floor", o.run.scene.pressure_floor,
               "Eq. (16) takes this for λr if it is larger, in p_ext; a grain layer weighs 0.005",
               0, 1);
  io::add_flag(line, "--no-pressure-regularisation", o.no_pressure_regularisation,
               "No eq. (16): where the pressure is negative there is no friction at all");
  io::add_text(line, "--friction", o.friction,
               "Friction law mu_s,delta_mu,I0 [each 0.001 ... 10; default 0.4,0.25,0.3]");
  program::add_penalty(line, o.penalty);
  io::add_flag(line, "--no-inertia", o.no_inertia, "Leave out the advective term");
  io::add_choice(line, "--continuation", o.continuation,
                 "How paths are followed; primal-dual if it is not given",
                 {"primal-dual", "arclength", "natural"})
      .without_default();
  io::add_choice(
      line, "--route", o.route,
      "To each loading: without a path where it creeps, else down in λr (default without "
      "--continuation); down in λr at the loading (default of primal-dual); or along the loading "
      "from creep (default otherwise)",
      {"cheapest", "loading", "lambda-r"})
      .without_default();
  program::add_newton(line, o.method);
  program::add_tangent(line, o.tangent);
  io::add_real(line, "--tolerance", o.tolerance,
               "Of the answer at each loading: relative residual and distance to the solution "
               "(default 1e-13 and 1e-10)",
               1e-16, 1e-3)
      .without_default();
  io::add_integer(line, "--max-points", o.run.max_points, "Points of one path at most", 2, 100000);
  io::add_reals(line, "--confining-pressure", o.run.confining_pressures,
                "p_ext in φρgD, for the Froude numbers", 0.01, 1000);
  io::add_text(line, "--output", o.output, "Folder for the results");
  io::add_flag(line, "--resume", o.run.resume,
               "Go on from the last accepted state in the folder, with another --continuation too");
  io::add_flag(line, "--plot", o.plot,
               "Draw figures and fields (data, gnuplot script, SVG and PNG)");
  program::add_pictures(line, o.picture);
  io::add_flag(line, "--check-jacobian", o.check_jacobian,
               "Only compare the tangent with differences of the residual (take few elements)");
  scene::Case a_case(line, twod::description());
  return a_case.run_program(argc, argv, [&] {
    io::refuse_unused(
        line,
        {{{"--pressure-floor"}, !o.no_pressure_regularisation, "--no-pressure-regularisation"},
         {{"--repeat"}, !o.run.resume, "--resume"},
         {{"--loading", "--sweep", "--continuation", "--route", "--tolerance", "--max-points",
           "--confining-pressure", "--output", "--resume", "--plot"},
          !o.check_jacobian,
          "--check-jacobian"}});
    program::check_pictures(line, o.picture, o.plot);
    auto& mesh = o.run.scene.mesh;
    if (!line.is_given("--first-layer"))
      mesh.first_layer = twod::refined_to(mesh.around).first_layer;
    return run(o, a_case);
  });
}
