// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/basis.hpp"

#include <map>
#include <string>

#include "base/petsc/check.hpp"

namespace squeal::mortar {
namespace {

// gmsh's numbers of the element types.
enum { line2 = 1, tri3 = 2, quad4 = 3, line3 = 8, tri6 = 9, quad9 = 10, quad8 = 16 };

FaceType line(int type, int order) {
  FaceType line{type, 1, order, order + 1, 2, {}, {{-1, 0}, {1, 0}}};
  if (order == 2) {
    line.edges = {{2, {0, 1}}};
    line.reference.push_back({0, 0});
  }
  return line;
}

FaceType polygon(int type, int order, int nodes, std::vector<Reference> corners) {
  const int n = corners.size();
  FaceType face{type, 2, order, nodes, n, {}, corners};
  if (order == 1) return face;
  for (int a = 0; a < n; ++a) {
    const int b = (a + 1) % n;
    face.edges.push_back({n + a, {a, b}});
    face.reference.push_back(
        {(corners[a][0] + corners[b][0]) / 2, (corners[a][1] + corners[b][1]) / 2});
  }
  if (nodes > 2 * n) face.reference.push_back({0, 0});
  return face;
}

std::map<int, FaceType> allTypes() {
  const std::vector<Reference> triangle{{0, 0}, {1, 0}, {0, 1}},
      square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  return {{line2, line(line2, 1)},
          {line3, line(line3, 2)},
          {tri3, polygon(tri3, 1, 3, triangle)},
          {tri6, polygon(tri6, 2, 6, triangle)},
          {quad4, polygon(quad4, 1, 4, square)},
          {quad8, polygon(quad8, 2, 8, square)},
          {quad9, polygon(quad9, 2, 9, square)}};
}

/// A function of one variable with its derivative.
struct Function {
  double value, derivative;
};

/// Returns (1 + x_i x) / 2, the linear function that is 1 at x_i = ±1.
Function linear(double node, double x) { return {(1 + node * x) / 2, node / 2}; }

/// Returns the quadratic function that is 1 at x_i and 0 at the other two of −1, 0 and 1.
Function quadratic(double node, double x) {
  if (node == 0) return {1 - x * x, -2 * x};
  return {x * (x + node) / 2, x + node / 2};
}

void setProduct(FaceShape& shape, std::size_t i, const Function& f, const Function& g) {
  shape.value[i] = f.value * g.value;
  shape.gradient[i] = {f.derivative * g.value, f.value * g.derivative};
}

void setLine(FaceShape& shape, const FaceType& type, double x) {
  for (std::size_t i = 0; i < type.reference.size(); ++i) {
    const double node = type.reference[i][0];
    setProduct(shape, i, type.order == 1 ? linear(node, x) : quadratic(node, x), {1, 0});
  }
}

void setTriangle(FaceShape& shape, const FaceType& type, const Reference& x) {
  const std::array<double, 3> l{1 - x[0] - x[1], x[0], x[1]};
  const std::array<Reference, 3> dl{Reference{-1, -1}, Reference{1, 0}, Reference{0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    // φ_c = λ or λ (2λ − 1) at the corners
    const bool linear = type.order == 1;
    shape.value[i] = linear ? l[i] : l[i] * (2 * l[i] - 1);
    const double factor = linear ? 1 : 4 * l[i] - 1;
    shape.gradient[i] = {factor * dl[i][0], factor * dl[i][1]};
  }
  for (const auto& [e, corners] : type.edges) {
    const auto [a, b] = corners;
    // φ_e = 4 λ_a λ_b
    shape.value[e] = 4 * l[a] * l[b];
    for (std::size_t d = 0; d < 2; ++d)
      shape.gradient[e][d] = 4 * (dl[a][d] * l[b] + l[a] * dl[b][d]);
  }
}

void setQuadrilateral(FaceShape& shape, const FaceType& type, const Reference& x) {
  const bool full = type.type == quad9;
  for (std::size_t i = 0; i < type.reference.size(); ++i) {
    const auto& [a, b] = type.reference[i];
    // The function of a mid-edge node of the quad8 is quadratic along its edge and linear across
    // it.
    setProduct(shape, i, full || a == 0 ? quadratic(a, x[0]) : linear(a, x[0]),
               full || b == 0 ? quadratic(b, x[1]) : linear(b, x[1]));
  }
  if (type.type != quad8) return;
  // The functions of its corners, (1 + ξ_c ξ)(1 + η_c η)/4 so far, must vanish at mid-edge nodes.
  for (const auto& [e, corners] : type.edges)
    for (const int c : corners) {
      shape.value[c] -= shape.value[e] / 2;
      for (std::size_t d = 0; d < 2; ++d) shape.gradient[c][d] -= shape.gradient[e][d] / 2;
    }
}

}  // namespace

Reference FaceType::centre() const {
  return dimension == 2 && corners == 3 ? Reference{1. / 3, 1. / 3} : Reference{0, 0};
}

const FaceType& faceType(int gmshType) {
  static const std::map<int, FaceType> types = allTypes();
  const auto found = types.find(gmshType);
  if (found == types.end())
    throw Error("faces of gmsh's element type " + std::to_string(gmshType) +
                " cannot be coupled if the meshes do not match: use lines, triangles and "
                "quadrilaterals of order 1 or 2");
  return found->second;
}

FaceShape faceShape(const FaceType& type, const Reference& point) {
  FaceShape shape;
  if (type.dimension == 1)
    setLine(shape, type, point[0]);
  else if (type.corners == 3)
    setTriangle(shape, type, point);
  else
    setQuadrilateral(shape, type, point);
  return shape;
}

double usualAlpha(const FaceType& type, Cover cover, Multiplier multiplier) {
  const bool full = cover == Cover::full;
  if (type.type == quad8) return full ? 1. / 5 : 3. / 8;
  if (type.type != tri6) return 0;
  if (!full) return 1. / 4;
  return multiplier == Multiplier::nodes ? 1. / 5 : 1. / 12;
}

NodeValues slaveBasis(const FaceType& type, const NodeValues& shape,
                      std::span<const double> alpha) {
  NodeValues basis = shape;
  for (std::size_t e = 0; e < type.edges.size(); ++e) {
    const auto& [node, corners] = type.edges[e];
    basis[node] = (1 - 2 * alpha[e]) * shape[node];
    for (const int c : corners) basis[c] += alpha[e] * shape[node];
  }
  return basis;
}

}  // namespace squeal::mortar
