// SPDX-License-Identifier: BSD-2-Clause
// Names of the free modes of a disc with twelve blades on its rim, clamped at its hub.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// A disc of radius 0.1 m, and boxes that cross its rim, copies of each other.
const char* const geometry = R"(SetFactory("OpenCASCADE");
DefineConstant[ size = {0.02, Name "size"} ];
Cylinder(1) = {0, 0, 0, 0, 0, 0.006, 0.1};
Cylinder(2) = {0, 0, 0, 0, 0, 0.006, 0.03};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
blades[] = {};
For i In {1 : 12}
  b = newv;
  Box(b) = {0.099, -0.008, 0, 0.026, 0.016, 0.006};
  Rotate{{0, 0, 1}, {0, 0, 0}, 2 * Pi * i / 12}{ Volume{b}; }
  blades[] += {b};
EndFor
disc[] = BooleanUnion{ Volume{3}; Delete; }{ Volume{blades[]}; Delete; };
Physical Volume("disc") = {disc[]};
e = 1e-6;
hub[] = Surface In BoundingBox{-0.03 - e, -0.03 - e, -e, 0.03 + e, 0.03 + e, 0.006 + e};
Physical Surface("hub") = {hub[]};
MeshSize{:} = size;
Mesh.ElementOrder = 2;
)";

// The group of twelve turns has pairs of 1 to 5 diameters, and single modes of 0 and of 6, half the
// number of blades. An unstructured mesh splits the frequencies of a pair by less than 1 %; the
// lowest modes of different names are 1.4 % apart at least. Names do not depend on the mesh.
TEST(ModeNames, OfABladedDisc) {
  const std::string file = writeFile("bladed_disc.geo", geometry);
  for (const char* size : {"0.02", "0.014"}) {
    const analysis::Analysis analysis = runOptions(
        "-mesh_file " + file + " -mesh_set size=" + size +
        material("disc", "1.2e11", "0.25", "7200") +
        "-constraint_hub_clamped xyz -modes_count 16 -flutter_friction 0 -flutter_band 20000");
    const auto& segment = analysis.flutter.segments.at(0);
    std::vector<std::string> names;
    for (const auto& components : segment.components) names.push_back(pencil::modeName(components));
    std::vector<std::string> wanted(2, "disc rigid about a diameter");
    wanted.push_back("disc (0,0) out of plane");
    for (int n = 2; n <= 5; ++n)
      for (int k = 0; k < 2; ++k) wanted.push_back(formatted("disc (0,%d) out of plane", n));
    wanted.push_back("disc (0,6) out of plane");
    ASSERT_GE(names.size(), wanted.size());
    names.resize(wanted.size());
    EXPECT_EQ(names, wanted) << size;
    const auto& w = segment.modes.angularFrequency;
    for (const std::size_t first : {0, 3, 5, 7, 9}) {
      print("%s: %s at %.2f and %.2f Hz\n", size, names[first].c_str(), w[first] / (2 * M_PI),
            w[first + 1] / (2 * M_PI));
      EXPECT_NEAR(w[first + 1] / w[first], 1, 1e-2);
    }
  }
}

}  // namespace
}  // namespace squeal::test
