// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The normals, the mass matrix and the derivatives of the shape functions of one face (a line in
/// plane problems), as small dense arrays from coordinates. Not collective.
#include <vector>

#include "model/element/shape.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

using element::ShapeTable;
using mesh::Point;

/// Returns ∫ φᵢ n dA on a face (a line in plane problems), [node][3], m² (m in plane problems). The
/// unit normal n is that given by the node order, times `sign`.
std::vector<double> faceNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);
/// Returns the quadrature weights for integrals over the face, [point], m² (m in plane problems).
std::vector<double> areaWeights(const ShapeTable& table, const std::vector<Point>& nodes);
/// Returns ∫ φᵢ φⱼ dA on a face, row-major [node][node], m² (m in plane problems).
std::vector<double> faceMass(const ShapeTable& table, const std::vector<Point>& nodes);
/// Returns ∫ (n·eᵢ φ_a)(n·eⱼ φ_b) dA on a face, row-major, rows and columns [node][component], m²
/// (m in plane problems).
std::vector<double> normalMass(const ShapeTable& table, const std::vector<Point>& nodes,
                               int components);
/// Returns the derivative of each shape function along the velocity at each node of the face,
/// [node][function], 1/s for velocities in m/s. Only the tangential part of `velocity` has an
/// effect.
std::vector<double> faceDerivative(const ShapeTable& table, const std::vector<Point>& nodes,
                                   const std::vector<Point>& velocity);
/// Returns the unit normal at each node of the face, [node]: that given by the node order, times
/// `sign`.
std::vector<Point> nodeNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);

}  // namespace squeal::elasticity
