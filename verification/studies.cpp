#include "verification/harness/chapter.hpp"

namespace talus::verification {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"jacobian",
       "Is every tangent the derivative of its residual?",
       jacobian_study,
       {0.14, 0.14}},
      {"orders",
       "Does the error fall with the element size as theory says?",
       orders_study,
       {0.3, 2.9}},
      {"paper",
       "Which figures of the paper do we reproduce, and which not?",
       paper_study,
       {0.03, 0.03}},
      {"cost", "What is the cheapest way to a given error?", cost_study, {0.35, 10}, true},
      {"stability", "Where do the methods fail, and do they say so?", stability_study, {0.45, 6.5}},
      {"heap",
       "What does the heap's cross-section owe to its mesh, and what to λr?",
       heap_study,
       {0.2, 1.1}},
      {"ladder",
       "Which model does a scene need, and what do richer ones cost?",
       ladder_study,
       {0.2, 7},
       true},
      {"cylinder",
       "How does the flow around a cylinder set in, and what folds its path?",
       cylinder_study,
       {0.2, 3.5}}};
  return all;
}

}  // namespace talus::verification
