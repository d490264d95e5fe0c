// Solves of the cylinder that its tests share.
#pragma once

#include <boost/test/unit_test.hpp>

#include "twod/cylinder.hpp"

namespace talus::twod {

inline Cylinder cylinder_of(int around, double lambda_r = 1e-6) {
  Cylinder scene;
  scene.mesh = refined_to(around);
  scene.lambda_r = lambda_r;
  return scene;
}

inline double relative(double value, double reference) {
  return std::abs(value / reference - 1);
}

inline void solve_at(CylinderFlow& cylinder, double loading, double lambda_r,
                     CylinderFlow::State& state, double tolerance = 1e-13) {
  cylinder.flow().set_load_factor(loading);
  cylinder.flow().set_lambda_r(lambda_r);
  const auto newton = solve::newton(cylinder.flow(), state,
                                    {.tolerance = tolerance,
                                     .max_iterations = 50,
                                     .line_search = solve::LineSearch::residual_norm});
  BOOST_REQUIRE_MESSAGE(solve::is_success(newton.end), solve::name_of(newton.end));
}

inline CylinderFlow::State creep(CylinderFlow& cylinder, double loading) {
  CylinderFlow::State state;
  const auto newton = solve_creep(cylinder, loading, state);
  BOOST_REQUIRE_MESSAGE(solve::is_success(newton.end), solve::name_of(newton.end));
  return state;
}

inline CylinderMeasures creep_at(const Cylinder& scene, double loading) {
  CylinderFlow cylinder(scene);
  return measure(cylinder, creep(cylinder, loading));
}

}  // namespace talus::twod
