#include "common/fem/mesh_check.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "common/fem/geometry.hpp"

namespace talus::fem {
namespace {

constexpr double rounding = 1e-12;  // of det dx/dξ, over the product of its columns' lengths

[[noreturn]] void refuse(std::size_t element, const std::string& reason) {
  throw std::invalid_argument("element " + std::to_string(element) + " " + reason);
}

std::string kind_of(double determinant) {
  if (!std::isfinite(determinant)) return "has nodes that are not finite";
  return determinant < 0 ? "is turned inside out or folds over" : "has no extent";
}

}  // namespace

template <int Dim>
Mesh<Dim> checked(Mesh<Dim> mesh) {
  std::vector<fem::QuadraticBasis<Dim>> bases;
  for (const auto& point : gauss_rule<Dim>(3)) bases.emplace_back(point.position);
  Eigen::Matrix<double, Dim, Mesh<Dim>::nodes_per_element> nodes;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (std::size_t a = 0; a < mesh.elements[e].size(); ++a) {
      const Eigen::Index node = mesh.elements[e][a];
      if (node < 0 || node >= std::ssize(mesh.nodes))
        refuse(e, "has node " + std::to_string(node) + ", which does not exist");
      nodes.col(static_cast<Eigen::Index>(a)) = mesh.nodes[static_cast<std::size_t>(node)];
    }
    for (const auto& basis : bases) {
      const Eigen::Matrix<double, Dim, Dim> jacobian = nodes * basis.gradients.transpose();
      const double determinant = jacobian.determinant();
      if (determinant > rounding * jacobian.colwise().norm().prod()) continue;  // NaN is not
      std::ostringstream reason;
      reason << kind_of(determinant) << ": det dx/dξ = " << determinant << " at ("
             << (nodes * basis.values).transpose() << ")";
      refuse(e, reason.str());
    }
  }
  return mesh;
}

template Mesh<1> checked(Mesh<1>);
template Mesh<2> checked(Mesh<2>);
template Mesh<3> checked(Mesh<3>);

}  // namespace talus::fem
