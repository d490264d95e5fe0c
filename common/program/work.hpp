// What a solve will take, estimated and announced before it begins.
#pragma once

#include <array>
#include <functional>
#include <string>

namespace talus::program {

struct Work {
  double bytes = 0;    ///< largest memory of the process
  double seconds = 0;  ///< CPU time

  Work& operator+=(const Work& other) {
    bytes += other.bytes;
    seconds += other.seconds;
    return *this;
  }
};

/// Unidirectional flow on a cross-section of so many elements, by so many factorisations. The
/// interior point keeps more at a point.
Work section_work(const std::array<int, 2>& elements, bool is_interior_point, int factorisations);

/// Velocity-pressure flow on a box of so many elements along its axes, the last 0 in the plane.
Work mixed_work(const std::array<int, 3>& elements, double unknowns_per_node, int factorisations);

/// The value of an option and the work it leads to.
struct Task {
  std::string value;
  Work work;
};

/// Lets a task begin or refuses it. `at_share` gives the task at a share in (0, 1] of its size in
/// every direction: 1 is what was asked for. Throws io::UserError with the estimate, what there is
/// and the largest size that would fit, if it does not; announces on stderr, in the name of the
/// program, what takes more than half of the memory or an hour.
void admit(const std::string& program, const std::string& option,
           const std::function<Task(double share)>& at_share);

}  // namespace talus::program
