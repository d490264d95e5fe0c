#include "verification/cost/cost_parts.hpp"
#include "verification/cylinder/cylinder_parts.hpp"
#include "verification/heap/heap_study.hpp"
#include "verification/jacobian/jacobian_parts.hpp"
#include "verification/ladder/ladder.hpp"
#include "verification/models/model_error.hpp"
#include "verification/orders/orders_parts.hpp"
#include "verification/paper/paper_parts.hpp"
#include "verification/references/references_study.hpp"
#include "verification/stability/stability_parts.hpp"
#include "verification/zone/zone_study.hpp"

namespace talus::verification {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"jacobian",
       "Is every tangent the derivative of its residual?",
       {{"", jacobian_study, {0.18, 0.18}}}},
      {"orders",
       "Does the error fall with the element size as theory says?",
       {{"lines", line_orders, {0.02, 0.04}},
        {"section", section_orders, {0.12, 0.53}},
        {"plane", plane_orders, {0.07, 0.65}},
        {"space", space_orders, {0.11, 2.3}}}},
      {"paper",
       "Which figures of the paper do we reproduce, and which not?",
       {{"lines", paper_lines, {0.05, 0.05}},
        {"heap", paper_heap, {0.03, 0.2}},
        {"cylinder", paper_cylinder, {0.27, 1.8}}},
       open_figures_of_the_paper()},
      {"references",
       "What do others find for the same scenes?",
       {{"lines", references_of_lines, {0.01, 0.01}},
        {"heap", references_of_heap, {0.1, 0.6}},
        {"cylinder", references_of_cylinder, {0.3, 3}}}},
      {"cost",
       "What is the cheapest way to a given error?",
       {{"lines", line_costs, {0.16, 0.5}, true},
        {"scenes", scene_costs, {0.25, 3}, true},
        {"programs", program_costs, {0.01, 0.01}, true},
        {"elements", element_costs, {0.03, 1.5}, true},
        {"linear-solvers", linear_solver_costs, {0.07, 1.2}, true},
        {"section", section_costs, {0.04, 0.9}, true},
        {"cylinder", cylinder_costs, {0.04, 1.0}, true}}},
      {"stability",
       "Where do the methods fail, and do they say so?",
       {{"maps", maps, {0.24, 1.0}},
        {"models", model_maps, {0.2, 3.5}},
        {"interior-point", interior_point_counts, {0.01, 0.01}},
        {"limits", limits, {0.01, 0.03}},
        {"round-off", round_off_floor, {0.01, 0.02}},
        {"cylinder", cylinder_atlas, {0.12, 4.7}},
        {"penalties", cylinder_penalties, {0.06, 0.5}}}},
      {"heap",
       "What does the heap's cross-section owe to its mesh, and what to λr?",
       {{"", heap_study, {0.17, 1.0}}}},
      {"ladder",
       "Which model does a scene need, and what do richer ones cost?",
       {{"", ladder_study, {0.2, 4}, true}}},
      {"models",
       "Where is a poorer model wrong, and by how much?",
       {{"", heap_on_a_line, {0.05, 0.5}, true}}},
      {"zone", "Where does slow flow over a split bottom shear?", {{"", zone_study, {0.3, 2}}}},
      {"cylinder",
       "How does the flow around a cylinder set in, and what folds its path?",
       {{"meshes", cylinder_meshes, {0.01, 0.5}},
        {"outlets", cylinder_outlets, {0.03, 0.03}},
        {"paths", cylinder_paths, {0.23, 4.6}}}}};
  return all;
}

}  // namespace talus::verification
