// The coordinates of an SVG of gnuplot's, told shorter.
#pragma once

#include <string>

namespace talus::io {

/// Paths and polygons relative and to tenths of a unit, which is a pixel of the smallest size they
/// are shown in; equal marks that follow each other placed in one group; texts without a group of
/// their own unless it turns them. For text as
/// without_padding() leaves it: what stands in <defs>, and paths of other commands than M, L and Z,
/// are left as they are.
std::string with_short_geometry(const std::string& svg);

}  // namespace talus::io
