// The parts of the orders study.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Every case that these scenes declare, against their exact solutions.
void orders_of(Chapter& chapter, const std::vector<oned::ShearScene>& scenes,
               const Context& context);

/// The chapter's answer: how far the orders it has checked, of that kind, are from those of theory.
void answer_orders(Chapter& chapter, const std::string& where, Kind kind);

/// That of every scene on a line, and the error on the graded mesh.
void line_orders(Chapter& chapter, const Context& context);

/// The order of Q* of the heap's section, for every method and both walls.
void section_orders(Chapter& chapter, const Context& context);

/// Manufactured flows in the plane and in space: every flow and law, in the plane every mesh family
/// too, with and without inertia. A part of them if the study is quick.
void plane_orders(Chapter& chapter, const Context& context);
void space_orders(Chapter& chapter, const Context& context);

}  // namespace talus::verification
