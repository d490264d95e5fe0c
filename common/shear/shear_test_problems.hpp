// The two unidirectional flows of the paper as bare data, for the tests of both solvers.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "common/fem/line_mesh.hpp"
#include "common/shear/interior_point.hpp"
#include "common/shear/shear_flow.hpp"

namespace talus::shear {

/// A layer on a line, no slip at one end and no stress at the other; it owns its space.
struct Layer {
  CrossSection<1> space;
  std::function<double(const CrossSection<1>::Vector&)> pressure, body_force;

  ShearFlow<1> regularised(const rheology::Regularisation& regularisation, double lambda_r) {
    return {space, {{}, regularisation, lambda_r}, pressure, body_force};
  }
  InteriorPoint<1> unregularised() { return {space, {}, pressure, body_force}; }
};

/// Half a chute of width 28: a plug in [0, μs p], shear at the wall at 14.
inline Layer chute_layer(double pressure, int elements, double grading = 1) {
  return {CrossSection<1>(fem::line_mesh(fem::graded_line(0, 14, elements, grading), false, true)),
          [=](const auto&) { return pressure; }, [](const auto&) { return 1.; }};
}

/// A layer of depth 14 on a plane of this inclination: pressure vanishes at the free surface.
inline Layer plane_layer(double angle, int elements, double grading = 1) {
  return {CrossSection<1>(fem::line_mesh(fem::graded_line(0, 14, elements, grading), true, false)),
          [=](const auto& z) { return (14 - z[0]) * std::cos(angle); },
          [=](const auto&) { return std::sin(angle); }};
}

}  // namespace talus::shear
