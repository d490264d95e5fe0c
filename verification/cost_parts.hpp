// The parts of the cost study that are about flow in a plane.
#pragma once

#include "verification/chapter.hpp"

namespace talus::verification {

/// Drag and U of the cylinder: meshes, half and full domain, plain and iterated penalty.
void add_cylinder_cost(Chapter& chapter, const Context& context);
/// Q* of the heap's section: meshes, walls, methods.
void add_section_cost(Chapter& chapter, const Context& context);

/// A whole program, from process start to its files, on the wall.
void add_program_cost(Chapter& chapter);

}  // namespace talus::verification
