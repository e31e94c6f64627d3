#pragma once
/// Element matrices: coordinates and material go in, small dense arrays come out. No PETSc object
/// is used here. Not collective.
#include <vector>

#include "elasticity/hooke.hpp"
#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"

namespace squeal::elasticity {

/// Thrown by the routines below where det J ≤ 0 at a point of their quadrature rule, and by mass()
/// where the matrix is not positive definite.
struct InvertedElement {};

/// Returns true if det J ≤ 0 at a point of the rule. Such a cell can still be used where the
/// smallest rule for the stiffness has no such point: terms with J⁻¹ take that rule, loads are
/// polynomials and are integrated as usual, and the mass has the true volume.
bool folded(const ShapeTable& table, const std::vector<Point>& nodes);
/// Returns the table of a cell for terms with J⁻¹: the given one, or that for the stiffness if the
/// cell is folded.
const ShapeTable& gradientTable(const ShapeTable& table, const std::vector<Point>& nodes);

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

enum class MassKind { consistent, higherOrder };
/// Returns the mass
///   m_ij = ∫ ρ φᵢ φⱼ,
/// positive definite, row-major [node][node], kg, the same for all components. `higherOrder` is the
/// mean of the consistent matrix and the diagonal one of the same total (diagonal scaling of
/// Hinton, Rock and Zienkiewicz 1976, row sums on linear elements).
std::vector<double> mass(const ShapeTable& table, const std::vector<Point>& nodes, double density,
                         MassKind kind);

/// Returns the centrifugal forces [M.4]
///   ∫ φᵢ ρ ω² r,
/// [node][3], N, for the `speed` ω, rad/s, about the `axis`, a unit vector, through `origin`.
std::vector<double> centrifugal(const ShapeTable& table, const std::vector<Point>& nodes,
                                double density, double speed, const Point& axis,
                                const Point& origin);

/// Convective terms of matter that moves through the element with the velocity V, with Dφ = V·∇φ.
/// Matrices are row-major [node][node], the same for all components.
struct Convection {
  std::vector<double> gyroscopic;  ///< ∫ ρ ((Dφⱼ) φᵢ − (Dφᵢ) φⱼ), kg/s; equal to 2 ∫ ρ (Dφⱼ) φᵢ
                                   ///< where no matter crosses the surface
  std::vector<double> rotationStiffness;  ///< −∫ ρ (Dφⱼ)(Dφᵢ), N/m
  std::vector<double> flux;       ///< ∫ Dφᵢ, m³/s, [node]; summed over a body: ∮ φᵢ V·n
  std::vector<double> fluxScale;  ///< ∫ |Dφᵢ|, m³/s, [node]
};
/// Returns the convective terms. `velocity` is V at the nodes, m/s. It is affine in x, so that the
/// shape functions interpolate it exactly.
Convection convection(const ShapeTable& table, const std::vector<Point>& nodes,
                      const std::vector<Point>& velocity, double density);

/// Returns ∫ φᵢ n dA on a face (a line in the plane), [node][3], m². The unit normal n is that of
/// the node order times `sign`.
std::vector<double> faceNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);
/// Returns ∫ φᵢ φⱼ dA on a face, row-major [node][node], m².
std::vector<double> faceMass(const ShapeTable& table, const std::vector<Point>& nodes);
/// Returns the derivative of each shape function along the velocity at each node of the face,
/// [at node][function], 1/s for velocities in m/s. Only the part of `velocity` in the tangent plane
/// of the face counts.
std::vector<double> faceDerivative(const ShapeTable& table, const std::vector<Point>& nodes,
                                   const std::vector<Point>& velocity);
/// Returns the unit normal of the face at each of its nodes, that of the node order times `sign`,
/// [node].
std::vector<Point> nodeNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);

}  // namespace squeal::elasticity
