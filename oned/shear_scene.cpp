#include "oned/shear_scene.hpp"

#include "common/fem/line_mesh.hpp"
#include "common/io/result_folder.hpp"

namespace talus::oned {

std::vector<double> boundaries(const ShearScene& scene, const MeshOptions& mesh) {
  if (!mesh.align) return fem::graded_line(0, scene.length, mesh.elements, mesh.grading);
  if (!scene.yield_point)
    throw io::UserError(
        "--align: this load leaves no yield point inside the section to align with");
  if (!fem::can_align(scene.length, mesh.elements, *scene.yield_point, *mesh.align))
    throw io::UserError("--elements: '" + std::to_string(mesh.elements) +
                        "' is too few for --align; take more elements");
  return fem::aligned_line(scene.length, mesh.elements, *scene.yield_point, *mesh.align,
                           mesh.grading);
}

}  // namespace talus::oned
