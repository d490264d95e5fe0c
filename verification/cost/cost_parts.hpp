// The parts of the cost study beside that of flow on a line.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Drag and U of the cylinder: meshes, half and full domain, plain and iterated penalty.
void add_cylinder_cost(Chapter& chapter, const Context& context);
/// Q* of the heap's section: meshes, walls, methods.
void add_section_cost(Chapter& chapter, const Context& context);

/// What an element of velocity-pressure flow costs, part by part, and a Newton step with it.
void mixed_kernel_costs(Chapter& chapter, const Context& context);

/// Error against time in 3D for every way to solve the linear systems.
void mixed_work(Chapter& chapter, const Context& context);

/// A whole program, from process start to its files, on the wall.
void add_program_cost(Chapter& chapter);

}  // namespace talus::verification
