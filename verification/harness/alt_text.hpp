// What is seen in a panel, in words, for those who do not see it.
#pragma once

#include <string>

#include "common/io/figure.hpp"

namespace talus::verification {

/// Title, axes, and of every curve where it starts and where it ends; of a map its range and the
/// number of each mark; of bars the lengths.
std::string alt_text(const io::Panel& panel);

}  // namespace talus::verification
