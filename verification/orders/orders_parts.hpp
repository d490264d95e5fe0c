// The parts of the orders study.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// The orders study of these scenes: every case they declare, against their exact solutions.
Chapter orders_of(const std::vector<oned::ShearScene>& scenes, const Context& context);

/// Adds the order of Q* of the heap's section, for every method and both walls.
void add_section_orders(Chapter& chapter, const Context& context);

/// Every manufactured flow, law and mesh family, with and without inertia. A part of them if the
/// study is quick.
void manufactured_orders(Chapter& chapter, const Context& context);

}  // namespace talus::verification
