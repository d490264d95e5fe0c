#include "common/program/work.hpp"

#include <iostream>

#include "common/io/result_folder.hpp"
#include "common/io/table.hpp"
#include "common/solve/memory.hpp"
#include "common/solve/nested_dissection.hpp"

namespace talus::program {
namespace {

// Measured (docs/architecture.md, "How much a solve takes"): the process alone, what it holds for
// an element and for an entry of the factors, seconds of an element and operations a second of a
// factorisation.
constexpr double process = 15e6;
struct Rates {
  double bytes_of_element, bytes_of_entry, seconds_of_element, operations_a_second;
};
constexpr Rates newton_section{7.2e3, 12, 6e-6, 5e9};
constexpr Rates interior_point_section{9.2e3, 12, 6e-6, 5e9};
constexpr Rates mixed_plane{7e3, 18, 3e-5, 6e9};
constexpr Rates mixed_space{6e4, 18, 1.7e-4, 1.2e10};

Work work_of(const Rates& rates, double elements, const solve::FactorSize& factors,
             int factorisations) {
  return {process + rates.bytes_of_element * elements + rates.bytes_of_entry * factors.entries,
          factorisations * (rates.seconds_of_element * elements +
                            factors.operations / rates.operations_a_second)};
}

std::string duration(double seconds) {
  if (seconds < 90) return io::rounded(seconds, 2) + " s";
  if (seconds < 90 * 60) return io::rounded(seconds / 60, 2) + " minutes";
  return io::rounded(seconds / 3600, 2) + " hours";
}

// The largest task of this shape that fits into so many bytes.
std::string largest_that_fits(const std::function<Task(double)>& at_share, double bytes) {
  double fits = 0, too_large = 1;
  while (too_large - fits > 1e-4) {
    const double share = (fits + too_large) / 2;
    (at_share(share).work.bytes <= bytes ? fits : too_large) = share;
  }
  const Task largest = at_share(fits > 0 ? fits : 1e-4);
  return largest.work.bytes <= bytes ? largest.value + " would fit" : "nothing of this kind fits";
}

}  // namespace

Work section_work(const std::array<int, 2>& elements, bool is_interior_point, int factorisations) {
  return work_of(is_interior_point ? interior_point_section : newton_section,
                 1. * elements[0] * elements[1],
                 solve::nested_dissection({elements[0], elements[1], 0}, 1), factorisations);
}

Work mixed_work(const std::array<int, 3>& elements, double unknowns_per_node, int factorisations) {
  solve::FactorSize factors = solve::nested_dissection(elements, unknowns_per_node);
  factors.entries *= 2;  // L and U
  factors.operations *= 2;
  const bool is_plane = elements[2] == 0;
  return work_of(is_plane ? mixed_plane : mixed_space,
                 1. * elements[0] * elements[1] * (is_plane ? 1 : elements[2]), factors,
                 factorisations);
}

void admit(const std::string& program, const std::string& option,
           const std::function<Task(double share)>& at_share) {
  constexpr double large = 0.5, hour = 3600;
  // Of what there is, so that what is said to fit does: under `ulimit -v` address space counts that
  // allocators and BLAS reserve but never touch, 0.44 GB beyond the 0.78 GB of the heap on 239x293.
  constexpr double comfortable = 0.5;
  const auto [value, work] = at_share(1);
  const double available = solve::available_memory();
  const std::string asked = option + ": '" + value + "'", memory = solve::in_gigabytes(work.bytes),
                    there = solve::in_gigabytes(available);
  if (!(work.bytes <= available))
    throw io::UserError(asked + " needs about " + memory + " of memory, " + there +
                        " are available; " + largest_that_fits(at_share, comfortable * available));
  if (work.bytes > large * available || work.seconds > hour)
    std::cerr << program << ": " << asked << " will take about " << memory << " of memory ("
              << there << " are available) and " << duration(work.seconds) << '\n';
}

}  // namespace talus::program
