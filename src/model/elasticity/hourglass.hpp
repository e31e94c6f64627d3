// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Hourglass modes of hex20 cells with reduced integration: motions that are not rigid but have no
/// strain at the 2×2×2 points of the rule.
#include <array>
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// Collective. Throws Error for a material group with reduced integration that has cells other than
/// hex20.
void requireHex20(const mesh::Mesh& mesh, const std::vector<material::Material>& materials);

/// A cell with reduced integration, on any rank, that has no edge in the interior of a body.
struct ExposedCell {
  PetscInt tag;                   ///< gmsh's element tag
  int material, part;             ///< index into Mesh::materialGroups, connected part
  std::array<PetscInt, 20> node;  ///< global nodes, in gmsh's order
  std::array<mesh::Point, 20> point;
};
/// Collective. Returns the exposed cells of all ranks, by material group and tag; none without
/// reduced integration. The cells around an edge in the interior prevent each other's hourglass
/// modes: together they have no motions without strain except rigid ones. Cells in a row, or in the
/// shape of an L, do not prevent hourglass modes.
std::vector<ExposedCell> exposedCells(const mesh::Mesh& mesh,
                                      const std::vector<material::Material>& materials);
/// Collective. Warns of each material group with exposed cells.
void warnOfHourglass(const mesh::Mesh& mesh, std::span<const ExposedCell> cells);

/// The number of independent motions of a cell that cause no strain at the points of the reduced
/// rule.
inline constexpr int strainlessMotions = 12;
/// Not collective. Returns these motions as orthogonal columns, rows [node][component], each with a
/// mean square of 1 per node: the rigid motions and the hourglass modes, mixed.
linalg::DenseMatrix strainlessBasis(const ExposedCell& cell);

}  // namespace squeal::elasticity
