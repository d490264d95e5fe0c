#include <algorithm>
#include <cmath>

#include "verification/fit.hpp"
#include "verification/study/kinds.hpp"

namespace talus::study {

Fit fitted(const std::vector<double>& sizes, const std::vector<double>& errors) {
  constexpr double falls = 2. / 3;
  constexpr std::size_t most = 4;
  std::vector<std::size_t> order(sizes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::vector<double> h, e;
  for (const std::size_t i : order) {
    if (!(errors[i] > 0) || (!e.empty() && !(errors[i] < falls * e.back()))) {
      if (e.size() > 2) break;
      h.clear(), e.clear();  // not yet on its way down
    }
    if (!(errors[i] > 0)) continue;
    h.push_back(sizes[i]);
    e.push_back(errors[i]);
  }
  const auto from = static_cast<std::ptrdiff_t>(h.size() > most ? h.size() - most : 0);
  h.erase(h.begin(), h.begin() + from);
  e.erase(e.begin(), e.begin() + from);
  Fit fit;
  fit.order = verification::fitted_order(h, e);
  fit.points = static_cast<int>(h.size());
  return fit;
}

Findings converge(Table& table) {
  std::vector<std::string> others;  // a curve is measured against its own finest mesh
  for (const Varied& each : table.varied)
    if (each.name != table.mesh_option()) others.push_back(each.name);
  Findings found;
  const auto errors = errors_to_show(table, others);
  io::Table orders{"orders of convergence", {"error", "curve", "order", "points"}, {}};
  io::Figure figure{"errors", "", {}, static_cast<int>(std::min<std::size_t>(errors.size(), 2))};
  for (const std::string& error : errors) {
    io::Panel panel{error, "size of the elements", table.label_of(error), true, true,
                    {},    std::nullopt,           "bottom right"};
    for (const Curve& curve : curves_of(table, {table.mesh_option()})) {
      io::Curve drawn{curve.label, {}, {}};
      for (const Row* row : curve.rows) {
        const double size = row->number("element_size"), value = row->number(error);
        if (!(size > 0) || !(value > 0)) continue;
        drawn.x.push_back(size);
        drawn.y.push_back(value);
      }
      Fit fit = fitted(drawn.x, drawn.y);
      fit.quantity = error;
      fit.curve = curve.label;
      if (std::isfinite(fit.order))
        drawn.label += (drawn.label.empty() ? "" : ": ") + ("order " + io::rounded(fit.order, 3));
      orders.rows.push_back({error, curve.label,
                             std::isfinite(fit.order) ? io::rounded(fit.order, 4) : "none",
                             std::to_string(fit.points)});
      found.fits.push_back(fit);
      panel.curves.push_back(drawn);
    }
    figure.panels.push_back(panel);
  }
  figure.caption =
      "Errors against the size of the elements. Orders are fitted over the last four "
      "meshes on which the error still falls.";
  found.chapter.figure(figure);
  found.chapter.table(orders);
  return found;
}

}  // namespace talus::study
