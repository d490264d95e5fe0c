#include "common/mixed/prescribed_velocities.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace talus::mixed {
namespace {

// What one boundary says about one component of one node.
struct Statement {
  Eigen::Index index;
  double value;
  int precedence;
  const std::string* boundary;
};

template <int Dim>
std::string place(const fem::Mesh<Dim>& mesh, Eigen::Index index) {
  std::ostringstream text;
  text << "component " << index % Dim << " at ("
       << mesh.nodes[static_cast<std::size_t>(index / Dim)].transpose() << ")";
  return text.str();
}

template <int Dim>
std::vector<Statement> statements(const fem::Mesh<Dim>& mesh,
                                  const BoundaryConditions<Dim>& conditions) {
  std::vector<Statement> all;
  for (const auto& [name, condition] : conditions)
    for (const fem::Face& face : mesh.boundaries.at(name))
      for (const std::size_t local : fem::face_nodes<Dim>(face.side)) {
        const Eigen::Index node = mesh.elements[face.element][local];
        Eigen::Matrix<double, Dim, 1> velocity = Eigen::Matrix<double, Dim, 1>::Zero();
        if (condition.velocity)
          velocity = condition.velocity(mesh.nodes[static_cast<std::size_t>(node)]);
        for (int i = 0; i < Dim; ++i)
          if (condition.fixed[static_cast<std::size_t>(i)])
            all.push_back({Dim * node + i, velocity[i], condition.precedence, &name});
      }
  return all;
}

}  // namespace

template <int Dim>
std::map<Eigen::Index, double> prescribed_velocities(const fem::Mesh<Dim>& mesh,
                                                     const BoundaryConditions<Dim>& conditions) {
  std::vector<Statement> all = statements(mesh, conditions);
  double largest = 0;
  for (const Statement& each : all) {
    if (!std::isfinite(each.value))
      throw std::invalid_argument(
          "boundary '" + *each.boundary +
          "' prescribes a velocity that is not finite: " + place(mesh, each.index));
    largest = std::max(largest, std::abs(each.value));
  }
  // Two formulas for one value differ by their rounding.
  const double tolerance = 1e-12 * largest;
  std::ranges::stable_sort(all, std::ranges::greater{}, &Statement::precedence);
  std::map<Eigen::Index, Statement> first;
  std::map<Eigen::Index, double> velocities;
  for (const Statement& each : all) {
    const auto [held, is_first] = first.emplace(each.index, each);
    if (is_first) velocities.emplace(each.index, each.value);
    const Statement& other = held->second;
    if (std::abs(each.value - other.value) <= tolerance || each.precedence < other.precedence)
      continue;
    std::ostringstream reason;
    reason << "boundaries '" << *other.boundary << "' and '" << *each.boundary
           << "' prescribe different velocities, " << other.value << " and " << each.value << ", "
           << place(mesh, each.index) << ": give one of them a higher precedence";
    throw std::invalid_argument(reason.str());
  }
  return velocities;
}

template std::map<Eigen::Index, double> prescribed_velocities(const fem::Mesh<2>&,
                                                              const BoundaryConditions<2>&);
template std::map<Eigen::Index, double> prescribed_velocities(const fem::Mesh<3>&,
                                                              const BoundaryConditions<3>&);

}  // namespace talus::mixed
