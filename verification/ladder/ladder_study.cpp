// The same scene in a poorer and a richer model: do they agree, what does the richer one cost, and
// which one does the scene need?
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/program/model_choice.hpp"
#include "common/solve/extremes.hpp"
#include "verification/harness/fit.hpp"
#include "verification/ladder/ladder.hpp"

namespace talus::verification {

double Rung::farthest() const {
  double farthest = 0;
  for (const RungCase& each : cases) {
    if (!each.solved()) return std::numeric_limits<double>::quiet_NaN();
    farthest =
        solve::nan_max({farthest, each.apart.velocity, each.apart.cross_flow, each.apart.pressure});
  }
  return farthest;
}

double Rung::times_cpu() const {
  double poor = 0, rich = 0;
  for (const RungCase& each : cases)
    if (each.same_start) {
      poor += each.poorer.seconds;
      rich += each.richer.seconds;
    }
  return rich / poor;
}

double Rung::times_memory() const {
  return largest().richer.factor_bytes / largest().poorer.factor_bytes;
}

const RungCase& Rung::largest() const {
  return *std::find_if(cases.rbegin(), cases.rend(),
                       [](const RungCase& each) { return each.same_start; });
}

namespace {

std::string both(const std::string& poorer, const std::string& richer) {
  return poorer + " / " + richer;
}

std::string unknowns(const ModelCost& cost) {
  return std::to_string(cost.unknowns) +
         (cost.condensed < cost.unknowns ? " (" + std::to_string(cost.condensed) + ")" : "");
}

std::string iterations(const ModelCost& cost) {
  return std::to_string(cost.iterations) + (cost.continued ? ", continued" : "") +
         (solve::is_success(cost.end) ? "" : ", " + solve::name_of(cost.end));
}

io::Table table_of(const Rung& rung) {
  io::Table table{"The " + rung.scene + ": " + rung.poorer + " / " + rung.richer,
                  {"case", "u apart", "cross-flow", "p apart", "unknowns (condensed)", "iterations",
                   "CPU ms", "factors, kB"},
                  {}};
  for (const RungCase& each : rung.cases)
    table.rows.push_back(
        {each.what, io::rounded(each.apart.velocity, 2), io::rounded(each.apart.cross_flow, 2),
         io::rounded(each.apart.pressure, 2), both(unknowns(each.poorer), unknowns(each.richer)),
         both(iterations(each.poorer), iterations(each.richer)),
         both(io::rounded(1e3 * each.poorer.seconds, 3), io::rounded(1e3 * each.richer.seconds, 3)),
         both(io::rounded(each.poorer.factor_bytes / 1e3, 3),
              io::rounded(each.richer.factor_bytes / 1e3, 3))});
  return table;
}

io::Table overview(const std::vector<Rung>& rungs) {
  io::Table table{"The rungs: agreement, and what the richer model took in terms of the poorer",
                  {"scene", "poorer", "richer", "cases", "agree to, digits", "unknowns, times",
                   "CPU time, times", "memory of factors, times"},
                  {}};
  for (const Rung& rung : rungs) {
    const RungCase& largest = rung.largest();
    table.rows.push_back({rung.scene, rung.poorer, rung.richer, std::to_string(rung.cases.size()),
                          std::to_string(program::digits(rung.farthest())),
                          io::rounded(static_cast<double>(largest.richer.unknowns) /
                                          static_cast<double>(largest.poorer.unknowns),
                                      2),
                          io::rounded(rung.times_cpu(), 2), io::rounded(rung.times_memory(), 2)});
  }
  return table;
}

// One sentence a scene; rungs of a scene follow each other, from its poorest model up.
void recommend(Chapter& chapter, const std::vector<Rung>& rungs) {
  for (std::size_t i = 0; i < rungs.size();) {
    std::vector<program::RicherModel> richer;
    const Rung& first = rungs[i];
    for (; i < rungs.size() && rungs[i].scene == first.scene; ++i)
      richer.push_back(
          {rungs[i].richer, rungs[i].farthest(), rungs[i].times_cpu(), rungs[i].times_memory()});
    chapter.text(program::recommendation(first.scene, first.poorer, richer));
  }
}

// CPU time and memory of the last case of each rung that both solve from the same start.
io::Figure costs(const std::vector<Rung>& rungs) {
  io::Panel time{"CPU time", "unknowns", "CPU seconds", true, true, {}};
  io::Panel memory{"Memory", "unknowns", "bytes of factors", true, true, {}};
  for (const Rung& rung : rungs) {
    const RungCase& largest = rung.largest();
    const auto add = [&](io::Panel& panel, double ModelCost::*cost) {
      const std::string label = rung.scene + ", " + rung.poorer + " to " + rung.richer;
      panel.curves.push_back({label,
                              {static_cast<double>(largest.poorer.unknowns),
                               static_cast<double>(largest.richer.unknowns)},
                              {largest.poorer.*cost, largest.richer.*cost}});
    };
    add(time, &ModelCost::seconds);
    add(memory, &ModelCost::factor_bytes);
  }
  return {"costs",
          "What a richer model of the same scene costs for the same answer: of each rung the last "
          "case of its table that both solve from the same start, poorer and richer.",
          {time, memory},
          2};
}

// How far richer models lie from the poorest of their scene, against what they cost.
void answer(Chapter& chapter, const std::vector<Rung>& rungs) {
  constexpr double needed = 1e-9;  // as program::recommendation asks for
  io::Panel panel{
      "", "CPU time, times that of the poorer model", "distance of flows, relative", true, true,
      {}};
  Range distances, times;
  std::size_t enough = 0;
  for (const Rung& rung : rungs) {
    panel.curves.push_back({rung.scene + ": " + rung.poorer + " to " + rung.richer,
                            {rung.times_cpu()},
                            {std::max(rung.farthest(), 1e-16)},
                            io::Style::points});
    distances.add(rung.farthest());
    times.add(rung.times_cpu());
    if (rung.farthest() < needed) ++enough;
  }
  panel.curves.push_back(
      {"nine digits", {1, 2 * times.upper()}, {needed, needed}, io::Style::dashed});
  std::string sentence = std::to_string(enough) + " of " + std::to_string(rungs.size()) +
                         " richer models give the flow of the poorer one to nine digits (at most " +
                         known(distances.upper(), 2) + " apart) for " + times.text(3) +
                         " times the CPU time";
  sentence += enough == rungs.size() ? ": no scene here needs more than its poorest model."
                                     : ": the others are needed.";
  chapter.answer(sentence);
  chapter.figure(
      {"models",
       "Largest distance (velocity, cross-flow, pressure) of a richer model's flow from that of "
       "the "
       "poorer one on the same elements, over all laws, λr and meshes of the tables below, against "
       "what the richer one takes. Below the line the poorer model will do.",
       {panel},
       1});
}

void check(Chapter& chapter, const Rung& rung) {
  int failed = 0;
  for (const RungCase& each : rung.cases)
    if (!each.solved()) ++failed;
  const std::string name = rung.scene + ", " + rung.poorer + " and " + rung.richer + ": ";
  chapter.check(Kind::self_consistency, name + "solves that failed", failed, 0, 0);
  chapter.check(Kind::other_method, name + "largest distance (velocity, cross-flow, pressure)",
                rung.farthest(), 0, rung.target);
}

}  // namespace

void ladder_study(Chapter& chapter, const Context& context) {
  // A scene's rungs from its poorest model up; a further scene is one more entry.
  const std::vector<std::function<std::vector<Rung>(const Context&)>> registry = {
      line_rungs, heap_rungs, cylinder_rungs};
  std::vector<Rung> rungs;
  for (const auto& rungs_of : registry) {
    for (Rung& rung : rungs_of(context)) rungs.push_back(std::move(rung));
    context.progress(static_cast<double>(rungs.size()) / 8);
  }
  for (const Rung& rung : rungs) check(chapter, rung);
  constexpr double force = 1e-8, target = 1e-10;
  chapter.check(Kind::control,
                "negative control: chute with one force larger by 1e-8, velocities apart",
                lines_apart_with_force_times(1 + force), 10 * target, 1e-6);
  chapter.check(Kind::control,
                "negative control: cylinder with one loading larger by 1e-7, velocities apart",
                cylinder_apart_with_force_times(1 + 10 * force), 20 * target, 1e-5);

  answer(chapter, rungs);
  recommend(chapter, rungs);
  chapter.table(overview(rungs));
  chapter.figure(costs(rungs));
  chapter.text(
      "A unidirectional flow solves the equations of velocity and pressure too, without dynamic "
      "pressure or cross-flow, and a plane flow those of space; on the same elements even the "
      "discrete solutions are the same. Line and plane share the law, the quadrature and Newton's "
      "method, but neither assembly nor linear system nor line search; plane and layer share the "
      "code, as a template over the dimension. Where “continued” stands, Newton's full steps "
      "failed "
      "from rest, and continuation in λr had to lead there. CPU time includes the set-up and all "
      "solves from nothing. A layer above yield starts from the plane's solution pushed off by "
      "1e-5, sideways too, and returns to it; its time is left out of the ratios.");
  for (const Rung& rung : rungs) chapter.table(table_of(rung));
}

}  // namespace talus::verification
