// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Stiffness matrices of one element, as small dense arrays from coordinates and material, without
/// PETSc objects. Not collective.
#include <vector>

#include "model/element/shape.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

using element::ShapeTable;
using element::shapeTable;
using element::stiffnessTable;
using material::Hooke;
using material::Law;
using material::Material;
using mesh::Point;

/// Thrown if det J ≤ 0 at a quadrature point of a routine that needs J⁻¹. mass() throws it only if
/// the volume is not positive or the matrix is not positive definite.
struct InvertedElement {};

/// Returns true if the cell is folded: det J ≤ 0 at a point of the rule of `table`. A folded cell
/// is usable if det J > 0 at all points of the smallest rule for the stiffness. Terms with J⁻¹ are
/// then integrated by that rule. Loads have polynomial integrands and are integrated as usual, and
/// the mass is that of the true volume.
bool folded(const ShapeTable& table, const std::vector<Point>& nodes);
/// Returns the table of a cell for terms with J⁻¹: the given table or, for a folded cell, the table
/// of the stiffness.
const ShapeTable& gradientTable(const ShapeTable& table, const std::vector<Point>& nodes);

/// Returns true if the cell is folded on the rule of its stiffness or on the stricter one of its
/// mass. `type` is the gmsh element type.
bool foldedAnywhere(int type, const std::vector<Point>& nodes);
/// Returns the smallest det J, divided by the largest |det J|, at the points of both rules.
double jacobianRatio(int type, const std::vector<Point>& nodes);
/// Returns the nodes of the cell with straight edges: nodes other than corners move to their
/// positions in the linear cell with the same corners.
std::vector<Point> straightened(int type, const std::vector<Point>& nodes);

/// Returns the stiffness
///   K_ij = ∫ Bᵢᵀ D Bⱼ,
/// row-major, rows and columns [node][component], N/m (per unit thickness in plane problems). If
/// `incompatible`, quad4 and hex8 get the quadratic bubble modes of Taylor, Beresford and Wilson
/// (1976), condensed; they pass the patch test.
std::vector<double> stiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                              const Law& law, bool incompatible);

/// Returns the geometric stiffness
///   ∫ ∇φᵢ·σ ∇φⱼ,   σ = D ε,
/// row-major [node][node], N/m, the same for all components. ε is the strain of `displacement`,
/// [node][component], m, and of the bubble modes that follow from it if `incompatible`.
std::vector<double> geometricStiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                                       const Law& law, bool incompatible,
                                       std::vector<double> displacement);

}  // namespace squeal::elasticity
