#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"commands", "command lines, fair, odd and wrong", 50, 3000, try_command_line},
      {"cross", "runs whose answers theory relates", 6, 400, try_cross_check},
      {"kills", "signals at any moment, and what is left", 2, 100, try_kill},
      {"checkpoints", "damaged checkpoints", 6, 500, try_checkpoint},
      {"disk", "full disks, folders that cannot be written to", 6, 200, try_disk},
      {"neighbours", "two runs in one folder", 2, 60, try_neighbours},
      {"gnuplot", "gnuplot that fails, hangs or is missing", 2, 100, try_gnuplot}};
  return all;
}

}  // namespace talus::fuzz
