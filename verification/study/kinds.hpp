// The kinds of studies: what each makes of the table of its cases.
#pragma once

#include "verification/harness/chapter.hpp"
#include "verification/study/case_table.hpp"

namespace talus::study {

/// The order of one curve of errors.
struct Fit {
  std::string quantity, curve;
  double order = 0;  ///< NaN if too few points fall
  int points = 0;    ///< that were fitted
};

/// What a study finds, beside its cases.
struct Findings {
  verification::Chapter chapter;
  std::vector<Fit> fits = {};                                  ///< of converge
  std::vector<std::pair<std::string, const Row*>> front = {};  ///< of cost: curve and case
};

struct Kind {
  std::string name, question;
  bool measures_time = false;  ///< cases run alone, unless --jobs is given
  /// Throws io::UserError if the options that vary are not enough for it.
  void (*admit)(const Table& table);
  Findings (*find)(Table& table);
};

const std::vector<Kind>& kinds();
/// Throws io::UserError, with the names there are.
const Kind& kind_named(const std::string& name);

/// Errors against the size of the elements, with orders.
Findings converge(Table& table);
/// Errors against CPU time, with the cases that no other beats in both.
Findings cost(Table& table);
/// Which cases arrive over two of the options, and how the others end.
Findings stability(Table& table);
/// Quantities against the first option that varies in numbers.
Findings sweep(Table& table);
/// The models of a scene beside each other: how far apart, and what each takes.
Findings ladder(Table& table);

/// The first option that varies in numbers: a sweep is along it. Throws io::UserError if none does.
Varied axis_of_sweep(const Table& table);

/// The order that errors of these sizes show: over the finest four, or three, between which it is
/// the same within 15%, so that neither round-off at the fine end nor a coarse one that is not yet
/// on its way counts; over all where there are none.
Fit fitted(const std::vector<double>& sizes, const std::vector<double>& errors);

/// The rows that no other beats in both numbers; the smallest second number last.
std::vector<const Row*> pareto_front(const std::vector<const Row*>& rows, const std::string& first,
                                     const std::string& second);

}  // namespace talus::study
