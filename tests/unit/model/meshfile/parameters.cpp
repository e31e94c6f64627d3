// SPDX-License-Identifier: BSD-2-Clause
// Parameters of geometries, -mesh_set: their names, their ranges, and the size of the mesh.
#include <gtest/gtest.h>

#include "support/harness/messages.hpp"
#include "support/model/layer_file.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal {
namespace {

using test::expectMessage;
using test::layer;
using test::messageOf;

// nx = 0 and -3 gave 12 cells, 2.5 gave 24 instead of 2.5 × 12.
TEST(MeshParameters, MustBeWhatTheGeometryDeclares) {
  const std::string geometry = "meshes/layer.geo";
  for (const char* value : {"0", "-3", "2.5", "100001", "1e9"})
    expectMessage(messageOf(geometry, layer + "-mesh_set nx=" + value),
                  {"-mesh_set nx=", "must be a whole number >= 1"});
  for (const char* value : {"nan", "inf", "-inf", "1e999", "0x10", "", "3=4"})
    expectMessage(messageOf(geometry, layer + "-mesh_set nx=" + value),
                  {"-mesh_set", "name=number"});
  expectMessage(messageOf(geometry, layer + "-mesh_set order=3"), {"order=3", "must be 1 or 2"});
  expectMessage(messageOf(geometry, layer + "-mesh_set nx=3,ny=2,nx=4"),
                {"-mesh_set", "'nx' twice"});
  expectMessage(messageOf(geometry, layer + "-mesh_set mx=3"),
                {"no parameter 'mx'", "it has: Lx, h, nx"});
  expectMessage(messageOf("meshes/ring.geo",
                          test::material("ring", "1", "0.3", "1") + "-mesh_set n_theta=66"),
                {"n_theta = 66", "multiple of 4"});
  const auto mesh = test::writeFile("parameters.msh", test::quadranglesMsh2());
  expectMessage(messageOf(mesh, layer + "-mesh_set nx=3"),
                {"-mesh_set", "parameters.msh", "a mesh"});
}

std::string square(const std::string& declarations) {
  return "DefineConstant[" + declarations +
         "];\nPoint(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, "
         "0};\n"
         "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = "
         "{1 : 4}; Plane Surface(1) = "
         "{1};\n"
         "Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = 3; Transfinite Surface {1}; "
         "Recombine Surface {1};\n"
         "Physical Surface(\"layer\") = {1};\n";
}

TEST(MeshParameters, RangesOfOtherGeometries) {
  // gmsh makes up a range for its sliders where none is declared, here 7 to 180: that is not a
  // rule.
  const auto free = test::writeFile("free.geo", square("n = {36, Name \"n\"}"));
  test::setOptions("-mesh_file " + free + layer + "-mesh_set n=3");
  EXPECT_EQ(test::readMesh().totalCells, 6);
  const auto bounded = test::writeFile("bounded.geo", square("n = {3, Name \"n\", Min 2, Max 5}"));
  expectMessage(messageOf(bounded, layer + "-mesh_set n=6"),
                {"n=6", "must be a number >= 2 and <= 5"});
  expectMessage(messageOf(bounded, layer + "-mesh_set n=1"), {"n=1", ">= 2"});
  EXPECT_EQ(messageOf(bounded, layer + "-mesh_set n=5"), "");
  const auto fixed = test::writeFile("fixed.geo", square("n = {3, Name \"n\", ReadOnly 1}"));
  expectMessage(messageOf(fixed, layer + "-mesh_set n=5"), {"n=5", "takes 3 in its place"});
  const auto none = test::writeFile("none.geo", "n = 2;\n" + square("m = 1"));
  expectMessage(messageOf(none, layer + "-mesh_set n=5"), {"no parameter 'n'", "it has none"});
}

// 10¹⁰ cells: estimated from the numbers on the edges, before gmsh asks for them.
TEST(MeshParameters, AMeshTooLargeIsToldBeforeItIsMade) {
  expectMessage(messageOf("meshes/layer.geo", layer + "-mesh_set nx=100000,ny=100000"),
                {"about 1e+10 cells"});
  expectMessage(messageOf("meshes/beam.geo", test::material("beam", "1", "0.3", "1") +
                                                 "-mesh_set nx=5000,ny=2000,nz=1000"),
                {"about 1e+10 cells"});
}

}  // namespace
}  // namespace squeal
