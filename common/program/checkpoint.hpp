// The last accepted point of a path on disk, so that an interrupted run can go on: everything that
// decides what comes next, to the last bit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/result_folder.hpp"
#include "common/solve/compensated_vector.hpp"
#include "common/solve/path.hpp"

namespace talus::program {

struct Checkpoint {
  nlohmann::json notes;  ///< the program's own: its parameters, how far it is
  solve::PathStart<solve::CompensatedVector> start;
  std::vector<double> carried_stress = {};  ///< MixedFlow::carried_stress(), if it carries one
};

/// Written whole or not at all: a line with a checksum (FNV-1a, 64 bits) of all that follows, a
/// line of JSON, then the numbers as they are in memory.
void write_checkpoint(const io::ResultFolder& folder, const std::string& name,
                      const Checkpoint& checkpoint);

/// Nothing if there is no such file. Throws io::UserError, in one line, if a single bit of it is
/// not as it was written or a number not finite.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file);

}  // namespace talus::program
