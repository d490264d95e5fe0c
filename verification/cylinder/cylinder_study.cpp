// The flow around the cylinder: what the numbers below yield owe to mesh and outlet.
#include <cmath>

#include "verification/cylinder/cylinder_parts.hpp"

namespace talus::verification {
namespace {

std::vector<std::string> row_of(const std::string& name, const Creep& creep) {
  const auto& m = creep.measures;
  return {name,
          std::to_string(creep.elements),
          io::rounded(m.mean_velocity, 6),
          io::rounded(m.drag, 6),
          io::rounded(m.drag_traction, 6),
          io::rounded(std::abs(m.imbalance()), 2),
          io::rounded(m.projected_divergence, 2),
          io::rounded(m.divergence, 2),
          std::to_string(creep.factorisations),
          io::rounded(creep.seconds, 3)};
}

const std::vector<std::string> header = {
    "case",      "elements", "U",     "drag (reactions)", "drag (traction)",
    "imbalance", "P div u",  "div u", "factorisations",   "CPU s"};

void halves(Chapter& chapter) {
  twod::Cylinder half = cylinder_around(16), full = half;
  full.mesh.full = true;
  const Creep a = creep_at(half, 0.03), b = creep_at(full, 0.03);
  judge_halves(chapter, a, b);
  chapter.table(
      {"Half and full domain at F = 0.03", header, {row_of("half", a), row_of("full", b)}});
}

void outlets(Chapter& chapter) {
  io::Table table{"Outlet condition and place at F = 0.044, 16 elements around", header, {}};
  twod::Cylinder scene = cylinder_around(16);
  std::vector<OutletPair> pairs;
  for (const double outlet : {15.0, 8.0, 5.0}) {
    scene.mesh.outlet = outlet;
    scene.open_outlet = mixed::Open::no;
    const Creep developed = creep_at(scene, 0.044);
    scene.open_outlet = mixed::Open::viscous;
    const Creep open = creep_at(scene, 0.044);
    table.rows.push_back(row_of("developed at " + io::rounded(outlet), developed));
    table.rows.push_back(row_of("open at " + io::rounded(outlet), open));
    pairs.push_back({outlet, developed, open});
  }
  scene.open_outlet = mixed::Open::all;
  scene.lambda_r = 0.1;
  const Creep all = creep_at(scene, 0.044);
  table.rows.push_back(row_of("open with its pressure, λr = 0.1", all));
  judge_outlets(chapter, pairs, all);
  chapter.table(std::move(table));
}

}  // namespace

void cylinder_meshes(Chapter& chapter, const Context& context) {
  io::Table table{
      "Creep at λr = 1e-6 on finer and finer meshes; div u relative to grad u, whole "
      "and as projected onto the pressures",
      header,
      {}};
  const std::vector<int> arounds = context.full ? std::vector{40, 80, 160} : std::vector{16, 24};
  std::vector<FinerMeshes> runs;
  for (const double loading : {0.01, 0.04}) {
    runs.push_back({loading, {}});
    for (const int around : arounds) {
      const Creep creep = creep_at(cylinder_around(around), loading);
      runs.back().creeps.push_back(creep);
      table.rows.push_back(
          row_of("F = " + io::rounded(loading) + ", " + std::to_string(around) + " around", creep));
    }
  }
  // On the paper's mesh another code gives the numbers; coarser meshes are compared with more room.
  judge_meshes(chapter, runs, context.full ? 0.01 : 0.03);
  chapter.table(std::move(table));
}

void cylinder_outlets(Chapter& chapter, const Context&) {
  halves(chapter);
  outlets(chapter);
}

}  // namespace talus::verification
