// Work and precision of every scene in every model it has.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// A scene in one of its models, and the options that vary, as words after `./run study cost`.
struct WorkQuestion {
  std::string title, scene, words;
  double most_left = 0.5;  ///< of the error on the coarsest mesh, on the finest
};

/// Every scene in every model there is, under every law of the registry.
std::vector<WorkQuestion> work_questions(bool full);

/// One table of the same columns for all, a chart of error against time for each, and checks that
/// refining pays under every method. A case that does not arrive fails the check of its question.
void add_work_precision(Chapter& chapter, const std::vector<WorkQuestion>& questions,
                        const std::function<void(double)>& progress);

}  // namespace talus::verification
