// Rungs of the ladder: the heap as its cross-section and in three dimensions.
#include "common/solve/stopwatch.hpp"
#include "threed/heap_solve.hpp"
#include "twod/section_nested.hpp"
#include "verification/ladder/ladder.hpp"

namespace talus::verification {
namespace {

// Both from nothing, on nested meshes.
RungCase climb(const threed::Heap& heap, const threed::HeapMesh& mesh) {
  const threed::HeapOptions options;
  RungCase rung{"angle " + io::rounded(heap.section.angle) + ", 1x" +
                    std::to_string(mesh.section.across) + "x" + std::to_string(mesh.section.up),
                {},
                {},
                {}};
  const solve::Stopwatch watch;
  auto space = twod::space_of(heap.section, mesh.section);
  const auto section =
      twod::solve_nested(heap.section, mesh.section, space, threed::section_options(heap, options));
  const Eigen::Index nodes = section.velocity.size();
  rung.poorer = {section.end,
                 section.iterations(),
                 false,
                 nodes,
                 nodes,
                 watch.seconds(),
                 sizeof(double) * space.factor_entries()};

  const auto solution = threed::solve(heap, mesh, options);
  const threed::MeshCost& finest = solution.meshes.back();
  rung.richer = {finest.end,
                 finest.iterations,
                 false,
                 finest.unknowns,
                 finest.condensed,
                 solution.middle.seconds,
                 sizeof(double) * finest.factor_entries};
  rung.apart = mixed::departure(solution.flow->space(), solution.state, section.velocity,
                                heap.section.height);
  return rung;
}

}  // namespace

std::vector<Rung> heap_rungs(const Context& context) {
  threed::Heap heap;
  Rung rung{.scene = "heap", .poorer = "its cross-section", .richer = "space", .cases = {}};
  for (const double angle : {0.38, 0.41}) {
    heap.section.angle = angle;
    for (const auto& mesh : context.full ? std::vector<twod::SectionMesh>{{35, 50}, {70, 100}}
                                         : std::vector<twod::SectionMesh>{{9, 13}, {14, 20}})
      rung.cases.push_back(climb(heap, {1, mesh}));
  }
  return {rung};
}

}  // namespace talus::verification
