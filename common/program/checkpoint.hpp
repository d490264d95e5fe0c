// The last accepted point of a path on disk, so that an interrupted run can go on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "common/io/result_folder.hpp"
#include "common/solve/compensated_vector.hpp"
#include "common/solve/path.hpp"

namespace talus::program {

struct Checkpoint {
  nlohmann::json notes;  ///< the program's own: its parameters, how far it is
  solve::PathStart<solve::CompensatedVector> start;
};

/// From an accepted point: the path goes on in the direction it had there.
inline solve::PathStart<solve::CompensatedVector> start_from(const solve::CompensatedVector& state,
                                                             const solve::PathPoint& point) {
  return {.state = state,
          .parameter = point.parameter,
          .direction = point.parameter_slope < 0 ? -1 : 1,
          .step = point.step > 0 ? point.step : 0.1,
          .reference_sign = point.determinant_sign};
}

/// Written whole or not at all: a line of JSON, then the numbers as they are in memory.
void write_checkpoint(const io::ResultFolder& folder, const std::string& name,
                      const Checkpoint& checkpoint);

/// Nothing if there is no such file. Throws io::UserError if it cannot be understood.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file);

}  // namespace talus::program
