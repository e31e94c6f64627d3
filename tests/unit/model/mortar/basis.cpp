// SPDX-License-Identifier: BSD-2-Clause
// Shape functions of faces against gmsh's, and the basis of the slave side with its weights.
#include "model/mortar/basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/petsc/check.hpp"
#include "model/element/shape.hpp"
#include "model/mortar/dual.hpp"
#include "support/model/face_patch.hpp"

namespace squeal {
namespace {

using namespace mortar;
using test::line2, test::line3, test::quad4, test::quad8, test::quad9, test::tri3, test::tri6;

const std::vector<int> allTypes{line2, line3, tri3, tri6, quad4, quad8, quad9};

TEST(FaceBasis, ShapeFunctionsAreThoseOfGmsh) {
  for (const int number : allTypes) {
    const auto& table = element::shapeTable(number);
    const FaceType& type = faceType(number);
    SCOPED_TRACE(table.name);
    EXPECT_EQ(type.nodes, table.nodes);
    EXPECT_EQ(type.corners, table.corners);
    EXPECT_EQ(type.order, table.order);
    EXPECT_EQ(type.dimension, table.dimension);
    for (int q = 0; q < table.points(); ++q) {
      const auto shape = faceShape(type, {table.point[3 * q], table.point[3 * q + 1]});
      for (int i = 0; i < type.nodes; ++i) {
        const int at = q * type.nodes + i;
        EXPECT_NEAR(shape.value[i], table.value[at], 1e-14);
        for (int d = 0; d < type.dimension; ++d)
          EXPECT_NEAR(shape.gradient[i][d], table.gradient[3 * at + d], 1e-14);
      }
    }
  }
}

TEST(FaceBasis, NodesAreWhereTheirFunctionsAreOne) {
  for (const int number : allTypes) {
    const FaceType& type = faceType(number);
    ASSERT_EQ(std::ssize(type.reference), type.nodes);
    for (int i = 0; i < type.nodes; ++i) {
      const auto shape = faceShape(type, type.reference[i]);
      for (int j = 0; j < type.nodes; ++j) EXPECT_EQ(shape.value[j], i == j) << number;
    }
    for (const auto& [node, corners] : type.edges)
      for (int d = 0; d < 2; ++d)
        EXPECT_EQ(type.reference[node][d],
                  (type.reference[corners[0]][d] + type.reference[corners[1]][d]) / 2);
  }
}

TEST(FaceBasis, OtherTypesAreRefused) {
  for (const int number : {0, 4, 15, 20, 21, 26, 36}) EXPECT_THROW(faceType(number), Error);
}

struct Weights {
  int type;
  double corner, edge, centre;
};

TEST(FaceBasis, IntegralsOnAffineFacesArePositiveParts) {
  // of the area, for α = 1/5 on tri6 and quad8 and 0 otherwise
  for (const auto& [number, corner, edge, centre] :
       {Weights{line2, 1. / 2, 0, 0}, Weights{line3, 1. / 6, 2. / 3, 0},
        Weights{tri3, 1. / 3, 0, 0}, Weights{tri6, 2. / 15, 1. / 5, 0},
        Weights{quad4, 1. / 4, 0, 0}, Weights{quad8, 1. / 20, 1. / 5, 0},
        Weights{quad9, 1. / 36, 1. / 9, 4. / 9}}) {
    const FaceType& type = faceType(number);
    const Face face = test::facePatch(number, {0, 1}, {0, 1}, 1).faces[0];
    const std::vector<double> alpha(type.edges.size(), usualAlpha(type, Cover::full));
    const auto weights = wholeIntegrals(face, alpha);
    const double area = type.dimension == 2 && type.corners == 3 ? 0.5 : 1;
    const int edges = type.edges.size();
    for (int i = 0; i < type.nodes; ++i) {
      const double part = i < type.corners ? corner : i < type.corners + edges ? edge : centre;
      EXPECT_NEAR(weights[i], part * area, 1e-15) << number << " node " << i;
    }
  }
}

/// Returns the smallest value of a function of the basis on a fine grid.
double smallest(const FaceType& type, double alpha) {
  const std::vector<double> alphas(type.edges.size(), alpha);
  const bool triangle = type.corners == 3;
  double least = 1;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= (triangle ? 60 - i : 60); ++j) {
      const double scale = triangle ? 60 : 30, from = triangle ? 0 : -1;
      const auto shape = faceShape(type, {from + i / scale, from + j / scale});
      const auto basis = slaveBasis(type, shape.value, alphas);
      for (int node = 0; node < type.nodes; ++node) least = std::min(least, basis[node]);
    }
  return least;
}

TEST(FaceBasis, IsNowhereNegativeFromTheAlphaOfPartlyCoveredFaces) {
  for (const int number : {tri6, quad8}) {
    const FaceType& type = faceType(number);
    const double alpha = usualAlpha(type, Cover::partial);
    EXPECT_GT(smallest(type, alpha), -1e-15) << number;  // it is zero at nodes: rounding
    EXPECT_LT(smallest(type, alpha - 0.01), -1e-5) << number;
  }
}

TEST(FaceBasis, EdgesMayHaveDifferentAlpha) {
  // Σ φ̃ = 1, and with u = E ũ the interpolations Σ φ̃ ũ and Σ φ u are the same function.
  const FaceType& type = faceType(quad8);
  const std::vector<double> alpha{0.1, 0.2, 0.25, 0.375},
      tilde{0.3, -1.1, 0.7, 2, -0.6, 0.9, 1.3, -0.2};
  auto u = tilde;
  for (std::size_t e = 0; e < 4; ++e) {
    const auto& [node, corners] = type.edges[e];
    u[node] = (1 - 2 * alpha[e]) * tilde[node] + alpha[e] * (tilde[corners[0]] + tilde[corners[1]]);
  }
  const auto shape = faceShape(type, {0.21, -0.64});
  const auto basis = slaveBasis(type, shape.value, alpha);
  double sum = 0, one = 0, other = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    sum += basis[i];
    one += basis[i] * tilde[i];
    other += shape.value[i] * u[i];
  }
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(one, other, 1e-15);
}

}  // namespace
}  // namespace squeal
