#include "twod/flow_rate_search.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

namespace talus::twod {
namespace {

constexpr double rate_tolerance = 5e-9;  // relative
constexpr int coarsening = 4;
constexpr int most_angles = 60;

// log(Q*/target) as a function of the angle, with the solution last found.
class Excess {
 public:
  Excess(double target, const Section& section, const SectionMesh& mesh,
         flow::CrossSection<2>& space, const flow::ShearOptions& options, Start start)
      : target_(target),
        section_(section),
        mesh_(mesh),
        space_(space),
        options_(options),
        start_(start) {}

  double operator()(double angle) {
    constexpr double rate_of_rest = 1e-12;  // far below every other
    section_.angle = angle;
    // A plug does not form again from a faster flow: where the last solution leads nowhere, rest
    // does.
    const flow::ShearStart<2> before{std::move(last_.velocity)};
    const bool has_before = before.velocity.size() > 0;
    if (has_before) last_ = solve(section_, space_, options_, &before);
    if (!has_before || !solve::is_success(last_.end))
      last_ = start_ == Start::nested ? solve_nested(section_, mesh_, space_, options_)
                                      : solve(section_, space_, options_);
    if (!solve::is_success(last_.end))
      throw std::runtime_error(solve::name_of(last_.end) + " at an angle of " +
                               std::to_string(angle) + ": " + solve::advice_for(last_.end));
    return std::log(std::max(flow_rate(last_, space_), rate_of_rest) / target_);
  }
  const SectionSolution& last() const { return last_; }

 private:
  double target_;
  Section section_;
  SectionMesh mesh_;
  flow::CrossSection<2>& space_;
  const flow::ShearOptions& options_;
  Start start_;
  SectionSolution last_;
};

double smallest_angle(const Section& section) {
  return std::atan(section.law.mu_s);
}

double largest_angle(const Section& section) {
  return std::atan(section.law.mu_2());
}

// Brackets the angle from below, then Brent's method.
void search_by_bracket(Excess& excess, const Section& section) {
  // Flow starts above arctan μs, later than that because of the side walls.
  double lower = smallest_angle(section), upper = lower + 0.02;
  while (excess(upper) < 0) {
    lower = upper;
    upper += 0.02;
    if (upper > largest_angle(section))
      throw std::runtime_error("no angle below arctan mu_2 reaches this flow rate");
  }
  struct Callback {
    Excess& excess;
    double value = 1;
    std::exception_ptr error;
  } callback{excess, 1, nullptr};
  gsl_function f{[](double angle, void* data) {
                   auto* self = static_cast<Callback*>(data);
                   try {
                     return self->value = self->excess(angle);
                   } catch (...) {  // must not cross GSL's frames
                     self->error = std::current_exception();
                     return std::nan("");
                   }
                 },
                 &callback};
  gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  gsl_root_fsolver* solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
  int status = gsl_root_fsolver_set(solver, &f, lower, upper);
  for (int i = 0; i < most_angles && status == GSL_SUCCESS; ++i) {
    status = gsl_root_fsolver_iterate(solver);
    if (std::abs(callback.value) < rate_tolerance) break;
  }
  gsl_root_fsolver_free(solver);
  gsl_set_error_handler(previous);
  if (callback.error) std::rethrow_exception(callback.error);
  if (std::abs(callback.value) >= rate_tolerance)
    throw std::runtime_error("no angle was found with this flow rate");
}

// Secants from an angle near the root and d log Q*/dα there.
void search_by_secants(Excess& excess, const Section& section, double angle, double slope) {
  double value = excess(angle);
  for (int i = 0; std::abs(value) >= rate_tolerance; ++i) {
    if (i == most_angles) throw std::runtime_error("no angle was found with this flow rate");
    const double next =
        std::clamp(angle - value / slope, smallest_angle(section), largest_angle(section));
    const double value_next = excess(next);
    if (next != angle && value_next != value) slope = (value_next - value) / (next - angle);
    angle = next;
    value = value_next;
  }
}

}  // namespace

SectionSolution solve_for_flow_rate(double target, const Section& section, const SectionMesh& mesh,
                                    flow::CrossSection<2>& space, const flow::ShearOptions& options,
                                    Start start) {
  Excess excess(target, section, mesh, space, options, start);
  SectionMesh coarse = mesh;
  coarse.across /= coarsening;
  coarse.up /= coarsening;
  if (std::min(coarse.across, coarse.up) < CoarserMesh::fewest_elements) {
    search_by_bracket(excess, section);
  } else {
    constexpr double difference = 1e-4;  // of the angle, for the slope
    auto coarse_space = space_of(section, coarse);
    const auto guess = solve_for_flow_rate(target, section, coarse, coarse_space, options, start);
    Excess coarse_excess(target, section, coarse, coarse_space, options, start);
    const double angle = guess.section.angle;
    const double slope = coarse_excess(angle + difference) / difference;
    search_by_secants(excess, section, angle, slope);
  }
  return excess.last();
}

}  // namespace talus::twod
