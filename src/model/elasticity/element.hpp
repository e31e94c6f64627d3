// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Stiffness matrices of one element. Coordinates and material go in,
/// and small dense arrays come out. No PETSc object is used here. None is collective.
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

/// An InvertedElement is thrown by routines with J⁻¹ where det J ≤ 0 at a point of their quadrature
/// rule, and by mass() where the volume or the matrix is not positive.
struct InvertedElement {};

/// Returns true if det J ≤ 0 at a point of the rule. Such a cell can still be used where the
/// smallest rule for the stiffness has no such point: terms with J⁻¹ take that rule, loads are
/// polynomials and are integrated as usual, and the mass has the true volume.
bool folded(const ShapeTable& table, const std::vector<Point>& nodes);
/// Returns the table of a cell for terms with J⁻¹: the given one, or that for the stiffness if the
/// cell is folded.
const ShapeTable& gradientTable(const ShapeTable& table, const std::vector<Point>& nodes);

/// Returns true if the cell is folded on the rule of its stiffness or on the stricter one of its
/// mass. `type` is gmsh's.
bool foldedAnywhere(int type, const std::vector<Point>& nodes);
/// Returns the smallest det J at the points of both rules over the largest |det J| there.
double jacobianRatio(int type, const std::vector<Point>& nodes);
/// Returns the nodes of the cell with straight edges: nodes other than corners are moved to where
/// the linear cell of the same corners has them.
std::vector<Point> straightened(int type, const std::vector<Point>& nodes);

/// Returns the stiffness
///   K_ij = ∫ Bᵢᵀ D Bⱼ,
/// row-major, rows and columns [node][component], N/m (per unit thickness in the plane). If
/// `incompatible`, quad4 and hex8 get the quadratic bubble modes of Taylor, Beresford and Wilson
/// (1976), condensed; they pass the patch test.
std::vector<double> stiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                              const Law& law, bool incompatible);

/// Returns the geometric stiffness
///   ∫ ∇φᵢ·σ ∇φⱼ,   σ = D ε,
/// row-major [node][node], N/m, the same for all components. The strain ε is that of the
/// displacement, [node][component], m, and of the bubble modes that go with it.
std::vector<double> geometricStiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                                       const Law& law, bool incompatible,
                                       std::vector<double> displacement);

}  // namespace squeal::elasticity
