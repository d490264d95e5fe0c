#include "common/program/grading.hpp"

#include <cmath>

#include "common/fem/line_mesh.hpp"
#include "common/io/result_folder.hpp"
#include "common/io/table.hpp"

namespace talus::program {

void check_grading(const std::string& option, double exponent, int elements) {
  const double largest = fem::largest_grading(elements);
  if (exponent <= largest) return;
  throw io::UserError(option + ": '" + io::rounded(exponent) + "' is outside 1 ... " +
                      io::fixed(std::floor(100 * largest) / 100, 2) + ", the allowed range with " +
                      std::to_string(elements) +
                      " elements: beyond, the narrowest is lost in rounding");
}

}  // namespace talus::program
