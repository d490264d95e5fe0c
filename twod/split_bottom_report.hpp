// What a run of the split-bottom cell leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include "common/io/figure.hpp"
#include "common/io/table.hpp"
#include "common/scene/description.hpp"
#include "twod/split_bottom.hpp"

namespace talus::twod {

/// What the scene says of itself.
const scene::Description& split_bottom_description();

/// summary.json without the parameters: outcome and results, none if the solve failed.
nlohmann::json summary(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);

/// z, centre and width of the zone, and the curve of least resistance where there is one.
io::Table zone_table(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);
/// r and ω/Ω at the nodes of the surface.
io::Table surface_table(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);

/// The zone in the cell, and the angular velocity at the surface.
io::Figure figure(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);

}  // namespace talus::twod
