// The parts of the cost study.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Error against CPU time on a line, what precision costs there, and an iteration an element.
void line_costs(Chapter& chapter, const Context& context);
/// Work and precision of every scene in every model, in one table: see scene_cost.hpp.
void scene_costs(Chapter& chapter, const Context& context);
/// A whole program, from process start to its files, on the wall.
void program_costs(Chapter& chapter, const Context& context);
/// What an element of velocity-pressure flow costs, piece by piece, and a Newton step with it.
void element_costs(Chapter& chapter, const Context& context);
/// Error against time in 3D for every way to solve the linear systems.
void linear_solver_costs(Chapter& chapter, const Context& context);
/// Q* of the heap's section: meshes, walls, methods.
void section_costs(Chapter& chapter, const Context& context);
/// Drag and U of the cylinder: meshes, half and full domain, plain and iterated penalty.
void cylinder_costs(Chapter& chapter, const Context& context);

}  // namespace talus::verification
