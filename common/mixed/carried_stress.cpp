// The stress that the primal-dual form of velocity-pressure flow carries beside the state.
#include <stdexcept>
#include <string>

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {

template <int Dim>
void MixedFlow<Dim>::carry_stress(const StressField& stress) {
  carries_stress_ = true;
  carried_.clear();
  if (!stress) return;
  carried_.resize(loads_.size());
  for (std::size_t b = 0; b < carried_.size(); ++b)
    for (std::size_t q = 0; q < carried_[b].size(); ++q)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto tau = stress(position_of(b, q, lane));
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j)
            carried_[b][q][i][j][lane] =
                tau(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
}

template <int Dim>
std::vector<double> MixedFlow<Dim>::carried_stress() const {
  std::vector<double> numbers;
  for (const CarriedStress<Dim>& batch : carried_)
    for (const PackTensor<Dim>& tau : batch)
      for (const auto& row : tau)
        for (const Pack& entry : row)
          for (std::size_t lane = 0; lane < lanes; ++lane) numbers.push_back(entry[lane]);
  return numbers;
}

template <int Dim>
void MixedFlow<Dim>::carry_stress(std::span<const double> numbers) {
  const std::size_t all = loads_.size() * Space::points_per_element * Dim * Dim * lanes;
  if (!numbers.empty() && numbers.size() != all)
    throw std::invalid_argument("a carried stress of " + std::to_string(numbers.size()) +
                                " numbers where there are " + std::to_string(all));
  carries_stress_ = true;
  carried_.assign(numbers.empty() ? 0 : loads_.size(), {});
  auto next = numbers.begin();
  for (CarriedStress<Dim>& batch : carried_)
    for (PackTensor<Dim>& tau : batch)
      for (auto& row : tau)
        for (Pack& entry : row)
          for (std::size_t lane = 0; lane < lanes; ++lane) entry[lane] = *next++;
}

template <int Dim>
void MixedFlow<Dim>::stop_carrying_stress() {
  carries_stress_ = false;
  carried_.clear();
}

// τ <- what the tangent predicts after the whole step, in equilibrium with the load.
template <int Dim>
void MixedFlow<Dim>::update_carried_stress(const State& step) {
  std::vector<CarriedStress<Dim>> next(loads_.size());
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
  carried_ = std::move(next);
}

// The class is instantiated in mixed_flow.cpp, which does not see what is defined here.
template void MixedFlow<2>::carry_stress(const StressField&);
template void MixedFlow<3>::carry_stress(const StressField&);
template std::vector<double> MixedFlow<2>::carried_stress() const;
template std::vector<double> MixedFlow<3>::carried_stress() const;
template void MixedFlow<2>::carry_stress(std::span<const double>);
template void MixedFlow<3>::carry_stress(std::span<const double>);
template void MixedFlow<2>::stop_carrying_stress();
template void MixedFlow<3>::stop_carrying_stress();
template void MixedFlow<2>::update_carried_stress(const State&);
template void MixedFlow<3>::update_carried_stress(const State&);

}  // namespace talus::mixed
