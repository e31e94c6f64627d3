// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Hourglass modes of hex20 cells with reduced integration: motions without strain at the 2×2×2
/// points of the rule that are not rigid.
#include <array>
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// Collective. Throws Error for a material group with reduced integration that has other cells than
/// hex20.
void requireHex20(const mesh::Mesh& mesh, const std::vector<material::Material>& materials);

/// A cell with reduced integration of any rank that has no edge inside the bodies.
struct ExposedCell {
  PetscInt tag;                   ///< gmsh's
  int material, part;             ///< index into Mesh::materialGroups, connected part
  std::array<PetscInt, 20> node;  ///< global nodes, in gmsh's order
  std::array<mesh::Point, 20> point;
};
/// Collective. Returns the exposed cells of all ranks, by material group and tag; none without
/// reduced integration. The cells around an edge inside a body prevent each other's hourglass
/// modes: the only motions of these cells together without strain are rigid. Cells in a row do not
/// prevent them, nor do the cells of an L.
std::vector<ExposedCell> exposedCells(const mesh::Mesh& mesh,
                                      const std::vector<material::Material>& materials);
/// Collective. Warns of each material group with such cells.
void warnOfHourglass(const mesh::Mesh& mesh, std::span<const ExposedCell> cells);

/// The motions of a cell without strain at the points of the reduced rule.
inline constexpr int strainlessMotions = 12;
/// Not collective. Returns these motions as orthogonal columns, rows [node][component], each with a
/// mean square of 1 per node: the rigid motions and the hourglass modes, mixed.
linalg::DenseMatrix strainlessBasis(const ExposedCell& cell);

}  // namespace squeal::elasticity
