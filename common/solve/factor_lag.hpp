// How long old factors are worth keeping as a preconditioner.
#pragma once

namespace talus::solve {

/// Counts what solves have cost since the last factorisation, in iterations with its factors. The
/// average cost of a solve falls until the next one costs more than it: then factors are due.
class FactorLag {
 public:
  /// New factors, which cost as much as so many iterations, have served their first solve.
  void factored(double iterations) {
    cost_ = iterations;
    solves_ = 1;
  }
  /// They have served one more.
  void iterated(int iterations) {
    cost_ += iterations;
    ++solves_;
  }
  /// Iterations that the next solve may take before it costs more than the average; 0 without
  /// factors.
  int budget() const { return solves_ == 0 ? 0 : static_cast<int>(cost_ / solves_); }

 private:
  double cost_ = 0;
  int solves_ = 0;
};

}  // namespace talus::solve
