// The derivatives of the viscosity alone, laid out for the Jacobian check.
#pragma once

#include <string>
#include <vector>

#include "common/rheology/rheology.hpp"
#include "common/solve/jacobian_check.hpp"

namespace talus::shear {

struct LawState {
  std::string name;
  double shear_rate, total_pressure;
};

/// Where a regularised law is awkward, in its own units: in plug, at yield, just flowing and in
/// flow at this pressure; at a tiny and at a negative one.
std::vector<LawState> law_states(const rheology::Rheology& rheology, double pressure);

/// η at every state as a function of shear rate and total pressure: a block of one row a state, a
/// block of columns each of |γ| and p.
solve::JacobianProblem law_problem(const rheology::Rheology& rheology,
                                   const std::vector<LawState>& states);

/// The law at all of them.
solve::NamedCheck check_law(const rheology::Rheology& rheology, double pressure);

}  // namespace talus::shear
