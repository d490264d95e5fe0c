// The stress that the primal-dual form of velocity-pressure flow carries beside the state.
#include <stdexcept>
#include <string>

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {
namespace {

template <class Stress, class Body>
void for_each_entry(Stress& stress, const Body& body) {
  for (auto& batch : stress)
    for (auto& tau : batch)
      for (auto& row : tau)
        for (auto& entry : row) body(entry);
}

}  // namespace

template <int Dim>
auto MixedFlow<Dim>::stress_of(const StressField& field) const -> Stress {
  Stress stress(loads_.size());
  for (std::size_t b = 0; b < stress.size(); ++b)
    for (std::size_t q = 0; q < stress[b].size(); ++q)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto tau = field(position_of(b, q, lane));
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j)
            stress[b][q][i][j][lane] =
                tau(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
  return stress;
}

template <int Dim>
auto MixedFlow<Dim>::stress_of(std::span<const double> numbers) const -> Stress {
  Stress stress(numbers.empty() ? 0 : loads_.size());
  const std::size_t all = stress.size() * sizeof(CarriedStress<Dim>) / sizeof(double);
  if (numbers.size() != all)
    throw std::invalid_argument("a carried stress of " + std::to_string(numbers.size()) +
                                " numbers where there are " + std::to_string(all));
  auto next = numbers.begin();
  for_each_entry(stress, [&](Pack& entry) {
    for (std::size_t lane = 0; lane < lanes; ++lane) entry[lane] = *next++;
  });
  return stress;
}

template <int Dim>
std::vector<double> numbers_of(const std::vector<CarriedStress<Dim>>& stress) {
  std::vector<double> numbers;
  for_each_entry(stress, [&](const Pack& entry) {
    for (std::size_t lane = 0; lane < lanes; ++lane) numbers.push_back(entry[lane]);
  });
  return numbers;
}

// What the tangent predicts after the whole step, in equilibrium with the load.
template <int Dim>
auto MixedFlow<Dim>::stress_after(const solve::CompensatedVector& step) const -> Stress {
  Stress next(loads_.size());
  space_.for_each_batch([&](std::size_t b) {
    const auto& batch = space_.batches()[b];
    const BatchState<Dim> local(space_, batch, step);
    const CarriedStress<Dim>* carried = carried_in(b);
    for (std::size_t q = 0; q < batch.points.size(); ++q) {
      const PointState<Dim>& at = states_[b][q];
      PackGradients<Dim> gradients;
      physical_gradients<Dim>(batch.points[q], space_.bases()[q], gradients);
      const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
      const PackTensor<Dim> change =
          stress_change<Dim>(at, carried ? &(*carried)[q] : nullptr, local.gradient(gradients),
                             local.pressure_at(batch.points[q]), factors_);
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j)
          next[b][q][i][j] = at.viscosity * gamma[i][j] + change[i][j];
    }
  });
  return next;
}

#define TALUS_FOR(Dim)                                                                       \
  template auto MixedFlow<Dim>::stress_of(const StressField&) const->Stress;                 \
  template auto MixedFlow<Dim>::stress_of(std::span<const double>) const->Stress;            \
  template auto MixedFlow<Dim>::stress_after(const solve::CompensatedVector&) const->Stress; \
  template std::vector<double> numbers_of<Dim>(const std::vector<CarriedStress<Dim>>&);
// The class is instantiated in mixed_flow.cpp, which does not see what is defined here.
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR

}  // namespace talus::mixed
