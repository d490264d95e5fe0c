// A field as a picture: bands of colour with isolines between them, mesh, streamlines and regions,
// drawn by gnuplot from polygons and lines, as small in SVG as in PNG.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/contours.hpp"

namespace talus::io {

/// Where a value is positive: filled with a colour ("#rrggbb"), and what that means.
struct FieldRegion {
  std::string label, colour;
  std::vector<FieldPatch> patches;
};

/// Of a logarithmic scale four decades are shown at most: down from the largest value, or up from
/// the smallest.
enum class LogEnd { high, low };

/// What a panel shows of a field. What is not a number is grey. On a logarithmic scale zero has the
/// lowest colour, a negative value none.
struct FieldMap {
  std::vector<FieldPatch> patches = {};  ///< none: regions and lines alone
  std::string value_label = {};          ///< over the colour bar, with its unit
  bool log_scale = false;
  LogEnd kept = LogEnd::high;
  /// Where colours change and isolines are, the ends of the colour bar among them; what lies beyond
  /// has the colour of the end. None: round ones.
  std::vector<double> levels = {};
  std::vector<Polyline> mesh_lines = {};  ///< edges of elements
  std::vector<Polyline> streamlines = {};
  std::vector<FieldRegion> regions = {};        ///< the later ones over the earlier
  std::optional<Window> window = std::nullopt;  ///< the part that is shown; none: all
  bool equal_axes = true;                       ///< else stretched to the panel
};

/// The levels that were given, or some ten round ones from the smallest to the largest value; on a
/// logarithmic scale powers of ten and halves of them, unless it is short. Of the values next to a
/// singular point one in a hundred may lie beyond them.
std::vector<double> levels_of(const FieldMap& map);

/// 1, 2 or 5 times a power of ten, at least so much.
double round_step(double least);

/// What is shown: the window, or the box around patches and regions.
Window window_of(const FieldMap& map);

/// How high a panel of this width is best, with title, labels and legend; in pixels.
int field_height(const FieldMap& map, int width);

/// The blocks of a panel in the data file of its figure.
std::string field_data(const FieldMap& map, const std::string& title);

/// The commands that draw them, in a panel that has its title and labels; `data` is the quoted name
/// of the data file, `block` the number of the panel's first block there, which is moved past its
/// last.
std::string field_script(const FieldMap& map, const std::string& data, std::size_t& block);

}  // namespace talus::io
