// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The friction terms as products of few rows.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"

namespace squeal::completeness {

/// The slip rows of the friction terms with one power of the swept friction.
struct SlipRows {
  int frictionExponent;  ///< a
  OwnedMat rows;         ///< S_a, r × n
};

/// The friction terms of the points of a sweep,
///   Σ_a f^a S_aᵀ (N_0 + s² N_2),
/// with a row for each of the r contact nodes that slide at any point, over all ranks. An active
/// set has some of the rows.
struct FrictionFactors {
  std::vector<SlipRows> slip;
  OwnedMat normal;   ///< N_0 = N K T, r × n: the normal forces of the stiffness
  OwnedMat inertia;  ///< N_2 = N M T, r × n: those of the mass
  std::vector<std::vector<PetscInt>>
      rowsOf;           ///< [range] its rows, ascending, the same on all ranks
  std::string missing;  ///< why the factors are not known; empty if they are
};

}  // namespace squeal::completeness
