// The options of the program `heap`, for all its models, and its poorest one.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "common/io/options.hpp"
#include "common/program/flow_picture.hpp"
#include "common/program/method_options.hpp"
#include "common/program/penalty_options.hpp"
#include "common/scene/case.hpp"
#include "threed/heap_solve.hpp"
#include "twod/section_nested.hpp"

namespace talus::threed {

struct ProgramOptions {
  twod::Section section;
  HeapMesh mesh;
  program::MethodOptions method;
  program::PenaltyOptions penalty;
  program::PictureOptions picture;
  std::string model = "section", wall = "no-slip", elements = "70x100", output = "results/heap";
  std::string start = "rest", outflow = "fully-developed";
  double flow_rate = 0;        ///< 0: the angle is given instead
  double wall_friction = 0.5;  ///< μw, on a line
  int threads = 1;
  bool plot = false, check_jacobian = false;

  bool is_line() const { return model == "line"; }
  bool is_space() const { return model == "space"; }
};

void add_options(io::CommandLine& line, ProgramOptions& options);

/// What several options together mean: the mesh, the law, the wall, defaults of the model. Throws
/// io::UserError for an option that the model has no use for, or for elements out of range.
void interpret(const io::CommandLine& line, ProgramOptions& options);

/// Says what the solve will take if that is much. Throws io::UserError if it does not fit into
/// memory.
void admit(const ProgramOptions& options);

Heap heap_of(const ProgramOptions& options);
HeapOptions heap_options(const ProgramOptions& options);
shear::ShearOptions section_options(const ProgramOptions& options);
/// In three dimensions the section is only wanted quickly.
twod::Start section_start(const ProgramOptions& options);

/// As summary.json has them.
nlohmann::json parameters(const ProgramOptions& options);

/// The run on a line, as of chute and bagnold. `other_files` are what the other models leave.
/// Returns the exit code.
int run_on_line(const io::CommandLine& line, const ProgramOptions& options,
                const std::vector<std::string>& other_files, scene::Case& a_case);

}  // namespace talus::threed
