// What gnuplot writes as SVG, made smaller.
#pragma once

#include <string>

namespace talus::io {

/// An SVG of gnuplot's without what says nothing, which is half of it, with its geometry told
/// shorter. The font, as attributes, is told once.
std::string without_padding(const std::string& svg, const std::string& font);

}  // namespace talus::io
