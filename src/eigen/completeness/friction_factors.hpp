// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The friction terms as products of matrices with few rows.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"

namespace squeal::completeness {

/// The matrix S_a of the friction terms with the power f^a of the swept friction f. Its rows, the
/// slip rows, give the motion of contact nodes along the slip, times the coefficient of f^a.
struct SlipRows {
  int frictionExponent;  ///< a
  OwnedMat rows;         ///< S_a, r × n
};

/// The friction terms of the points of a sweep,
///   Σ_a f^a S_aᵀ (N_0 + s² N_2).
/// Each matrix has one row for each of the r contact nodes, on all ranks together, that slide at
/// any point of the sweep. An active set uses some of these rows.
struct FrictionFactors {
  std::vector<SlipRows> slip;
  OwnedMat normal;   ///< N_0 = N K T, r × n: normal forces due to the stiffness
  OwnedMat inertia;  ///< N_2 = N M T, r × n: normal forces due to the mass
  std::vector<std::vector<PetscInt>>
      rowsOf;  ///< [range of points with one active set] rows used, ascending; same on all ranks
  std::string missing;  ///< why the factors are not known; empty if they are
};

}  // namespace squeal::completeness
