// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The quality of the cells.
#include <vector>

#include "run/audit/finding.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// A cell and a measure of it.
struct WorstCell {
  double value = 0;
  PetscInt tag = 0;     ///< in gmsh
  int type = 0;         ///< in gmsh
  mesh::Point place{};  ///< mean of its nodes, m
};

/// The quality of the cells of one body.
struct CellQuality {
  WorstCell jacobian;   ///< smallest det J / largest det J of the same cell
  WorstCell aspect;     ///< largest condition number ‖J‖ ‖J⁻¹‖ / dimension; 1 for a cube
  PetscInt folded = 0;  ///< number of cells with a ratio below `smallestRatio`
  PetscInt elongated = 0;  ///< number with a condition number above `largestAspect`
};
constexpr double smallestRatio = 0.1, largestAspect = 100;

/// Collective. Returns the quality of the cells, [body].
std::vector<CellQuality> cellQuality(const mesh::Mesh& mesh);

/// Collective. Returns findings on distorted cells, and on linear cells of nearly incompressible
/// materials.
Findings cellFindings(const Subject& model, const std::vector<CellQuality>& quality);

}  // namespace squeal::audit
