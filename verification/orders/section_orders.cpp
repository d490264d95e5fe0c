// The order of the heap's flow rate, from three meshes and no reference.
#include <cmath>

#include "twod/section.hpp"
#include "verification/harness/methods.hpp"
#include "verification/orders/orders_parts.hpp"

namespace talus::verification {

void section_orders(Chapter& chapter, const Context& context) {
  constexpr double lambda_r = 1e-6;
  const int coarsest = context.full ? 24 : 12;
  io::Table table{
      "Order of the flow rate of the heap's section at α = 0.42, from the differences "
      "between uniform meshes of " +
          std::to_string(coarsest) + ", " + std::to_string(2 * coarsest) + " and " +
          std::to_string(4 * coarsest) + " elements across",
      {"method", "no slip", "relaxed wall"},
      {}};
  std::vector<NamedMethod> methods = {reference_method()};
  for (const NamedMethod& method : newton_methods(lambda_r)) methods.push_back(method);
  for (const NamedMethod& method : methods) {
    shear::ShearOptions options = twod::default_options();
    options.method = method.options.method;
    options.regularisation = method.options.regularisation;
    options.lambda_r = lambda_r;
    table.rows.push_back({method.label});
    struct Bounds {
      twod::Wall wall;
      double lower, upper;
    };
    for (const Bounds& bounds :
         {Bounds{twod::Wall::no_slip, 0.9, 1.25}, Bounds{twod::Wall::friction, 1.25, 1.65}}) {
      twod::Section section;
      section.angle = 0.42;
      section.wall = bounds.wall;
      std::vector<double> rates;
      for (const int across : {coarsest, 2 * coarsest, 4 * coarsest}) {
        auto space = twod::space_of(section, {across, across * 3 / 2});
        const auto solution = twod::solve(section, space, options);
        rates.push_back(solve::is_success(solution.end) ? twod::flow_rate(solution, space)
                                                        : std::nan(""));
      }
      const double order = std::log2((rates[1] - rates[0]) / (rates[2] - rates[1]));
      const bool slips = bounds.wall == twod::Wall::friction;
      table.rows.back().push_back(io::fixed(order, 3));
      chapter.check(Kind::self_consistency,
                    "heap section, " + std::string(slips ? "relaxed wall" : "no slip") + ", " +
                        method.label + ": order of Q*",
                    order, bounds.lower, bounds.upper);
    }
  }
  chapter.text(
      "The heap's section has no exact solution; the order of its flow rate follows from three "
      "meshes. Without slip 1 is expected, because the flow slips at the top of the wall all the "
      "same, within the last element; with the relaxed wall more.");
  chapter.table(std::move(table));
}

}  // namespace talus::verification
