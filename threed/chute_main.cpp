// Flow in a vertical chute between rough walls: a plug in the middle, shear at the walls. On a
// line, or in velocity and pressure, in the plane or in space.
//
// Sample runs (the test suite runs them):
//   chute
//   chute --elements 17 --align --lambda-r 1e-8 --plot
//   chute --method interior-point --elements 160
//   chute --regularisation papanastasiou --elements 10 --check-jacobian
//   chute --pressure 40
//   chute --model plane --elements 17 --align --lambda-r 1e-6 --plot
//   chute --model space --elements 10 --penalty plain --precision plain --threads 2
//   chute --model space --elements 3 --check-jacobian
#include "common/io/options.hpp"
#include "oned/chute.hpp"
#include "threed/unidirectional_program.hpp"

using namespace talus;

int main(int argc, char** argv) {
  io::CommandLine line{
      "Dense granular flow in a vertical chute, quadratic elements on half the width", "chute"};
  oned::Chute chute;
  threed::UnidirectionalProgram options;
  options.method.lambda_r = scene_of(chute).lambda_r;
  io::add_real(line, "--pressure", chute.pressure, "Confining pressure p, in φρgd", 1e-3, 1e6);
  io::add_real(line, "--width", chute.width, "Width b, in d", 1e-3, 1e6);
  threed::add_options(line, options, "chute");
  const auto align = [&](const std::string& fraction) {
    options.mesh.align = fraction.empty() ? 0 : io::real_in_range("--align", fraction, 0, 0.99);
  };
  io::add_value(line, "--align", "FLOAT",
                "Put the edge of the plug at this fraction of its element; alone: on a node "
                "[0 ... 0.99]",
                align)
      .takes(0, 1);
  const scene::Description description =
      threed::description_of(scene_of(chute), {"--pressure", "--width", "--friction"});
  scene::Case a_case(line, description);
  return a_case.run_program(argc, argv, [&] {
    chute.law = friction_law(options.method);
    chute.regularisation = limiting_law(options.method);
    return run(line, scene_of(chute), options,
               {.parameters = {{"pressure", chute.pressure}, {"width", chute.width}}}, a_case);
  });
}
