#pragma once
/// Element matrices: coordinates and material in, small dense arrays out. No PETSc object is seen here. Not collective.
#include <array>
#include <vector>

#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"

namespace squeal::elasticity {

using mesh::Point;

/// Hooke's law σ = D ε with engineering shear strains; row-major, 3×3 (xx, yy, xy) or 6×6 (xx, yy, zz, xy, yz, zx), Pa.
struct Hooke {
  int size = 6;
  std::vector<double> matrix;
};
Hooke isotropic(double young, double poisson, int dimension, bool planeStress);

/// Thrown by the routines below where det J ≤ 0 at a quadrature point.
struct InvertedElement {};

/// K_ij = ∫ Bᵢᵀ D Bⱼ, row-major, rows and columns [node][component], N/m (per unit thickness in the plane).
/// `incompatible` (quad4, hex8): quadratic bubble modes of Taylor, Beresford and Wilson (1976), condensed; they pass the patch
/// test.
std::vector<double> stiffness(const ShapeTable& table, const std::vector<Point>& nodes, const Hooke& hooke, bool incompatible);

enum class MassKind { consistent, higherOrder };
/// m_ij = ∫ ρ φᵢ φⱼ, row-major [node][node], kg, one copy for all components. Higher order: the mean of the consistent matrix and
/// the diagonal one with the same total (diagonal scaling of Hinton, Rock and Zienkiewicz 1976, row sums on linear elements).
std::vector<double> mass(const ShapeTable& table, const std::vector<Point>& nodes, double density, MassKind kind);

/// ∫ φᵢ ρ ω² r, [node][3], N: centrifugal force for the squared speed ω² about the axis (unit vector) through `origin`.
std::vector<double> centrifugal(const ShapeTable& table, const std::vector<Point>& nodes, double density, double speed,
                                const Point& axis, const Point& origin);

/// ∫ φᵢ n dA on a face (line in the plane), [node][3]; n along the normal by node order times `sign`.
std::vector<double> faceNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);
/// ∫ φᵢ φⱼ dA on a face, row-major [node][node].
std::vector<double> faceMass(const ShapeTable& table, const std::vector<Point>& nodes);
/// Unit normal of the face at each of its nodes, by node order times `sign`, [node][3].
std::vector<Point> nodeNormals(const ShapeTable& table, const std::vector<Point>& nodes, int sign);

}  // namespace squeal::elasticity
