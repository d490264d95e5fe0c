#include "verification/chapter.hpp"

namespace talus::verification {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      {"jacobian", "Is every tangent the derivative of its residual?", jacobian_study},
      {"orders", "Does the error fall with the element size as theory says?", orders_study},
      {"paper", "Which figures of the paper do we reproduce, and which not?", paper_study},
      {"cost", "What is the cheapest way to a given error?", cost_study, true},
      {"stability", "Where do the methods fail, and do they say so?", stability_study},
      {"heap", "What does the heap's cross-section owe to its mesh, and what to λr?", heap_study},
      {"ladder", "Which model does a scene need, and what do richer ones cost?", ladder_study,
       true},
      {"cylinder", "How does the flow around a cylinder set in, and what folds its path?",
       cylinder_study}};
  return all;
}

}  // namespace talus::verification
