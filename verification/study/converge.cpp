#include <algorithm>
#include <cmath>

#include "verification/harness/fit.hpp"
#include "verification/study/kinds.hpp"

namespace talus::study {

Fit fitted(const std::vector<double>& sizes, const std::vector<double>& errors) {
  constexpr double alike = 0.15;
  constexpr std::size_t most = 4;
  std::vector<std::pair<double, double>> points;  // the finest first
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (sizes[i] > 0 && errors[i] > 0) points.emplace_back(sizes[i], errors[i]);
  std::ranges::sort(points);
  std::vector<double> orders;  // from each to the next coarser
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    orders.push_back(std::log(points[i + 1].second / points[i].second) /
                     std::log(points[i + 1].first / points[i].first));
  const auto are_alike = [&](std::size_t i) {
    return orders[i] > 0 && orders[i + 1] > 0 &&
           std::abs(orders[i] - orders[i + 1]) <= alike * std::max(orders[i], orders[i + 1]);
  };
  std::size_t first = 0, count = points.size();
  for (std::size_t i = 0; i + 1 < orders.size(); ++i)
    if (are_alike(i)) {
      first = i;
      count = 3;
      while (count < most && i + count - 1 < orders.size() && are_alike(i + count - 2)) ++count;
      break;
    }
  std::vector<double> h, e;
  for (std::size_t i = first; i < first + count; ++i) {
    h.push_back(points[i].first);
    e.push_back(points[i].second);
  }
  Fit fit;
  fit.order = verification::fitted_order(h, e);
  fit.points = static_cast<int>(h.size());
  return fit;
}

namespace {

// Every mesh with its errors, each followed by the order against the mesh before it.
io::Table mesh_by_mesh(const Table& table, const std::vector<Curve>& curves,
                       const std::vector<std::string>& errors) {
  io::Table meshes{"mesh by mesh", {"curve", table.mesh_option().substr(2)}, {}};
  for (const std::string& error : errors) {
    meshes.header.push_back(error);
    meshes.header.emplace_back("order");
  }
  for (const Curve& curve : curves) {
    const Row* before = nullptr;
    for (const Row* row : curve.rows) {
      auto& cells = meshes.rows.emplace_back();
      cells = {curve.label, row->option(table.mesh_option())};
      for (const std::string& error : errors) {
        const double value = row->number(error);
        const double order =
            before ? std::log(before->number(error) / value) /
                         std::log(before->number("element_size") / row->number("element_size"))
                   : NAN;
        cells.push_back(row->is_success() ? io::rounded(value, 3) : row->status());
        cells.push_back(std::isfinite(order) ? io::fixed(order, 2) : "");
      }
      before = row;
    }
  }
  return meshes;
}

// A triangle of the highest order in the panel, below the curve that has it.
io::Curve slope_of(const io::Curve& curve, double order) {
  const auto [finest, coarsest] = std::ranges::minmax_element(curve.x);
  const double error = 0.4 * curve.y[static_cast<std::size_t>(coarsest - curve.x.begin())];
  return {"order " + io::rounded(order, 3),
          {*coarsest, *finest},
          {error, error * std::pow(*finest / *coarsest, order)},
          io::Style::slope};
}

}  // namespace

Findings converge(Table& table) {
  std::vector<std::string> others;  // a curve is measured against its own finest mesh
  for (const Varied& each : table.varied)
    if (each.name != table.mesh_option()) others.push_back(each.name);
  Findings found;
  const auto errors = errors_to_show(table, others);
  const auto curves = curves_of(table, {table.mesh_option()});
  io::Table orders{"orders of convergence", {"error", "curve", "order", "points"}, {}};
  io::Figure figure{"errors", "", {}, static_cast<int>(std::min<std::size_t>(errors.size(), 2))};
  for (const std::string& error : errors) {
    io::Panel panel{table.title_of(error),
                    "size of the elements, in units of length",
                    table.unit_of(error),
                    true,
                    true,
                    {}};
    std::pair<double, io::Curve> steepest{0, {}};
    for (const Curve& curve : curves) {
      io::Curve drawn{curve.label, {}, {}};
      for (const Row* row : curve.rows) {
        const double size = row->number("element_size"), value = row->number(error);
        if (!(size > 0) || !(value > 0)) continue;
        drawn.x.push_back(size);
        drawn.y.push_back(value);
        drawn.commands.push_back(row->record.at("command"));
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
      if (fit.order > steepest.first) steepest = {fit.order, slope_of(drawn, fit.order)};
      panel.curves.push_back(drawn);
    }
    if (steepest.first > 0) panel.curves.push_back(steepest.second);
    figure.panels.push_back(panel);
  }
  figure.caption = "Errors of " + table.program.name() +
                   " against the size of the elements. Orders are fitted over the last four "
                   "meshes on which the error still falls.";
  found.chapter.figure(figure);
  found.chapter.table(orders);
  found.chapter.table(mesh_by_mesh(table, curves, errors));
  return found;
}

}  // namespace talus::study
