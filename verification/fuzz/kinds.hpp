// What the fuzz tries, kind by kind.
#pragma once

#include <string>
#include <vector>

#include "verification/fuzz/trial.hpp"

namespace talus::fuzz {

struct Kind {
  std::string name, question;
  int few, many;  ///< trials by default, and with --full
  void (*run)(Trial&);
};

const std::vector<Kind>& kinds();

void try_command_line(Trial& trial);
void try_cross_check(Trial& trial);
void try_kill(Trial& trial);
void try_checkpoint(Trial& trial);
void try_disk(Trial& trial);
void try_neighbours(Trial& trial);
void try_gnuplot(Trial& trial);

}  // namespace talus::fuzz
