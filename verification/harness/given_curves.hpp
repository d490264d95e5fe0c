// Curves of others that are not ours to distribute: a user who owns them gives them in a file, and
// sees them drawn in the figures they belong to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/io/figure.hpp"

namespace talus::verification {

/// a, b, ... in the order in which panels are drawn.
std::string name_of_panel(std::size_t number);

struct GivenCurve {
  std::string figure;  ///< its number in the publication
  std::string panel;   ///< its name there
  io::Curve curve;
};

/// A figure that takes such curves: its number, and how many panels it has.
struct OpenFigure {
  std::string number;
  int panels = 1;
};

/// Reads a table `figure,panel,curve,x,y`, one line a point; empty lines and those that begin with
/// # are left out. Throws io::UserError, which names the option --data, the file and the line, for
/// what is no such table, a figure or panel that is not among `figures`, and no finite number.
std::vector<GivenCurve> read_given_curves(const std::filesystem::path& file,
                                          const std::vector<OpenFigure>& figures);

/// Where a publication has curves that may be given, such as experiments, and what to call them.
struct Awaited {
  std::string panel, label;
};

/// The figure of that number with what was given for it; its caption says how much that is. In the
/// panels in which nothing was, an entry of the key keeps the place of what is awaited.
io::Figure with_given_curves(io::Figure figure, const std::string& number,
                             const std::vector<GivenCurve>& given,
                             const std::vector<Awaited>& awaited = {});

}  // namespace talus::verification
