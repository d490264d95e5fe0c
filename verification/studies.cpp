#include "verification/harness/chapter.hpp"

namespace talus::verification {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"jacobian",
       "Is every tangent the derivative of its residual?",
       jacobian_study,
       {0.18, 0.18}},
      {"orders",
       "Does the error fall with the element size as theory says?",
       orders_study,
       {0.35, 3.9}},
      {"paper",
       "Which figures of the paper do we reproduce, and which not?",
       paper_study,
       {0.03, 0.03}},
      {"cost", "What is the cheapest way to a given error?", cost_study, {0.35, 4.8}, true},
      {"stability", "Where do the methods fail, and do they say so?", stability_study, {0.45, 7.2}},
      {"heap",
       "What does the heap's cross-section owe to its mesh, and what to λr?",
       heap_study,
       {0.2, 1.1}},
      {"ladder",
       "Which model does a scene need, and what do richer ones cost?",
       ladder_study,
       {0.2, 3.7},
       true},
      {"cylinder",
       "How does the flow around a cylinder set in, and what folds its path?",
       cylinder_study,
       {0.2, 5.7}}};
  return all;
}

}  // namespace talus::verification
