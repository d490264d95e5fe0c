// The paper's Figs 13, 14 and 16: fields around the cylinder.
#include <cmath>

#include "verification/paper/paper_cylinder.hpp"

namespace talus::verification {
namespace {

using At = mixed::FlowPoint<2>;
using Value = std::function<double(const At&)>;

// Half of the box is solved: it is the right half of a picture, its mirror image the left one. A
// component of the velocity across the plane of symmetry changes its sign there.
struct Half {
  const twod::CylinderFlow& cylinder;
  const twod::CylinderFlow::State& state;
  bool is_mirrored = false;
};

bool touches(const io::FieldPatch& patch, const io::Window& window) {
  const io::Window box = io::box_of({&patch, 1});
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (box.high[axis] < window.low[axis] || box.low[axis] > window.high[axis]) return false;
  return true;
}

// Each element as a grid of points, from left to right and from below.
io::FieldPatch patch_of(const Half& half, std::size_t element, const Value& value) {
  constexpr int points = 5;
  io::FieldPatch patch{points, {}, {}};
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      const int column = half.is_mirrored ? points - 1 - i : i;
      const fem::Point<2> reference(2. * column / (points - 1) - 1, 2. * j / (points - 1) - 1);
      At at = half.cylinder.flow().point_at(half.state, element, reference);
      if (half.is_mirrored) {
        at.values.position[0] *= -1;
        at.values.velocity[0] *= -1;
      }
      patch.points.push_back({at.values.position[0], at.values.position[1]});
      patch.values.push_back(value(at));
    }
  return patch;
}

// A field with its symbol and unit, in a window.
io::Panel field_panel_of(const std::string& title, const std::vector<Half>& halves,
                         const io::Window& window, bool is_logarithmic, const Value& value) {
  io::FieldMap map;
  map.log_scale = is_logarithmic;
  map.window = window;
  for (const Half& half : halves)
    for (std::size_t e = 0; e < half.cylinder.space().element_count(); ++e) {
      io::FieldPatch patch = patch_of(half, e, value);
      if (touches(patch, window)) map.patches.push_back(std::move(patch));
    }
  io::Panel panel{title, "x / D", "z / D", false, false, {}};
  panel.field = std::move(map);
  return panel;
}

std::vector<Half> mirrored(const twod::CylinderFlow& cylinder,
                           const twod::CylinderFlow::State& left,
                           const twod::CylinderFlow::State& right) {
  return {{cylinder, left, true}, {cylinder, right, false}};
}

// The part of the viscosity in eq. (12) that stands for the yield stress.
double static_part(const At& at, const twod::CylinderFlow& cylinder) {
  return cylinder.scene().law.mu_s * at.law.regularised_pressure /
         std::hypot(at.law.shear_rate, cylinder.flow().rheology().lambda_r);
}

}  // namespace

io::Figure primary_variables(const LawFlows& law, double loading, const io::Window& window) {
  const auto& state = law.state_at(loading);
  if (state.size() == 0) return {};
  const auto halves = mirrored(*law.flows.cylinder, state, state);
  const std::string velocity = " / sqrt(p_ext / φρ)";
  return {"",
          "",
          {field_panel_of("regularised pressure p_regu / p_ext", halves, window, false,
                          [](const At& at) { return at.law.regularised_pressure; }),
           field_panel_of("downwards, -u_z" + velocity, halves, window, false,
                          [](const At& at) { return -at.values.velocity[1]; }),
           field_panel_of("across, u_x" + velocity, halves, window, false,
                          [](const At& at) { return at.values.velocity[0]; })},
          3};
}

io::Figure viscosities(const LawFlows& law, double left, double right, const io::Window& window) {
  const twod::CylinderFlow& cylinder = *law.flows.cylinder;
  const auto &slow = law.state_at(left), &fast = law.state_at(right);
  if (slow.size() == 0 || fast.size() == 0) return {};
  const auto halves = mirrored(cylinder, slow, fast);
  const std::string unit = " / (D sqrt(p_ext φρ))";
  io::Figure figure{"", "", {}, 3};
  if (rheology::has_yield_stress(cylinder.scene().regularisation)) {
    figure.panels.push_back(
        field_panel_of("static part η_s" + unit, halves, window, true,
                       [&](const At& at) { return static_part(at, cylinder); }));
    figure.panels.push_back(
        field_panel_of("dynamic part η_d" + unit, halves, window, true,
                       [&](const At& at) { return at.law.viscosity - static_part(at, cylinder); }));
  }
  figure.panels.push_back(field_panel_of("viscosity η" + unit, halves, window, true,
                                         [](const At& at) { return at.law.viscosity; }));
  return figure;
}

}  // namespace talus::verification
