// SPDX-License-Identifier: BSD-2-Clause
// The elastic modes of bodies by themselves, their names, and the names that they give to modes of
// the whole model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "exact/beam.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

namespace beam = exact::beam;

constexpr beam::Section flatwise{1, 0.03, 0.01}, edgewise{1, 0.01, 0.03};
constexpr double poisson = 0.3;

const std::string steel = material("beam", "2.1e11", "0.3", "7850");
const std::string bar =
    "-mesh_file meshes/beam.geo -mesh_set order=2,nx=48,ny=4,nz=2,Ly=0.03,Lz=0.01" + steel;

using NamedModes = std::vector<energies::NamedMode>;

/// Returns the angular frequencies of the modes with a name.
std::vector<double> frequenciesOf(const NamedModes& modes, const std::string& name) {
  std::vector<double> found;
  for (const auto& one : modes)
    if (one.motion.name == name) found.push_back(one.angularFrequency);
  return found;
}

void expectMode(const NamedModes& modes, const std::string& name, double exact, double tolerance) {
  const auto found = frequenciesOf(modes, name);
  ASSERT_EQ(found.size(), 1u) << name;
  print("%s: %.3f Hz, %.2e from the theory\n", name.c_str(), found[0] / (2 * M_PI),
        found[0] / exact - 1);
  EXPECT_NEAR(found[0] / exact, 1, tolerance) << name;
}

// Soft springs hold the bar in the model, and the modes of the whole are those of the bar by
// itself: their frequencies differ by k/(2 m ω²) = 2e-5 at most. Against beam theory, the mesh
// adds up to 1.3e-3 to the fourth bending mode (8e-3 with half as many cells along the bar), and
// its two cells across half the section 3e-3 to torsion (1.4e-2 with one).
TEST(OwnModes, OfABarAreThoseOfBeamTheory) {
  const analysis::Analysis analysis =
      runOptions(bar +
                 " -ground_bottom_stiffness 10,10,10 -modes_count 20 -report_component_modes 9 "
                 "-flutter_friction 0 -flutter_band 3000");
  const auto& modes = analysis.flutter.ownModes.at(0);
  ASSERT_EQ(modes.size(), 9u);
  const auto flat = beam::freeBending(flatwise, poisson, 4);
  for (int n = 1; n <= 4; ++n) expectMode(modes, formatted("bending %d", n), flat[n - 1], 2e-3);
  const auto edge = beam::freeBending(edgewise, poisson, 2);
  for (int n = 1; n <= 2; ++n)
    expectMode(modes, formatted("in-plane bending %d", n), edge[n - 1], 1e-3);
  expectMode(modes, "torsion 1", 2 * beam::torsion(flatwise, poisson), 4e-3);

  const auto& segment = analysis.flutter.segments.at(0);
  ASSERT_GE(segment.components.size(), 6 + 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    const auto& components = segment.components[6 + i];
    EXPECT_EQ(pencil::modeName(components), "beam " + modes[i].motion.name);
    EXPECT_NEAR(components[0].motionShare, 1, 1e-6);
    EXPECT_NEAR(segment.modes.angularFrequency[6 + i] / modes[i].angularFrequency, 1, 3e-5);
  }
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(pencil::modeName(segment.components[i]).starts_with("beam rigid"));
}

/// Two equal bars of square section in one body.
const char* const twoBars = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.04, 0.04};
Box(2) = {0, 0, 0.1, 1, 0.04, 0.04};
Physical Volume("beam") = {1, 2};
Physical Surface("bottom") = Surface In BoundingBox{-1, -1, -1e-6, 2, 1, 1e-6};
Physical Surface("top") = Surface In BoundingBox{-1, -1, 0.13, 2, 1, 0.15};
MeshSize{:} = 0.04;
Mesh.ElementOrder = 2;
)";

// A body in two pieces has twelve rigid motions, none of which is listed, and each frequency of
// bending four times: on two pieces, in two directions. The unstructured mesh splits them by less
// than 1e-3.
TEST(OwnModes, OfABodyInPiecesLeaveOutAllRigidMotions) {
  const std::string file = writeFile("two_bars.geo", twoBars);
  const analysis::Analysis analysis = runOptions(
      "-mesh_file " + file + steel +
      " -ground_bottom_stiffness 1e4,1e4,1e4 -ground_top_stiffness 1e4,1e4,1e4 -modes_count 16"
      " -report_component_modes 6 -flutter_friction 0 -flutter_band 1000");
  const auto& modes = analysis.flutter.ownModes.at(0);
  ASSERT_EQ(modes.size(), 6u);
  const auto exact = beam::freeBending({1, 0.04, 0.04}, poisson, 2);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(modes[i].angularFrequency / exact[i / 4], 1, 2e-3) << i;
}

// A round bar, turned in space: both modes of a pair bend in arbitrary directions and share a name.
// Their frequencies are those of a square bar with the same radius of gyration, to the difference
// of the shear coefficients, which is below 1e-3; the mesh adds 3e-3.
TEST(OwnModes, OfARoundBarShareNames) {
  const std::string file = writeFile("round_bar.geo", R"(SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0.6, 0.48, 0.64, 0.02};
Physical Volume("beam") = {1};
Physical Surface("bottom") = {1};
MeshSize{:} = 0.014;
Mesh.ElementOrder = 2;
)");
  const analysis::Analysis analysis =
      runOptions("-mesh_file " + file + steel +
                 " -ground_bottom_stiffness 1e4,1e4,1e4 -modes_count 8 -report_component_modes 4 "
                 "-flutter_friction 0 -flutter_band 1000");
  const auto& modes = analysis.flutter.ownModes.at(0);
  ASSERT_EQ(modes.size(), 4u);
  const double side = 0.02 * std::sqrt(3);
  const auto exact = beam::freeBending({1, side, side}, poisson, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(modes[i].motion.name, formatted("bending %zu", 1 + i / 2));
    EXPECT_NEAR(modes[i].angularFrequency / exact[i / 2], 1, 5e-3);
  }
}

// In the plane, the modes have frequencies and no names. A bar in plane stress bends like a beam.
TEST(OwnModes, InThePlaneHaveNoNames) {
  const std::string file = writeFile("strip.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 0.02};
Physical Surface("beam") = {1};
Physical Curve("bottom") = {1};
Mesh.ElementOrder = 2;
MeshSize{:} = 0.02;
)");
  const analysis::Analysis analysis =
      runOptions("-mesh_file " + file + steel +
                 " -elasticity_plane stress -ground_bottom_stiffness 1e4,1e4 -modes_count 8 "
                 "-report_component_modes 3 -flutter_friction 0 -flutter_band 1000");
  const auto& modes = analysis.flutter.ownModes.at(0);
  ASSERT_EQ(modes.size(), 3u);
  const auto exact = beam::freeBending({1, 1, 0.02}, poisson, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(modes[i].angularFrequency / exact[i], 1, 1e-3) << i;
    EXPECT_EQ(modes[i].motion.name, "");
  }
}

}  // namespace
}  // namespace squeal::test
