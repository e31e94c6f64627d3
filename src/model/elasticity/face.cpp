// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/face.hpp"

#include "model/mesh/vector.hpp"

namespace squeal::elasticity {

using mesh::cross;
using mesh::dot;
using mesh::length;

namespace {

Point faceNormal(const double* gradient, const std::vector<Point>& nodes, int dimension) {
  Point a{}, b{0, 0, 1};  // in the plane: (dx, dy) × z = (dy, −dx)
  if (dimension == 2) b = {};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      a[d] += gradient[3 * i] * nodes[i][d];
      if (dimension == 2) b[d] += gradient[3 * i + 1] * nodes[i][d];
    }
  return cross(a, b);
}

}  // namespace

std::vector<double> faceNormals(const ShapeTable& table, const std::vector<Point>& nodes,
                                int sign) {
  const std::size_t n = table.nodes;
  std::vector<double> load(3 * n, 0.0);
  for (int q = 0; q < table.points(); ++q) {
    const Point normal =
        faceNormal(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension);
    const double factor = sign * table.weight[q];
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t d = 0; d < 3; ++d)
        load[3 * a + d] += factor * table.value[q * n + a] * normal[d];
  }
  return load;
}

std::vector<double> areaWeights(const ShapeTable& table, const std::vector<Point>& nodes) {
  std::vector<double> weights;
  for (int q = 0; q < table.points(); ++q)
    weights.push_back(
        table.weight[q] *
        length(faceNormal(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension)));
  return weights;
}

std::vector<double> faceMass(const ShapeTable& table, const std::vector<Point>& nodes) {
  const std::size_t n = table.nodes;
  std::vector<double> m(n * n, 0.0);
  const auto weight = areaWeights(table, nodes);
  for (int q = 0; q < table.points(); ++q) {
    const double* value = table.value.data() + q * n;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) m[a * n + b] += weight[q] * value[a] * value[b];
  }
  return m;
}

std::vector<double> normalMass(const ShapeTable& table, const std::vector<Point>& nodes,
                               int components) {
  const int size = table.nodes * components;
  std::vector<double> m(std::size_t(size) * size, 0.0), row(size);
  for (int q = 0; q < table.points(); ++q) {
    const Point normal =
        faceNormal(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension);
    const double area = length(normal);
    for (int i = 0; i < size; ++i)
      row[i] = table.value[q * table.nodes + i / components] * normal[i % components] / area;
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) m[i * size + j] += table.weight[q] * area * row[i] * row[j];
  }
  return m;
}

std::vector<Point> nodeNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign) {
  std::vector<Point> normals;
  for (int i = 0; i < table.nodes; ++i) {
    const Point normal =
        faceNormal(table.nodeGradient.data() + 3 * i * table.nodes, nodes, table.dimension);
    normals.push_back(mesh::scaled(normal, sign / length(normal)));
  }
  return normals;
}

std::vector<double> faceDerivative(const ShapeTable& table, const std::vector<Point>& nodes,
                                   const std::vector<Point>& velocity) {
  const std::size_t n = table.nodes;
  std::vector<double> derivative(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* gradient = table.nodeGradient.data() + 3 * i * n;
    // With x = x(ξ) on the face and the tangents a_r = ∂x/∂ξ_r:
    //   V = Σ c_r a_r + normal part,   (V·∇)φ = Σ c_r ∂φ/∂ξ_r
    Point tangent[2]{};
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t r = 0; r < 2; ++r)
        for (std::size_t d = 0; d < 3; ++d) tangent[r][d] += gradient[3 * j + r] * nodes[j][d];
    const double aa = dot(tangent[0], tangent[0]), va = dot(velocity[i], tangent[0]);
    double c[2] = {va / aa, 0};
    if (table.dimension == 2) {
      const double ab = dot(tangent[0], tangent[1]), bb = dot(tangent[1], tangent[1]),
                   vb = dot(velocity[i], tangent[1]);
      const double det = aa * bb - ab * ab;
      c[0] = (va * bb - vb * ab) / det, c[1] = (vb * aa - va * ab) / det;
    }
    for (std::size_t j = 0; j < n; ++j)
      derivative[i * n + j] = c[0] * gradient[3 * j] + c[1] * gradient[3 * j + 1];
  }
  return derivative;
}

}  // namespace squeal::elasticity
