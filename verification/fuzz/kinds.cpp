#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"commands", "command lines, fair, odd and wrong", 150, 3000, try_command_line},
      {"cross", "runs whose answers theory relates", 20, 400, try_cross_check},
      {"kills", "signals at any moment, and what is left", 6, 100, try_kill},
      {"checkpoints", "damaged checkpoints", 25, 500, try_checkpoint},
      {"disk", "full disks, folders that cannot be written to", 12, 200, try_disk},
      {"neighbours", "two runs in one folder", 4, 60, try_neighbours},
      {"gnuplot", "gnuplot that fails, hangs or is missing", 6, 100, try_gnuplot}};
  return all;
}

}  // namespace talus::fuzz
