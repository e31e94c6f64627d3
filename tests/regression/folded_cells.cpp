// SPDX-License-Identifier: BSD-2-Clause
// A disc with a collar so thin that quadratic tetrahedra on its curved surface fold: it runs with a
// few of them, or the error says how it can be made to.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/harness/program.hpp"

namespace squeal::test {
namespace {

/// The geometry in mm, of a collar with this thickness on a radius of 40 mm. Edges of 9 mm bulge by
/// 9² / (8 · 40) = 0.25 mm between their ends.
Options discWithCollar(const std::string& thickness) {
  const fs::path file = placeFor("folded") / "collar.geo";
  writeText(file, R"(
SetFactory("OpenCASCADE");
DefineConstant[t = {1, Name "t"}];
Cylinder(1) = {0, 0, 0, 0, 0, 10, 100};
Cylinder(2) = {0, 0, -1, 0, 0, 12, 30};
Cylinder(3) = {0, 0, 10, 0, 0, 25, 40 + t};
Cylinder(4) = {0, 0, -1, 0, 0, 40, 40};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
BooleanDifference{ Volume{3}; Delete; }{ Volume{4}; Delete; }
BooleanUnion{ Volume{1}; Delete; }{ Volume{3}; Delete; }
Physical Volume("disc") = {Volume{:}};
lower() = Surface In BoundingBox{-101, -101, -0.1, 101, 101, 0.1};
Physical Surface("lower") = {lower()};
Mesh.MeshSizeMin = 9;
Mesh.MeshSizeMax = 9;
Mesh.ElementOrder = 2;
)");
  return {{"mesh_file", file.string()},
          {"mesh_set", "t=" + thickness},
          {"mesh_scale", "0.001"},
          {"material_disc_young", "2.1e11"},
          {"material_disc_poisson", "0.3"},
          {"material_disc_density", "7850"},
          {"constraint_lower_clamped", "xyz"},
          {"modes_count", "6"},
          {"report_fields", "off"}};
}

nlohmann::json summaryOf(const ProgramRun& run) {
  return nlohmann::json::parse(contentOf(run.folder / "summary.json"));
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Folded at the points of the mass, not at those of the stiffness. Straight edges of a few cells of
// the collar change its modes little.
TEST(FoldedCells, AFewAreTold) {
  const Options options = discWithCollar("0.8");
  const ProgramRun as = runProgram("folded/as", 2, commandLine(options));
  ASSERT_EQ(as.exitCode, 0) << as.error;
  EXPECT_TRUE(holds(as.error, "curved cells have a Jacobian that is not positive near an edge"))
      << as.error;
  EXPECT_TRUE(holds(as.error, "-mesh_straighten bad")) << as.error;
  EXPECT_FALSE(summaryOf(as).contains("straightened"));
  const ProgramRun run =
      runProgram("folded/straight", 2, commandLine(with(options, {{"mesh_straighten", "bad"}})));
  ASSERT_EQ(run.exitCode, 0) << run.error;
  EXPECT_FALSE(holds(run.error, "curved cell")) << run.error;
  EXPECT_TRUE(holds(run.out, "; -mesh_straighten: ")) << run.out;
  const auto done = summaryOf(run).at("straightened");
  EXPECT_GE(done.at("folded_cells"), 1);
  EXPECT_GE(done.at("nodes"), done.at("folded_cells"));
  EXPECT_LT(done.at("cells"), 100);  // of some thousand
  EXPECT_GT(done.at("largest_move_m"), 0.1e-3);
  EXPECT_LT(done.at("largest_move_m"), 0.5e-3);  // the bulge, on edges up to 1.3 times as long
  const auto before = readCsv(as.folder / "modes.csv").column("frequency_hz"),
             after = readCsv(run.folder / "modes.csv").column("frequency_hz");
  ASSERT_EQ(before.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(after[i], before[i], 0.01 * before[i]);
}

// Folded at the points of the stiffness as well: an error that counts them, unless they are
// straightened.
TEST(FoldedCells, TheErrorSaysWhatHelps) {
  const Options options = discWithCollar("0.5");
  const ProgramRun as = runProgram("folded/error", 2, commandLine(options));
  EXPECT_EQ(as.exitCode, 1);
  EXPECT_TRUE(holds(as.error, "inverted elements: ")) << as.error;
  EXPECT_TRUE(holds(as.error, "-mesh_straighten bad straightens")) << as.error;
  for (const char* which : {"bad", "all"}) {
    const ProgramRun run =
        runProgram("folded/helped", 1, commandLine(with(options, {{"mesh_straighten", which}})));
    EXPECT_EQ(run.exitCode, 0) << which << run.error;
  }
}

}  // namespace
}  // namespace squeal::test
