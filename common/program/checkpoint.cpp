#include "common/program/checkpoint.hpp"

#include <fstream>
#include <sstream>

namespace talus::program {

void write_checkpoint(const io::ResultFolder& folder, const std::string& name,
                      const Checkpoint& checkpoint) {
  const auto& start = checkpoint.start;
  const nlohmann::json header = {
      {"notes", checkpoint.notes},    {"size", start.state.size()},
      {"parameter", start.parameter}, {"direction", start.direction},
      {"step", start.step},           {"reference_sign", start.reference_sign}};
  std::string contents = header.dump() + "\n";
  for (const Eigen::VectorXd* part : {&start.state.value(), &start.state.correction()})
    contents.append(reinterpret_cast<const char*>(part->data()),
                    sizeof(double) * static_cast<std::size_t>(part->size()));
  folder.write(name, contents);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const auto broken = [&] {
    std::ostringstream message;
    message << file << " is not a checkpoint; remove it to start anew";
    return io::UserError(message.str());
  };
  std::string line;
  std::getline(in, line);
  Checkpoint checkpoint;
  auto& start = checkpoint.start;
  Eigen::Index size = 0;
  try {
    const auto header = nlohmann::json::parse(line);
    checkpoint.notes = header.at("notes");
    size = header.at("size");
    start.parameter = header.at("parameter");
    start.direction = header.at("direction");
    start.step = header.at("step");
    start.reference_sign = header.at("reference_sign");
  } catch (const nlohmann::json::exception&) {
    throw broken();
  }
  const auto rest = std::filesystem::file_size(file) - line.size() - 1;
  if (size < 0 || rest != 2 * sizeof(double) * static_cast<std::size_t>(size)) throw broken();
  Eigen::VectorXd value(size), correction(size);
  for (Eigen::VectorXd* part : {&value, &correction})
    in.read(reinterpret_cast<char*>(part->data()),
            static_cast<std::streamsize>(sizeof(double)) * size);
  if (!in) throw broken();
  start.state = {std::move(value), std::move(correction)};
  return checkpoint;
}

}  // namespace talus::program
