// The linear systems of velocity-pressure flow.
#include <limits>

#include "common/mixed/mixed_flow.hpp"
#include "common/solve/gmres.hpp"

namespace talus::mixed {
namespace {

constexpr double enough_of_a_step = 1e-3;       // may be left of it: Newton then gains three digits
constexpr double enough_by_old_factors = 1e-2;  // two a step, and more steps, are cheaper then

// What is left of a right side, of the equation of motion or of mass, whichever is worse. One that
// is zero from the start is no measure.
template <int Dim>
double share_left(const MixedSpace<Dim>& space, const Eigen::VectorXd& rest,
                  const Eigen::VectorXd& right_hand_side) {
  const Eigen::Index velocities = space.velocity_count(), pressures = rest.size() - velocities;
  const auto share = [](const auto& left, const auto& whole) {
    return whole.isZero(0) ? 0 : left.norm() / whole.norm();
  };
  return std::max(share(rest.head(velocities), right_hand_side.head(velocities)),
                  share(rest.tail(pressures), right_hand_side.tail(pressures)));
}

// With M the matrix last factored: M⁻¹J x = M⁻¹b by GMRES, which takes the penalty out as well.
template <int Dim>
solve::GmresSummary solve_preconditioned(const MixedFlow<Dim>& flow,
                                         const Eigen::VectorXd& right_hand_side, Eigen::VectorXd& x,
                                         const solve::GmresOptions& options) {
  Eigen::VectorXd first, scaled;
  x = Eigen::VectorXd::Zero(right_hand_side.size());
  if (!flow.system().solve(right_hand_side, first)) return {};
  // Velocities and pressures, whose units differ, are each measured by their first approximation.
  const Eigen::Index split = flow.space().velocity_count();
  Eigen::VectorXd units(first.size());
  const auto size = [](const auto& part) {
    return std::max(part.norm(), std::numeric_limits<double>::min());
  };
  units.head(split).setConstant(size(first.head(split)));
  units.tail(units.size() - split).setConstant(size(first.tail(units.size() - split)));
  const auto product = [&](const Eigen::VectorXd& direction) {
    Eigen::VectorXd result;
    flow.system().solve(
        flow.tangent_product(solve::CompensatedVector(direction.cwiseProduct(units).eval())),
        result);
    return result.cwiseQuotient(units).eval();
  };
  const auto summary = solve::gmres(product, first.cwiseQuotient(units), scaled, options);
  x = scaled.cwiseProduct(units);
  return summary;
}

// Where a wake of negative pressure leaves a few elements next to no viscosity and their neighbours
// have much, as many modes are left by each refinement, in the equation of mass above all. For
// GMRES they are an iteration each.
template <int Dim>
void take_out_slow_modes(const MixedFlow<Dim>& flow, const Eigen::VectorXd& right_hand_side,
                         const Eigen::VectorXd& left, solve::CompensatedVector& x) {
  constexpr int most_iterations = 20;
  const double before = share_left(flow.space(), left, right_hand_side);
  if (before <= enough_of_a_step) return;
  Eigen::VectorXd correction;
  solve_preconditioned(flow, left, correction, {enough_of_a_step, most_iterations});
  const auto trial = x.moved(1, solve::CompensatedVector(correction));
  const Eigen::VectorXd rest = right_hand_side - flow.tangent_product(trial);
  const double harmless = std::max(left.norm(), enough_of_a_step * right_hand_side.norm());
  if (share_left(flow.space(), rest, right_hand_side) < before && rest.norm() <= harmless)
    x = trial;
}

}  // namespace

template <int Dim>
bool MixedFlow<Dim>::linear_solve(const Eigen::VectorXd& right_hand_side, State& x) {
  if (!solve_linearised(right_hand_side, x)) return false;
  x.stress = is_primal_dual_ ? stress_after(x) : Stress();
  return true;
}

template <int Dim>
bool MixedFlow<Dim>::solve_linearised(const Eigen::VectorXd& right_hand_side,
                                      solve::CompensatedVector& x) {
  if (!is_factored_ && linear_solver_ == LinearSolver::lagged && iterate(right_hand_side, x))
    return true;
  if (!is_factored_ && !factor()) return false;
  // Refined while it helps: this also takes the penalty out of the step. The best of them counts.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr int most_refinements = 4;
  constexpr double worthwhile = 0.1;
  // A step may leave anything less than all of its right side: asked for a tenth, Newton stops in a
  // wake of negative pressure that it gets through otherwise (docs/cylinder.md, what ends a sweep).
  constexpr double useful = 1;
  constexpr double negligible = 1e-9;  // of it: among the roundings none is better than another
  const double size = right_hand_side.norm();
  Eigen::VectorXd correction, left;
  if (!system_.solve(right_hand_side, correction)) return false;
  solve::CompensatedVector trial(correction);
  double least = std::numeric_limits<double>::infinity();
  bool is_slow = false;
  for (int refinement = 0;; ++refinement) {
    const Eigen::VectorXd rest = right_hand_side - tangent_product(trial);
    const double norm = rest.norm(), last = least;
    is_slow = !(norm <= worthwhile * last);
    if (!(norm < last || norm <= negligible * size)) break;
    x = trial;
    left = rest;
    least = norm;
    if (is_slow || norm <= epsilon * size || refinement == most_refinements ||
        !system_.solve(rest, correction))
      break;
    trial = trial.moved(1, solve::CompensatedVector(correction));
  }
  if (!(least <= useful * size) || !x.value().allFinite()) return false;
  if (is_slow) take_out_slow_modes(*this, right_hand_side, left, x);
  return true;
}

template <int Dim>
bool MixedFlow<Dim>::factor() {
  system_.set_zero();
  space_.for_each_batch([&](std::size_t b) {
    BatchTangent<Dim> tangent;
    element_tangents(b, tangent_penalty(b), tangent);
    system_.add(b, tangent);
  });
  ++factorisations_;
  is_factored_ = system_.factor();
  lag_ = {};
  if (is_factored_) lag_.factored(system_.iterations_per_factorisation());
  return is_factored_;
}

template <int Dim>
void MixedFlow<Dim>::element_tangents(std::size_t b, const Pack& penalty,
                                      BatchTangent<Dim>& tangent) const {
  batch_tangent<Dim>(space_, space_.batches()[b], states_[b], carried_in(b), penalty, inertia_,
                     factors_, tangent);
  add_open_sides(b, tangent);
}

template <int Dim>
Eigen::SparseMatrix<double> MixedFlow<Dim>::tangent_matrix(TangentPenalty penalty) const {
  constexpr std::size_t velocities = BatchTangent<Dim>::velocities;
  constexpr std::size_t unknowns = velocities + BatchTangent<Dim>::pressures;
  std::vector<Eigen::Triplet<double>> entries;
  const auto is_fixed = [&](Eigen::Index i) {
    return i < space_.velocity_count() && space_.is_fixed(i);
  };
  for (std::size_t b = 0; b < space_.batches().size(); ++b) {
    BatchTangent<Dim> tangent;
    element_tangents(
        b, penalty == TangentPenalty::of_solves ? tangent_penalty(b) : Pack(residual_penalty()),
        tangent);
    const auto entry = [&](std::size_t i, std::size_t j) -> const Pack& {
      return i < velocities   ? j < velocities ? tangent.velocity_velocity[i][j]
                                               : tangent.velocity_pressure[i][j - velocities]
               : j < velocities ? tangent.pressure_velocity[i - velocities][j]
                              : tangent.pressure_pressure[i - velocities][j - velocities];
    };
    const auto& batch = space_.batches()[b];
    for (std::size_t lane = 0; lane < batch.count; ++lane) {
      const auto index = element_unknowns(space_, batch.elements[lane]);
      for (std::size_t i = 0; i < unknowns; ++i)
        for (std::size_t j = 0; j < unknowns; ++j)
          if (!is_fixed(index[i]) && !is_fixed(index[j]))
            entries.emplace_back(static_cast<int>(index[i]), static_cast<int>(index[j]),
                                 entry(i, j)[lane]);
    }
  }
  Eigen::SparseMatrix<double> matrix(space_.size(), space_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// With factors of an earlier state, while they are worth it.
template <int Dim>
bool MixedFlow<Dim>::iterate(const Eigen::VectorXd& right_hand_side, solve::CompensatedVector& x) {
  if (lag_.budget() == 0) return false;
  Eigen::VectorXd solution;
  const auto summary = solve_preconditioned(*this, right_hand_side, solution,
                                            {enough_by_old_factors, lag_.budget()});
  krylov_iterations_ += summary.iterations;
  if (!summary.converged) return false;
  lag_.iterated(summary.iterations);
  ++lagged_solves_;
  x = solve::CompensatedVector(solution);
  return x.value().allFinite();
}

// Over the element's viscosity, to which inertia adds |u|h: where the pressure is negative it is
// all there is.
template <int Dim>
Pack MixedFlow<Dim>::tangent_penalty(std::size_t batch) const {
  if (penalty_.kind == Penalty::plain) return penalty_.lambda_p;
  Pack viscosity = 0, speed = 0, volume = 0;
  for (std::size_t q = 0; q < Space::points_per_element; ++q) {
    const PointState<Dim>& at = states_[batch][q];
    Pack square = 0;
    for (const Pack& component : at.velocity) square += component * component;
    viscosity += at.viscosity;
    speed += std::experimental::sqrt(square);
    volume += space_.batches()[batch].points[q].weight;
  }
  const Pack size = Dim == 2 ? std::experimental::sqrt(volume) : std::experimental::cbrt(volume);
  Pack scale = viscosity + inertia_ * speed * size;
  where(!(scale > 0), scale) = 1;  // neither friction nor motion: nothing to measure it by
  return penalty_.lambda_p * Space::points_per_element / scale;
}

template <int Dim>
void MixedFlow<Dim>::add_open_sides(std::size_t number, BatchTangent<Dim>& tangent) const {
  const auto& batch = space_.batches()[number];
  for (const auto& face : space_.open_faces())
    for (std::size_t lane = 0; lane < batch.count; ++lane) {
      if (batch.elements[lane] != face.element) continue;
      const auto side = open_side(space_, rheology_, static_pressure_, evaluated_, face);
      for (std::size_t v = 0; v < OpenSide<Dim>::velocities; ++v) {
        const auto row = side.tangent.row(static_cast<Eigen::Index>(v));
        for (std::size_t c = 0; c < OpenSide<Dim>::unknowns; ++c) {
          Pack& entry = c < OpenSide<Dim>::velocities
                            ? tangent.velocity_velocity[v][c]
                            : tangent.velocity_pressure[v][c - OpenSide<Dim>::velocities];
          entry[lane] += row[static_cast<Eigen::Index>(c)];
        }
      }
    }
}

// The class is instantiated in mixed_flow.cpp, which does not see what is defined here.
template bool MixedFlow<2>::linear_solve(const Eigen::VectorXd&, State&);
template bool MixedFlow<2>::solve_linearised(const Eigen::VectorXd&, solve::CompensatedVector&);
template bool MixedFlow<3>::linear_solve(const Eigen::VectorXd&, State&);
template bool MixedFlow<3>::solve_linearised(const Eigen::VectorXd&, solve::CompensatedVector&);
template Eigen::SparseMatrix<double> MixedFlow<2>::tangent_matrix(TangentPenalty) const;
template Eigen::SparseMatrix<double> MixedFlow<3>::tangent_matrix(TangentPenalty) const;
template void MixedFlow<2>::element_tangents(std::size_t, const Pack&, BatchTangent<2>&) const;
template void MixedFlow<3>::element_tangents(std::size_t, const Pack&, BatchTangent<3>&) const;
template bool MixedFlow<2>::factor();
template bool MixedFlow<3>::factor();
template bool MixedFlow<2>::iterate(const Eigen::VectorXd&, solve::CompensatedVector&);
template bool MixedFlow<3>::iterate(const Eigen::VectorXd&, solve::CompensatedVector&);
template Pack MixedFlow<2>::tangent_penalty(std::size_t) const;
template Pack MixedFlow<3>::tangent_penalty(std::size_t) const;
template void MixedFlow<2>::add_open_sides(std::size_t, BatchTangent<2>&) const;
template void MixedFlow<3>::add_open_sides(std::size_t, BatchTangent<3>&) const;

}  // namespace talus::mixed
