// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Mass, centre and inertia of the bodies.
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

using mesh::Matrix3;
using mesh::Point;

/// The mass of one body, or of all; in plane problems per unit thickness.
struct BodyMass {
  std::string body;
  PetscInt cells = 0;
  double volume = 0;    ///< m³ (m² in plane problems)
  double mass = 0;      ///< kg (kg/m in plane problems)
  Point centre{};       ///< centre of mass, m
  Matrix3 inertia{};    ///< ∫ ρ (|r|² 1 − r rᵀ), r = x − centre, kg·m² (plane: kg·m)
  Point low{}, high{};  ///< corners of the bounding box of the nodes, m
};

/// Collective. Returns the masses, [body], computed by the quadrature rules of the mass matrix.
/// They are exact within round-off if the edges of the cells are straight and opposite faces of
/// hexahedra and wedges are parallel.
std::vector<BodyMass> bodyMasses(const Subject& model);
/// Collective. Returns the point masses, sorted by group, with the names "mass of 'GROUP'".
std::vector<BodyMass> pointMasses(const Subject& model);
/// Not collective. Returns the sum over the bodies, with the name "total".
BodyMass totalOf(const std::vector<BodyMass>& bodies);
/// Not collective. Returns the sum over the bodies with these indices.
BodyMass totalOf(const std::vector<BodyMass>& bodies, const std::vector<int>& which);

}  // namespace squeal::audit
