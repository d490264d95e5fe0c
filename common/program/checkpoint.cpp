#include "common/program/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/io/checksum.hpp"

namespace talus::program {
namespace {

using State = solve::CompensatedVector;

constexpr const char* first_words = "talus checkpoint ";

void append(std::string& contents, const double* numbers, std::size_t count) {
  contents.append(reinterpret_cast<const char*>(numbers), sizeof(double) * count);
}

void append(std::string& contents, const State& state) {
  for (const Eigen::VectorXd* part : {&state.value(), &state.correction()})
    append(contents, part->data(), static_cast<std::size_t>(part->size()));
}

// Takes numbers off the front of the contents; false if there are too few, or one is not finite.
bool take(std::string_view& contents, double* numbers, std::size_t count) {
  const std::size_t bytes = sizeof(double) * count;
  if (contents.size() < bytes) return false;
  if (bytes > 0) std::memcpy(numbers, contents.data(), bytes);
  contents.remove_prefix(bytes);
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

bool take(std::string_view& contents, Eigen::Index size, State& state) {
  Eigen::VectorXd value(size), correction(size);
  for (Eigen::VectorXd* part : {&value, &correction})
    if (!take(contents, part->data(), static_cast<std::size_t>(size))) return false;
  state = {std::move(value), std::move(correction)};
  return true;
}

// False if the header and the numbers do not make a checkpoint.
bool read(const nlohmann::json& header, std::string_view numbers, Checkpoint& checkpoint) {
  auto& start = checkpoint.start;
  checkpoint.notes = header.at("notes");
  start.parameter = header.at("parameter");
  start.direction = header.at("direction");
  start.step = header.at("step");
  start.reference_sign = header.at("reference_sign");
  const Eigen::Index size = header.at("size");
  const auto carried = header.at("carried_stress").get<Eigen::Index>();
  const auto numbers_left = static_cast<Eigen::Index>(numbers.size() / sizeof(double));
  if (size < 0 || size > numbers_left || carried < 0 || carried > numbers_left) return false;
  if (!take(numbers, size, start.state)) return false;
  if (header.at("has_secant") && !take(numbers, size, start.secant.emplace())) return false;
  checkpoint.carried_stress.resize(static_cast<std::size_t>(carried));
  return take(numbers, checkpoint.carried_stress.data(), checkpoint.carried_stress.size()) &&
         numbers.empty();
}

}  // namespace

void write_checkpoint(const io::ResultFolder& folder, const std::string& name,
                      const Checkpoint& checkpoint) {
  const auto& start = checkpoint.start;
  const nlohmann::json header = {{"notes", checkpoint.notes},
                                 {"size", start.state.size()},
                                 {"parameter", start.parameter},
                                 {"direction", start.direction},
                                 {"step", start.step},
                                 {"reference_sign", start.reference_sign},
                                 {"has_secant", start.secant.has_value()},
                                 {"carried_stress", checkpoint.carried_stress.size()}};
  std::string contents = header.dump() + "\n";
  append(contents, start.state);
  if (start.secant) append(contents, *start.secant);
  append(contents, checkpoint.carried_stress.data(), checkpoint.carried_stress.size());
  folder.write(name, first_words + io::checksum(contents) + "\n" + contents);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const auto refused = [&](const std::string& what) {
    return io::UserError("--resume: '" + file.string() + "' " + what + "; remove it to start anew");
  };
  std::ostringstream whole;
  whole << in.rdbuf();
  const std::string text = whole.str(), words = first_words;
  const std::size_t line_end = text.find('\n');
  if (!text.starts_with(words) || line_end == std::string::npos)
    throw refused("is not a checkpoint of this program");
  const std::string contents = text.substr(line_end + 1);
  if (text.substr(words.size(), line_end - words.size()) != io::checksum(contents))
    throw refused("is damaged: its checksum is that of other contents");
  Checkpoint checkpoint;
  try {
    const std::size_t header_end = contents.find('\n');
    if (header_end != std::string::npos &&
        read(nlohmann::json::parse(contents.substr(0, header_end)),
             std::string_view(contents).substr(header_end + 1), checkpoint))
      return checkpoint;
  } catch (const nlohmann::json::exception&) {
  }
  throw refused("does not hold a state, or one with numbers that are not finite");
}

}  // namespace talus::program
