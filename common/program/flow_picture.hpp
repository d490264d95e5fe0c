// Pictures of a flow: which fields, from which surface, and how they are drawn.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/io/command_line.hpp"
#include "common/io/figure.hpp"
#include "common/program/flow_view.hpp"

namespace talus::program {

/// A place of the picture and what is there.
struct PictureSample {
  io::PlanePoint at;
  double speed = 0, stress = 0;
  rheology::LocalState law;
};

/// What a picture shows: quadrilaterals, each with coordinates in [-1, 1]².
struct Surface {
  std::size_t count = 0;
  std::function<PictureSample(std::size_t facet, const fem::Point<2>& reference)> sample;
  std::function<double(std::size_t facet, const fem::Point<2>& reference)> stream = {};  ///< ψ
  bool is_mirrored = false;  ///< the other half is drawn as well: x = 0 is a plane of symmetry
};

/// The elements of a plane flow, or of a cross-section.
Surface surface_of(const FlowView<2>& view);
/// The same, with the streamlines of a plane flow.
Surface surface_of(const mixed::MixedFlow<2>& flow, const solve::CompensatedVector& state);
/// A cut through space where coordinate `axis` has a value; the other two span the picture in their
/// order. Along a side of elements it shows those on its lower side, else it goes through them.
/// Throws std::invalid_argument if the elements there are not straight along the axis (those of
/// tensor and of extruded meshes are).
Surface cut_of(const FlowView<3>& view, int axis, double value);

/// Labels of a scene: units, axes, and what is drawn.
struct PictureLabels {
  std::string name = {}, title = {}, caption = {};                      ///< of the figure
  std::string x = {}, y = {};                                           ///< axes, with units
  std::string velocity = {}, pressure = {}, rate = {}, viscosity = {};  ///< units; none: a number
  bool equal_axes = true;
};

/// As typed.
struct PictureOptions {
  std::string fields = {};  ///< names joined by commas; empty: all, without the mesh
  std::string window = {};  ///< X,Z of its lower left, X,Z of its upper right corner; or empty
};
/// Adds --fields and --window, which --plot uses.
void add_pictures(io::CommandLine& line, PictureOptions& options);
/// Throws io::UserError for options that are given without --plot, a name that there is not, or a
/// window that is none.
void check_pictures(const io::CommandLine& line, const PictureOptions& options, bool plots);

/// A panel for each field, three in a row. `usual_window` is what is shown unless `options` say;
/// none: all of the surface.
io::Figure picture(const Surface& surface, const rheology::FrictionLaw& law,
                   const PictureLabels& labels, const PictureOptions& options,
                   const std::optional<io::Window>& usual_window = std::nullopt);

}  // namespace talus::program
