#pragma once
/// Element matrices: coordinates and material in, small dense arrays out. No PETSc object is seen
/// here. Not collective.
#include <vector>

#include "elasticity/hooke.hpp"
#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"

namespace squeal::elasticity {

/// Thrown by the routines below where det J ≤ 0 at a point of their rule; by mass() where the
/// matrix is not positive definite.
struct InvertedElement {};

/// True if det J ≤ 0 at a point of the rule. Such a cell is still of use where the least rule for
/// the stiffness has no such point: terms with J⁻¹ take that rule, loads are polynomials and
/// integrated as they are, and the mass has the true volume.
bool folded(const ShapeTable& table, const std::vector<Point>& nodes);
/// The table of a cell for terms with J⁻¹: the given one, or that for stiffness if the cell is
/// folded.
const ShapeTable& gradientTable(const ShapeTable& table, const std::vector<Point>& nodes);

/// K_ij = ∫ Bᵢᵀ D Bⱼ, row-major, rows and columns [node][component], N/m (per unit thickness in the
/// plane). `incompatible` (quad4, hex8): quadratic bubble modes of Taylor, Beresford and Wilson
/// (1976), condensed; they pass the patch test.
std::vector<double> stiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                              const Law& law, bool incompatible);

/// ∫ ∇φᵢ·σ∇φⱼ, row-major [node][node], one copy for all components, N/m. σ = D ε of the
/// displacement, [node][component], m, and of the bubbles that go with it.
std::vector<double> geometricStiffness(const ShapeTable& table, const std::vector<Point>& nodes,
                                       const Law& law, bool incompatible,
                                       std::vector<double> displacement);

enum class MassKind { consistent, higherOrder };
/// m_ij = ∫ ρ φᵢ φⱼ, positive definite, row-major [node][node], kg, one copy for all components.
/// Higher order: the mean of the consistent matrix and the diagonal one with the same total
/// (diagonal scaling of Hinton, Rock and Zienkiewicz 1976, row sums on linear elements).
std::vector<double> mass(const ShapeTable& table, const std::vector<Point>& nodes, double density,
                         MassKind kind);

/// ∫ φᵢ ρ ω² r, [node][3], N: centrifugal force for the squared speed ω² about the axis (unit
/// vector) through `origin`.
std::vector<double> centrifugal(const ShapeTable& table, const std::vector<Point>& nodes,
                                double density, double speed, const Point& axis,
                                const Point& origin);

/// Convective terms of matter that moves through the element with the velocity V, row-major
/// [node][node], one copy for all components; Dφ = V·∇φ.
struct Convection {
  std::vector<double> gyroscopic;  ///< ∫ ρ ((Dφⱼ) φᵢ − (Dφᵢ) φⱼ), kg/s: 2 ∫ ρ (Dφⱼ) φᵢ where no
                                   ///< matter crosses the surface
  std::vector<double> rotationStiffness;  ///< −∫ ρ (Dφⱼ)(Dφᵢ), N/m
  std::vector<double> flux;       ///< ∫ Dφᵢ, m³/s, [node]; summed over a body: ∮ φᵢ V·n
  std::vector<double> fluxScale;  ///< ∫ |Dφᵢ|, m³/s, [node]
};
/// `velocity`: V at the nodes; affine in x, so the shape functions interpolate it exactly.
Convection convection(const ShapeTable& table, const std::vector<Point>& nodes,
                      const std::vector<Point>& velocity, double density);

/// ∫ φᵢ n dA on a face (line in the plane), [node][3]; n along the normal by node order times
/// `sign`.
std::vector<double> faceNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);
/// ∫ φᵢ φⱼ dA on a face, row-major [node][node].
std::vector<double> faceMass(const ShapeTable& table, const std::vector<Point>& nodes);
/// Derivative of each shape function along the velocity at each node of the face, [at
/// node][function], 1/s for velocities in m/s. Only the part of `velocity` in the plane of the face
/// counts.
std::vector<double> faceDerivative(const ShapeTable& table, const std::vector<Point>& nodes,
                                   const std::vector<Point>& velocity);
/// Unit normal of the face at each of its nodes, by node order times `sign`, [node][3].
std::vector<Point> nodeNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);

}  // namespace squeal::elasticity
