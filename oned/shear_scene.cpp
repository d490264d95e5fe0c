#include "oned/shear_scene.hpp"

#include "common/fem/line_mesh.hpp"
#include "common/io/result_folder.hpp"
#include "common/io/table.hpp"
#include "common/program/grading.hpp"

namespace talus::oned {

std::string rest_limit(const rheology::Rheology& limit, const std::string& load, double bound) {
  return rheology::has_yield_stress(limit.regularisation)
             ? "at rest for " + load + io::rounded(bound, 6) + ", "
             : "creeps under any load, ";
}

std::vector<double> boundaries(const ShearScene& scene, const MeshOptions& mesh) {
  program::check_grading("--grading", mesh.grading, mesh.elements);
  if (!mesh.align) return fem::graded_line(0, scene.length, mesh.elements, mesh.grading);
  if (!scene.kink)
    throw io::UserError(
        "--align: this load leaves no kink of the profile inside the section to align with");
  if (!fem::can_align(scene.length, mesh.elements, *scene.kink, *mesh.align))
    throw io::UserError("--elements: '" + std::to_string(mesh.elements) +
                        "' is too few for --align; take more elements");
  return fem::aligned_line(scene.length, mesh.elements, *scene.kink, *mesh.align, mesh.grading);
}

}  // namespace talus::oned
