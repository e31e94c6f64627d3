// SPDX-License-Identifier: BSD-2-Clause
// Faces of a mesh with their bodies, and the boxes around curved faces.
#include <gtest/gtest.h>

#include <map>

#include "model/coupling/box.hpp"
#include "support/model/gmsh_library.hpp"
#include "support/model/mesh_checks.hpp"
#include "support/model/mesh_text.hpp"
#include "support/model/model.hpp"
#include "support/model/random_faces.hpp"

namespace squeal {
namespace {

using coupling::Box;
using coupling::boxOf;
using mortar::Face;
using mortar::Point;
using test::randomFace;
using test::total;

// Bodies that share nodes at the edge of the face: the lining under the back plate.
TEST(FacesOf, BearTheBodyThatTheyBound) {
  for (const std::string shape : {"", ",order=2", ",order=2,serendipity=1"}) {
    test::setCase(
        "disc_brake",
        "-mesh_set n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,"
        "n_hat=2,n_h_ring=2" +
            shape + " -load_guide_leading_pressure 1");
    const auto mesh = test::readMesh();
    const auto coordinates = test::allCoordinates(mesh);
    const auto areas = test::areaVectors(mesh);
    for (const auto& [surface, body] :
         std::map<std::string, std::string>{{"pressed", "back_plate"},
                                            {"guide_leading", "back_plate"},
                                            {"lining_face", "lining"}}) {
      const auto faces = mortar::facesOf(mesh, surface);
      EXPECT_GT(total(static_cast<double>(faces.size())), 3);
      Point area{};
      for (const auto& face : faces) {
        EXPECT_EQ(mesh.bodies.at(static_cast<std::size_t>(face.body)), body) << surface;
        EXPECT_EQ(face.nodes.size(), face.points.size());
        EXPECT_EQ(face.parts.size(), face.points.size());
        for (std::size_t i = 0; i < face.nodes.size(); ++i) {
          EXPECT_EQ(mesh.partName.at(static_cast<std::size_t>(face.parts.at(i))),
                    "back_plate+lining");
          for (std::size_t d = 0; d < 3; ++d)
            EXPECT_EQ(face.points.at(i)[d],
                      coordinates[3 * static_cast<std::size_t>(face.nodes[i]) + d]);
        }
        const auto normals =
            elasticity::faceNormals(element::shapeTable(face.type), face.points, face.sign);
        for (std::size_t i = 0; i < normals.size(); ++i) area[i % 3] += normals[i];
      }
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(total(area[d]), areas.at(surface)[d], 1e-15) << surface;  // of about 1e-3 m²
    }
    EXPECT_NE(test::errorOf([&] { mortar::facesOf(mesh, "nowhere"); }), "");
  }
}

// A surface across two bodies: both have a cell at the first node of the second face.
TEST(FacesOf, BearTheBodyOnEachSideOfANode) {
  std::string text = test::quadranglesMsh2();
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("$PhysicalNames\n3", "$PhysicalNames\n4\n2 4 \"right\"");
  replace("6 3 2 3 1 2 3 6", "6 3 2 4 1 2 3 6");
  test::setOptions("-mesh_file " + test::writeFile("two_bodies.msh", text) +
                   test::material("layer", "1", "0.3", "1") +
                   test::material("right", "1", "0.3", "1") + "-load_bottom_pressure 1");
  const auto mesh = test::readMesh();
  const auto faces = mortar::facesOf(mesh, "bottom");
  EXPECT_EQ(total(static_cast<double>(faces.size())), 2);
  for (const auto& face : faces) {
    EXPECT_EQ(mesh.bodies.at(static_cast<std::size_t>(face.body)),
              face.points[0][0] + face.points[1][0] < 2 ? "layer" : "right");
    EXPECT_EQ(face.sign, 1);  // from left to right, the normal (dy, −dx) points down
  }
}

/// Points of a face by the shape functions of gmsh, on a grid that includes its boundary.
std::vector<Point> sampled(const Face& face) {
  const auto& table = element::shapeTable(face.type);
  constexpr int steps = 12;
  std::vector<double> grid;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
      if (table.corners == 3) {
        if (i + j <= steps) grid.insert(grid.end(), {s, t, 0});
      } else {
        grid.insert(grid.end(), {2 * s - 1, table.dimension == 1 ? 0 : 2 * t - 1, 0});
      }
    }
  test::startGmsh();
  int components = 0, orientations = 0;
  std::vector<double> values;
  gmsh::model::mesh::getBasisFunctions(face.type, grid, "Lagrange", components, values,
                                       orientations);
  const std::size_t n = face.points.size();
  std::vector<Point> points(grid.size() / 3, Point{});
  for (std::size_t p = 0; p < points.size(); ++p)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t d = 0; d < 3; ++d) points[p][d] += values[p * n + i] * face.points[i][d];
  return points;
}

Box boxOfPoints(const std::vector<Point>& points) {
  Box box{points[0], points[0]};
  for (const auto& p : points)
    for (std::size_t d = 0; d < 3; ++d)
      box.low[d] = std::min(box.low[d], p[d]), box.high[d] = std::max(box.high[d], p[d]);
  return box;
}

/// The distance by which the inner box leaves the outer one.
double excess(const Box& outer, const Box& inner) {
  double worst = 0;
  for (std::size_t d = 0; d < 3; ++d)
    worst = std::max({worst, outer.low[d] - inner.low[d], inner.high[d] - outer.high[d]});
  return worst;
}

TEST(Box, ContainsCurvedFaces) {
  std::mt19937 random(4);
  for (const int type : test::faceTypes) {
    double beyondNodes = 0, loose = 0;
    for (int i = 0; i < 200; ++i) {
      const Face face = randomFace(random, type, {0, 0, 0}, 1, 0.3);
      const Box box = boxOf(face), curve = boxOfPoints(sampled(face));
      EXPECT_LT(excess(box, curve), 1e-14) << "type " << type;  // rounding of lengths of 1
      beyondNodes = std::max(beyondNodes, excess(boxOfPoints(face.points), curve));
      loose = std::max(loose, excess(curve, box));
      const Face straight = randomFace(random, type, {0, 0, 0}, 1, 0);
      // The middle node of quad9 is not in the middle of corners that lie in no plane.
      if (type == 10) continue;
      EXPECT_LT(excess(boxOfPoints(straight.points), boxOf(straight)), 1e-14) << "type " << type;
    }
    const bool curved = element::shapeTable(type).order == 2;
    if (curved) {
      EXPECT_GT(beyondNodes, 0.01) << "the nodes do not bound the face";
    }
    test::print(
        "type %d: the face leaves the box of its nodes by %.2f, its own box leaves it by "
        "%.2f\n",
        type, beyondNodes, loose);
  }
}

// The Bernstein control point of a parabola of height h is at 2 h.
TEST(Box, OfAParabola) {
  Face face;
  face.type = 8;
  face.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.25, 0}};
  const Box box = boxOf(face);
  EXPECT_EQ(box.low, (Point{0, 0, 0}));
  EXPECT_EQ(box.high, (Point{1, 0.5, 0}));
}

/// The box of a unit square whose corners, edge nodes and middle are at these heights.
Box boxOfHeights(int type, double corner, double edge, double middle) {
  Face face;
  face.type = type;
  face.points = {{0, 0, corner}, {1, 0, corner}, {1, 1, corner}, {0, 1, corner},
                 {0.5, 0, edge}, {1, 0.5, edge}, {0.5, 1, edge}, {0, 0.5, edge}};
  if (type == 10) face.points.push_back({0.5, 0.5, middle});
  return boxOf(face);
}

// The control points of ξ² on [0, 1] are 0, 0 and 1; those of ξ (1 − ξ) are 0, 1/2 and 0. Heights
// of quad9: 16 h ξ (1 − ξ) η (1 − η) has the middle 16 h/4, (2 ξ − 1)² (2 η − 1)² has the middle
// (−1)² and −1 on edges. quad8: with h = a on edges the middle node is at 2 a and its control point
// at 4 a; with h = 1 at corners it is at −1 and −3.
TEST(Box, OfSquaresWithRaisedNodes) {
  EXPECT_EQ(boxOfHeights(10, 0, 0, 1).high[2], 4);
  EXPECT_EQ(boxOfHeights(10, 1, 0, 0).low[2], -1);
  EXPECT_EQ(boxOfHeights(10, 1, 0, 0).high[2], 1);
  EXPECT_EQ(boxOfHeights(10, 0, 1, 0).low[2], -4);
  EXPECT_EQ(boxOfHeights(16, 0, 1, 0).high[2], 4);
  EXPECT_EQ(boxOfHeights(16, 1, 0, 0).low[2], -3);
}

}  // namespace
}  // namespace squeal
