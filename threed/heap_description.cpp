#include <algorithm>
#include <iterator>

#include "threed/heap_report.hpp"
#include "threed/unidirectional_program.hpp"

namespace talus::threed {

const scene::Description& description() {
  static const scene::Description heap = [] {
    scene::Description all{
        .name = "heap",
        .title = "flow on a heap between rough side walls",
        .models = {"line", "section", "space"},
        .mesh_option = "--elements",
        .problem_options = {"--angle", "--flow-rate", "--wall", "--wall-friction", "--width",
                            "--height", "--friction"},
        .main_quantity = "flow_rate",
        .quantities = {
            {"flow_rate", "d sqrt(gd)", "Q*, flux per width of the channel"},
            {"angle", "1", "inclination, in radians"},
            {"surface_velocity", "sqrt(gd)", "velocity at the surface, in the middle"},
            {"depth_1_percent", "d", "where the velocity falls to 1% of that at the surface"},
            {"depth_5_percent", "d", "where the velocity falls to 5% of that at the surface"},
            {"depth_yield", "d", "where the stress falls to the yield stress"},
            {"slip_at_surface", "sqrt(gd)", "velocity at the side wall, at the surface"},
            {"yielded_share", "1", "share of the section that yields"},
            {"exact_flow_rate", "d sqrt(gd)", "exact flow rate of the line"},
            {"cross_flow", "sqrt(gd)", "largest velocity across the stream"},
            {"dynamic_pressure", "φρgd", "largest dynamic pressure"},
            {"change_along", "1", "largest change of the velocity along the stream, relative"},
            {"departure_from_section", "1",
             "largest distance of the velocity from the section's"}}};
    std::ranges::copy(quantities_of_line(), std::back_inserter(all.quantities));
    return all;
  }();
  return heap;
}

}  // namespace talus::threed
