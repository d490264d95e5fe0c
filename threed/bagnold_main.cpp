// Flow down a rough inclined plane: Bagnold's profile, singular at the free surface. On
// a line, or in velocity and pressure, in the plane or in space.
//
// Sample runs (the test suite runs them):
//   bagnold
//   bagnold --elements 20 --grading 2 --plot
//   bagnold --method interior-point --elements 160 --grading 3
//   bagnold --regularisation simple --elements 10 --check-jacobian
//   bagnold --angle 0.3
//   bagnold --model plane --elements 20 --grading 2 --tangent primal-dual
//   bagnold --model space --elements 10 --lambda-r 1e-6 --tolerance 1e-14 --plot
//   bagnold --model plane --elements 5 --check-jacobian
#include "common/io/options.hpp"
#include "oned/bagnold.hpp"
#include "threed/unidirectional_program.hpp"

using namespace talus;

int main(int argc, char** argv) {
  io::CommandLine line{"Dense granular flow down an inclined plane, quadratic elements", "bagnold"};
  oned::Bagnold bagnold;
  threed::UnidirectionalProgram options;
  options.method.lambda_r = scene_of(bagnold).lambda_r;
  io::add_angle(line, "--angle", bagnold.angle, "Inclination α", 1e-3, 1.57);
  io::add_real(line, "--height", bagnold.height, "Depth of the layer H, in d", 1e-3, 1e6);
  threed::add_options(line, options, "bagnold");
  const scene::Description description =
      threed::description_of(scene_of(bagnold), {"--angle", "--height", "--friction"});
  scene::Case a_case(line, description);
  return a_case.run_program(argc, argv, [&] {
    bagnold.law = friction_law(options.method);
    bagnold.regularisation = limiting_law(options.method);
    return run(line, scene_of(bagnold), options,
               {.parameters = {{"angle", bagnold.angle}, {"height", bagnold.height}}}, a_case);
  });
}
