// The parts of the studies that are about velocity-pressure flow.
#pragma once

#include "verification/chapter.hpp"

namespace talus::verification {

/// The tangent of every law at every state, and broken ones: into the Jacobian study.
void check_dense_tangents(Chapter& chapter);

/// Every manufactured flow, law and mesh family, with and without inertia: into the orders study. A
/// part of them if the study is quick.
void manufactured_orders(Chapter& chapter, const Context& context);

/// What an element of velocity-pressure flow costs, part by part, and a Newton step with it: into
/// the cost study.
void dense_kernel_costs(Chapter& chapter, const Context& context);

/// Error against time in 3D for every way to solve the linear systems: into the cost study.
void dense_work(Chapter& chapter, const Context& context);

}  // namespace talus::verification
