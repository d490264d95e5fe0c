// The cylinder on the page of the paper: what Figs 12 to 16 are judged by, apart from the solves.
#pragma once

#include <limits>

#include "verification/cylinder/cylinder_runs.hpp"
#include "verification/paper/paper_parts.hpp"

namespace talus::verification {

/// Confining pressures in φρgD. The paper has five, of which its text names the last.
inline const std::vector<double> confining_pressures = {1, 2, 3, 5, 10};

/// A law's flows at the loadings of Fig. 12, and what to call them.
struct LawFlows {
  std::string law, suffix;  ///< the second of the names of figures
  Flows flows;

  /// Empty if it was not reached.
  const twod::CylinderFlow::State& state_at(double loading) const {
    return flows.states[flows.index_of(loading)];
  }
};

/// Pressure and velocity at a loading, both halves (Figs 13 and 14); no panel if it was not
/// reached.
io::Figure primary_variables(const LawFlows& law, double loading, const io::Window& window);
/// Viscosity and, with a yield stress, its two parts: at one loading on the left half, at another
/// on the right one (Fig. 16).
io::Figure viscosities(const LawFlows& law, double left, double right, const io::Window& window);

/// A sweep of the loading, which falls nowhere, and what is read off it. NaN of one that is not
/// whole.
struct DragCurve {
  std::vector<twod::CylinderMeasures> sweep;

  /// U where creep ends: the largest below 20 λr.
  double end_of_creep() const;
  /// Of C_D over Fr, for every confining pressure the same: fitted over U > 0.005.
  double exponent() const;
  /// C_D/p_ext of the confining pressures at one Fr: the largest over the smallest, worst Fr.
  double spread() const;
  /// What the drag gains from F = 0.049 on, where flow sets in, over what it is there.
  double gain() const;
  /// d log F_D/d log U between the last two loadings.
  double last_slope() const;
};

/// A flow around the cylinder, by numbers; NaN of one that was not found.
struct Wake {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double stagnation_angle = unknown;    ///< where p_regu is largest on the perimeter; 0 downstream
  double largest_pressure = unknown;    ///< p_regu there
  double lowest_pressure = unknown;     ///< p_tot on the perimeter
  double lowest_angle = unknown;        ///< where that is
  double lowest_regularised = unknown;  ///< p_regu there, over λr
  double lambda_r = unknown;
  double stress_gap = unknown;  ///< largest |regularised - own normal stress| on the perimeter
  double layer = unknown;       ///< in D: from the side of the cylinder to 90% of the largest speed
  double extremes = unknown;    ///< of u_z on the axis behind the cylinder
  double static_decades = unknown,
         dynamic_decades = unknown;      ///< of the two parts of η in eq. (12)
  double largest_dynamic_at = unknown;   ///< z where the second is largest
  double lowest_viscosity = unknown;     ///< of all
  double lowest_viscosity_at = unknown;  ///< z of that
};
Wake wake_of(const twod::CylinderFlow& cylinder, const twod::CylinderFlow::State& state);

/// The paper's two loadings, 0.044 and 0.054, with one law.
struct Wakes {
  Wake creeping, flowing;
};

/// Figs 12 to 16: checks and verdicts. `coarse`: eq. (12) at λr = 1e-3.
void judge_drag(PaperPage& page, const DragCurve& own, const DragCurve& well_posed,
                const DragCurve& coarse);
void judge_coefficient(PaperPage& page, const DragCurve& own, const DragCurve& well_posed);
/// Of F = 0.054 with either law.
void judge_fields(PaperPage& page, const Wake& own, const Wake& well_posed);
void judge_close_up(PaperPage& page, const Wake& own, const Wake& well_posed);
void judge_perimeter(PaperPage& page, const Wakes& own, const Wakes& well_posed);
/// Of eq. (12).
void judge_viscosity(PaperPage& page, const Wakes& own);

}  // namespace talus::verification
