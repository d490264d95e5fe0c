// What a run of the heap in three dimensions leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include "common/io/figure.hpp"
#include "common/io/vtu.hpp"
#include "common/program/flow_picture.hpp"
#include "common/scene/description.hpp"
#include "threed/heap_solve.hpp"

namespace talus::threed {

/// Of the program `heap`, for both models.
const scene::Description& description();

/// summary.json without the parameters: what the cross-section has, taken at half the length, then
/// cross-flow, dynamic pressure, cost of every mesh, memory.
nlohmann::json summary(const HeapSolution& solution, const shear::CrossSection<2>& section_space);

/// Velocity at the nodes; shear rate, inertial number, pressures and stress in the elements.
io::Grid<3> grid(const HeapSolution& solution);

/// The figure of the section at half the length.
io::Figure figure(const HeapSolution& solution, const shear::CrossSection<2>& section_space);

/// The fields in the section at half the length.
io::Figure picture(const HeapSolution& solution, const std::string& title,
                   const program::PictureOptions& options);

/// One line a mesh: what was solved there, and what it took.
std::string mesh_lines(const HeapSolution& solution);

/// Adds to the results how far the velocities are from those of the section on the same mesh,
/// relative to the largest, and what that took.
void add_comparison(nlohmann::json& summary, const HeapSolution& solution,
                    const twod::SectionSolution& section);
/// Cross-flow and dynamic pressure in a line; that the cross-section would have done, with figures
/// if it was solved too.
std::string comparison_lines(const HeapSolution& solution, const twod::SectionSolution* section);

}  // namespace talus::threed
