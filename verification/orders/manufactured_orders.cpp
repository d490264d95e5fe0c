// Velocity-pressure flow against manufactured solutions, in the plane and in space: a part of the
// orders study.
#include <cmath>

#include "verification/orders/mixed_orders.hpp"
#include "verification/orders/orders_parts.hpp"

namespace talus::verification {
namespace {

using mixed::FlowErrors;

constexpr double order_tolerance = 0.15;  // of an order

struct FlowNorm {
  std::string name;
  double FlowErrors::*error;
  double order;
};
const std::vector<FlowNorm> flow_norms = {{"u in L2", &FlowErrors::velocity, 3},
                                          {"grad u in L2", &FlowErrors::gradient, 2},
                                          {"p in L2", &FlowErrors::pressure, 2}};

const std::vector<std::string> header = {"flow",   "law", "inertia",    "meshes",    "u",
                                         "grad u", "p",   "error of u", "error of p"};

template <int Dim>
std::string label_of(const ManufacturedCase<Dim>& each, const MeshFamily<Dim>& family) {
  return (Dim == 3 ? "3D " : "") + each.exact.name + ", " + rheology::name_of(each.regularisation) +
         (each.inertia > 0 ? ", inertia, " : ", ") + family.name;
}

template <int Dim>
std::vector<std::string> row_of(const ManufacturedCase<Dim>& each, const MeshFamily<Dim>& family,
                                const MeasuredOrders& measured) {
  std::vector<std::string> row = {each.exact.name, rheology::name_of(each.regularisation),
                                  each.inertia > 0 ? "yes" : "no", family.name};
  for (const FlowNorm& norm : flow_norms)
    row.push_back(io::fixed(measured.order(norm.error, 9), 3));
  row.push_back(io::rounded(measured.errors.back().velocity, 3));
  row.push_back(io::rounded(measured.errors.back().pressure, 3));
  return row;
}

// A row of the table and a check for each norm.
template <int Dim>
MeasuredOrders check_orders(Chapter& chapter, io::Table& table, const ManufacturedCase<Dim>& each,
                            const MeshFamily<Dim>& family) {
  const MeasuredOrders measured = measure_orders(each, family);
  table.rows.push_back(row_of(each, family, measured));
  for (const FlowNorm& norm : flow_norms)
    chapter.check(Kind::manufactured, label_of(each, family) + ": order of " + norm.name,
                  measured.order(norm.error, family.sizes.size()), norm.order - order_tolerance,
                  norm.order + order_tolerance);
  return measured;
}

// Negative control: with the pressure mapped from the reference element its order must be lost.
template <int Dim>
MeasuredOrders check_mapped_pressure(Chapter& chapter, io::Table& table, ManufacturedCase<Dim> each,
                                     const MeshFamily<Dim>& family, double lowest, double highest) {
  each.pressure_basis = mixed::PressureBasis::mapped;
  const MeasuredOrders lost = measure_orders(each, family);
  auto row = row_of(each, family, lost);
  row[3] += ", mapped pressure";
  table.rows.push_back(row);
  chapter.check(Kind::control, label_of(each, family) + ", mapped pressure: order of p is lost",
                lost.order(&FlowErrors::pressure, family.sizes.size()), lowest, highest);
  return lost;
}

void add_curves(io::Figure& figure, std::size_t first_panel, const std::string& label,
                const MeasuredOrders& measured) {
  for (std::size_t i = 0; i < flow_norms.size(); ++i)
    figure.panels[first_panel + i].curves.push_back(
        {label, measured.h, measured.column(flow_norms[i].error)});
}

void add_guides(io::Figure& figure, std::size_t first_panel) {
  for (std::size_t i = 0; i < flow_norms.size(); ++i) {
    const io::Curve& first = figure.panels[first_panel + i].curves.front();
    io::Curve guide{"order " + io::rounded(flow_norms[i].order), first.x, {}, io::Style::slope};
    for (const double h : first.x)
      guide.y.push_back(0.4 * first.y.front() * std::pow(h / first.x.front(), flow_norms[i].order));
    figure.panels[first_panel + i].curves.push_back(guide);
  }
}

// A quick study has inertia under the paper's own law only, and the other laws and inertia on
// distorted meshes only.
bool is_measured(const Context& context, const rheology::Regularisation& law, double inertia,
                 const MeshFamily<2>& family) {
  const bool own_law = std::holds_alternative<rheology::ChauchatMedale>(law);
  const bool is_distorted = family.name == "distorted";
  return context.full || (own_law && inertia == 0) || (is_distorted && (own_law || inertia == 0));
}

// Not checked: what happens where the equations are ill-posed.
std::string errors_at_large_inertial_numbers(const MeshFamily<2>& family) {
  const ManufacturedCase<2> ill_posed{
      with_pressure_times(0.2, mixed::manufactured_flows<2>().front()), rheology::ChauchatMedale{}};
  std::string errors;
  for (const double error : measure_orders(ill_posed, family).column(&FlowErrors::velocity))
    errors += (errors.empty() ? "" : ", ") +
              (std::isnan(error) ? "no solution found" : io::rounded(error, 2));
  return errors;
}

// Every family of meshes under the paper's own law is drawn, and the distorted one under all.
void families_of_meshes(Chapter& chapter, const std::vector<MeshFamily<2>>& families,
                        const Context& context) {
  io::Table table{
      "Velocity-pressure flow: fitted orders (3, 2, 2) and errors on the finest mesh", header, {}};
  io::Figure figure{
      "orders_manufactured",
      "Errors of manufactured flows in the plane against element size, under eq. (12) unless a law "
      "is named. "
      "With the "
      "pressure mapped from the reference element the order of p should be lost where "
      "elements stay distorted, and with it that of u.",
      {},
      static_cast<int>(flow_norms.size())};
  for (const auto& exact : mixed::manufactured_flows<2>()) {
    const std::size_t first_panel = figure.panels.size();
    for (const FlowNorm& norm : flow_norms) {
      io::Panel panel{exact.name + ": " + norm.name,
                      "h, size of the elements over that of the domain",
                      "error, in the units of the flow",
                      true,
                      true,
                      {}};
      figure.panels.push_back(panel);
    }
    for (const auto& family : families)
      for (const auto& law : rheology::regularisations())
        for (const double inertia : {0.0, 1.0}) {
          if (!is_measured(context, law, inertia, family)) continue;
          const auto measured = check_orders<2>(chapter, table, {exact, law, inertia}, family);
          const bool own_law = std::holds_alternative<rheology::ChauchatMedale>(law);
          if (inertia == 0 && (own_law || family.name == "distorted"))
            add_curves(figure, first_panel,
                       own_law ? family.name : family.name + ", " + rheology::name_of(law),
                       measured);
        }
    const auto lost =
        check_mapped_pressure<2>(chapter, table, {exact, rheology::ChauchatMedale{}}, families[2],
                                 1 - order_tolerance, 1 + order_tolerance);
    add_curves(figure, first_panel, families[2].name + ", mapped pressure", lost);
    add_guides(figure, first_panel);
  }
  chapter.figure(std::move(figure));
  chapter.table(std::move(table));
}

}  // namespace

void plane_orders(Chapter& chapter, const Context& context) {
  std::vector<int> sizes = {8, 12, 18, 27};
  if (context.full) sizes.push_back(40);
  const auto families = mesh_families(sizes);
  families_of_meshes(chapter, families, context);
  answer_orders(chapter, "In the plane", Kind::manufactured);
  chapter.text(
      "Velocity and pressure are prescribed as smooth functions, and the body force that makes "
      "them a solution follows from automatic differentiation; one side carries the exact "
      "traction. Distorted meshes are distorted anew on every level, so that their elements do not "
      "tend to parallelograms; on the sector they do, and there even a mapped pressure would keep "
      "its order. The pressures keep I inside the well-posed band. Beyond it, under a fifth of the "
      "pressure (I up to 1.6), no order is asked for, since ill-posedness is no fault of the "
      "elements: there the errors of u in L2 on the stretched meshes are " +
      errors_at_large_inertial_numbers(families[1]) + ".");
}

// Distorted hexahedra, with inertia. A quick study has the finest mesh under the paper's own law
// only, and the other laws in one of the flows.
void space_orders(Chapter& chapter, const Context& context) {
  io::Table table{
      "The same in three dimensions, H27/P1: fitted orders, and errors on the finest mesh",
      header,
      {}};
  const auto& flows = mixed::manufactured_flows<3>();
  for (const auto& exact : flows)
    for (const auto& law : rheology::regularisations()) {
      const bool own_law = std::holds_alternative<rheology::ChauchatMedale>(law);
      const bool last_flow = &exact == &flows.back();
      if (!context.full && !own_law && !last_flow) continue;
      std::vector<int> sizes = {2, 4, 6};
      if (context.full || (own_law && last_flow)) sizes.push_back(8);
      if (context.full) sizes.push_back(12);
      check_orders<3>(chapter, table, {exact, law, 1}, brick_family(sizes));
    }
  check_mapped_pressure<3>(chapter, table, {flows.back(), rheology::ChauchatMedale{}, 1},
                           brick_family({2, 4, 6}), 0.5, 2 - 2 * order_tolerance);
  answer_orders(chapter, "In space", Kind::manufactured);
  chapter.table(std::move(table));
}

}  // namespace talus::verification
