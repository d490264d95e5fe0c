#include "common/mixed/mixed_space.hpp"

#include <bit>
#include <cstdint>
#include <stdexcept>

#include "common/fem/mesh_check.hpp"
#include "common/mixed/prescribed_velocities.hpp"

namespace talus::mixed {
namespace {

// Elements in classes without common nodes, greedily.
template <int Dim>
std::vector<std::vector<std::size_t>> colour(const fem::Mesh<Dim>& mesh) {
  std::vector<std::uint64_t> used(mesh.nodes.size(), 0);  // colours at each node
  std::vector<std::vector<std::size_t>> classes;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    std::uint64_t taken = 0;
    for (const Eigen::Index node : mesh.elements[e]) taken |= used[static_cast<std::size_t>(node)];
    const auto free = static_cast<std::size_t>(std::countr_one(taken));
    if (free >= 64) throw std::invalid_argument("a node belongs to too many elements");
    if (free >= classes.size()) classes.resize(free + 1);
    classes[free].push_back(e);
    for (const Eigen::Index node : mesh.elements[e])
      used[static_cast<std::size_t>(node)] |= std::uint64_t{1} << free;
  }
  return classes;
}

}  // namespace

template <int Dim>
MixedSpace<Dim>::MixedSpace(fem::Mesh<Dim> mesh, BoundaryConditions<Dim> conditions,
                            PressureBasis pressure_basis)
    : mesh_(fem::checked(std::move(mesh))),
      conditions_(std::move(conditions)),
      kind_(pressure_basis) {
  for (const auto& [name, faces] : mesh_.boundaries)
    if (!conditions_.contains(name))
      throw std::invalid_argument("boundary '" + name + "' has no condition");
  for (const auto& [name, condition] : conditions_)
    if (!mesh_.boundaries.contains(name))
      throw std::invalid_argument("the mesh has no boundary '" + name + "'");
  for (const auto& point : fem::gauss_rule<Dim>(3)) bases_.emplace_back(point.position);
  constrain();
  make_batches();
}

template <int Dim>
void MixedSpace<Dim>::constrain() {
  fixed_.assign(static_cast<std::size_t>(velocity_count()), false);
  for (const auto& [index, value] : prescribed_velocities(mesh_, conditions_)) {
    fixed_[static_cast<std::size_t>(index)] = true;
    if (value != 0) prescribed_.emplace_back(index, value);
  }
  traction_load_ = Eigen::VectorXd::Zero(velocity_count());
  for (const auto& [name, condition] : conditions_)
    for (const fem::Face& face : mesh_.boundaries.at(name)) {
      if (condition.open != Open::no) open_faces_.push_back({face, condition.open == Open::all});
      if (!condition.traction) continue;
      for (const auto& point : fem::face_rule(mesh_, face)) {
        const fem::ElementPoint<Dim> at(mesh_, face.element, point.reference);
        const Vector force = point.weight * condition.traction(at.position, point.normal);
        for (int a = 0; a < nodes_per_element; ++a)
          for (int i = 0; i < Dim; ++i)
            traction_load_[velocity_index(mesh_.elements[face.element][static_cast<std::size_t>(a)],
                                          i)] += at.values[a] * force[i];
      }
    }
  clear_fixed(traction_load_);
}

template <int Dim>
void MixedSpace<Dim>::make_batches() {
  const auto rule = fem::gauss_rule<Dim>(3);
  for (const auto& elements : colour(mesh_)) {
    for (std::size_t first = 0; first < elements.size(); first += lanes) {
      Batch& batch = batches_.emplace_back();
      batch.count = std::min(lanes, elements.size() - first);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t e = elements[first + std::min(lane, batch.count - 1)];
        batch.elements[lane] = e;
        for (std::size_t q = 0; q < rule.size(); ++q) {
          const fem::ElementPoint<Dim> at(mesh_, e, rule[q].position);
          const auto basis = pressure_basis(e, rule[q].position, at.position);
          BatchPoint& point = batch.points[q];
          point.weight[lane] = rule[q].weight * at.determinant;
          for (std::size_t d = 0; d < Dim; ++d) {
            const auto i = static_cast<Eigen::Index>(d);
            point.pressure_basis[d][lane] = basis[i + 1];
            point.position[d][lane] = at.position[i];
            for (std::size_t j = 0; j < Dim; ++j)
              point.inverse_jacobian[d][j][lane] =
                  at.inverse_jacobian(i, static_cast<Eigen::Index>(j));
          }
        }
      }
    }
    colour_ends_.push_back(batches_.size());
  }
}

template <int Dim>
void MixedSpace<Dim>::clear_fixed(Eigen::VectorXd& values) const {
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i]) values[static_cast<Eigen::Index>(i)] = 0;
}

template <int Dim>
typename MixedSpace<Dim>::State MixedSpace<Dim>::start(solve::Precision precision) const {
  State state(size(), precision);
  for (const auto& [index, value] : prescribed_) state.set(index, value);
  return state;
}

template <int Dim>
typename MixedSpace<Dim>::PressureValues MixedSpace<Dim>::pressure_basis(
    std::size_t element, const Vector& reference, const Vector& position) const {
  PressureValues basis;
  basis[0] = 1;
  if (kind_ == PressureBasis::mapped) {
    basis.template tail<Dim>() = reference;
  } else {
    // Divided by the size of the element, so that the coefficients are of one size.
    const auto& nodes = mesh_.elements[element];
    const auto node = [&](std::size_t a) -> const Vector& {
      return mesh_.nodes[static_cast<std::size_t>(nodes[a])];
    };
    const double size = 0.5 * (node(nodes_per_element - 1) - node(0)).norm();
    basis.template tail<Dim>() = (position - node(interior)) / size;
  }
  return basis;
}

template <int Dim>
typename MixedSpace<Dim>::Values MixedSpace<Dim>::values_at(const solve::CompensatedVector& state,
                                                            std::size_t element,
                                                            const Vector& reference) const {
  const fem::ElementPoint<Dim> at(mesh_, element, reference);
  const auto& nodes = mesh_.elements[element];
  Eigen::Matrix<double, Dim, nodes_per_element> relative;  // to the interior node
  Vector centre;
  for (int i = 0; i < Dim; ++i) {
    const Eigen::Index origin = velocity_index(nodes[interior], i);
    centre[i] = state.value()[origin];
    for (int a = 0; a < nodes_per_element; ++a)
      relative(i, a) = static_cast<double>(
          state.difference(velocity_index(nodes[static_cast<std::size_t>(a)], i), origin));
  }
  const auto basis = pressure_basis(element, reference, at.position);
  Values values{at.position, centre + relative * at.values, relative * at.gradients.transpose(), 0};
  for (int k = 0; k < pressures; ++k)
    values.pressure += basis[k] * state.value()[pressure_index(element, k)];
  return values;
}

template class MixedSpace<2>;
template class MixedSpace<3>;

}  // namespace talus::mixed
