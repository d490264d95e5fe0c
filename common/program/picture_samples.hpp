// A surface sampled for a picture.
#pragma once

#include "common/program/flow_picture.hpp"

namespace talus::program {

/// A facet, sampled on a grid.
struct Samples {
  std::size_t columns = 0;
  std::vector<PictureSample> at;
  std::vector<double> stream;  ///< none if there are no streamlines

  std::size_t rows() const { return at.size() / columns; }
  Samples mirrored() const;
};

/// All that there is to see.
io::Window window_around(const Surface& surface);

/// Every facet that is in the window, its mirror image too. There are some eighty cells along the
/// window: curves look like curves, and what is smaller than that is one cell. Neighbours have the
/// same points on the side that they share.
std::vector<Samples> samples_of(const Surface& surface, const io::Window& window);

}  // namespace talus::program
