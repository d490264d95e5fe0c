// What a run of the heap's cross-section leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include "common/io/figure.hpp"
#include "common/io/table.hpp"
#include "common/io/vtu.hpp"
#include "common/program/flow_picture.hpp"
#include "twod/section.hpp"

namespace talus::twod {

/// summary.json without the parameters.
nlohmann::json summary(const SectionSolution& solution, const shear::CrossSection<2>& space);

/// What each mesh took, one line each; none if there was only one.
std::string mesh_lines(const SectionSolution& solution);

/// y, surface velocity, depths of the flowing layer.
io::Table surface_table(const SectionSolution& solution, const shear::CrossSection<2>& space);

/// Velocity at the points; shear rate, I, pressure, stress and stress over μs p on the cells
/// (means).
io::QuadraticGrid grid(const SectionSolution& solution, const shear::CrossSection<2>& space);

/// Velocity over the height at four places across (the paper's Fig. 11).
io::Panel profiles(const SectionSolution& solution, const shear::CrossSection<2>& space,
                   const std::string& title);

/// Surface velocity, depths (the paper's Fig. 10) and velocity profiles below the surface (Fig.
/// 11).
io::Figure figure(const SectionSolution& solution, const shear::CrossSection<2>& space);

/// Units and axes of pictures of a section, in any model.
program::PictureLabels picture_labels(const std::string& name, const std::string& title);

/// The fields, under the law that was solved.
io::Figure picture(const SectionSolution& solution, const shear::CrossSection<2>& space,
                   const rheology::Rheology& rheology, const std::string& title,
                   const program::PictureOptions& options);

}  // namespace talus::twod
