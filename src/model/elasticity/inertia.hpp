// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Inertia of one element: its mass, its centrifugal forces and the convective terms of matter that
/// moves through it, as small dense arrays from coordinates and density. mass() and convection()
/// throw InvertedElement. Not collective.
#include <vector>

#include "model/elasticity/motion.hpp"
#include "model/elasticity/settings.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

using element::ShapeTable;
using mesh::Point;

/// Returns the mass
///   m_ij = ∫ ρ φᵢ φⱼ,
/// positive definite, row-major [node][node], kg, the same for all components.
/// MassKind::higherOrder selects the mean of the consistent matrix and a diagonal matrix of the
/// same total mass (diagonal scaling of Hinton, Rock and Zienkiewicz 1976; row sums on linear
/// elements).
std::vector<double> mass(const ShapeTable& table, const std::vector<Point>& nodes, double density,
                         MassKind kind);

/// Returns the centrifugal forces of a rotation [M.4],
///   ∫ φᵢ ρ ω² r,
/// [node][3], N. r is the vector to a point from the nearest point of the axis.
std::vector<double> centrifugal(const ShapeTable& table, const std::vector<Point>& nodes,
                                double density, const Motion& motion);

/// The convective terms of matter that moves through the element with the velocity V, with Dφ =
/// V·∇φ. Matrices are row-major [node][node], the same for all components.
struct Convection {
  std::vector<double> gyroscopic;  ///< ∫ ρ ((Dφⱼ) φᵢ − (Dφᵢ) φⱼ), kg/s; equal to 2 ∫ ρ (Dφⱼ) φᵢ
                                   ///< if no matter crosses the surface
  std::vector<double> rotationStiffness;  ///< −∫ ρ (Dφⱼ)(Dφᵢ), N/m
  std::vector<double> flux;       ///< ∫ Dφᵢ, m³/s, [node]; summed over a body: ∮ φᵢ V·n
  std::vector<double> fluxScale;  ///< ∫ |Dφᵢ|, m³/s, [node]
};
/// Returns the convective terms. `velocity` is V at the nodes, m/s. V is affine in x, so the shape
/// functions interpolate it exactly.
Convection convection(const ShapeTable& table, const std::vector<Point>& nodes,
                      const std::vector<Point>& velocity, double density);

}  // namespace squeal::elasticity
