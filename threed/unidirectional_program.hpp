// The programs `chute` and `bagnold`: one main each for the scene's own options, and this for the
// rest, in all three models.
#pragma once

#include <functional>

#include "common/io/command_line.hpp"
#include "common/program/flow_picture.hpp"
#include "common/program/method_options.hpp"
#include "common/program/penalty_options.hpp"
#include "common/scene/case.hpp"
#include "oned/report.hpp"
#include "threed/unidirectional_solve.hpp"

namespace talus::threed {

/// The options both programs share.
struct UnidirectionalProgram {
  std::string model = "line";
  oned::MeshOptions mesh;
  program::MethodOptions method;
  program::PenaltyOptions penalty;
  program::PictureOptions picture;
  std::string output;
  int threads = 1;
  bool plot = false, check_jacobian = false;

  bool is_line() const { return model == "line"; }
};

/// Adds the shared options; set `options.method.lambda_r` to the scene's default first.
void add_options(io::CommandLine& line, UnidirectionalProgram& options, const std::string& scene);

/// What a line is measured by, errors included.
std::vector<scene::Quantity> quantities_of_line();

/// What `chute` and `bagnold` say of themselves; `problem_options` are those of the scene alone.
scene::Description description_of(const oned::ShearScene& scene,
                                  const std::vector<std::string>& problem_options);

/// The fields of a flow in the plane, or in the middle between the planes of symmetry of one in
/// space; a thin piece of the flow, stretched.
template <int Dim>
io::Figure picture(const oned::ShearScene& scene, const UnidirectionalSolution<Dim>& solution,
                   const UnidirectionalOptions& options, const program::PictureOptions& picture);

/// What only one scene has: parameters for summary.json, more results of a line, what to say of
/// them, and files that its other models leave.
struct OwnOfScene {
  nlohmann::json parameters;
  std::function<nlohmann::json(const oned::Solution&)> measures = {};
  std::function<std::string(const nlohmann::json& results)> remarks = {};
  std::vector<std::string> other_files = {};
};

/// Limits, mesh, solve, measure, write. Returns the exit code: 0, or 1 where the solve or the
/// Jacobian check does not succeed.
int run(const io::CommandLine& line, const oned::ShearScene& scene,
        const UnidirectionalProgram& options, const OwnOfScene& own, scene::Case& a_case);

/// Whatever a run can leave.
std::vector<std::string> files_of_line();

}  // namespace talus::threed
