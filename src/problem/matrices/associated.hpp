// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The associated system of a problem from files: K0 and M0, the sums of the terms without
/// exponents.
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "problem/matrices/matrices.hpp"

namespace squeal::matrices {

/// The associated system. K0 and M0 are the sums of the stiffness and of the mass terms without
/// exponents of friction, speed and damping, except terms marked as friction. If a stiffness among
/// them contains unmarked friction, K0 takes only the symmetric part of the sum; the pencil keeps
/// all of it.
struct SymmetricPart {
  factor::AssociatedSystem system;  ///< K0 is the symmetric part of the stiffness sum
  double asymmetry;   ///< ‖K − Kᵀ‖ / ‖K‖ of this sum K; 0 if it is 1e-10 or less
  PetscInt massless;  ///< number of unknowns without mass
};

/// Collective. Returns (A + Aᵀ)/2, marked as symmetric.
OwnedMat symmetrised(Mat matrix);

/// Collective. Returns the associated system of the terms. Rows of zeros in the mass are accepted:
/// they belong to unknowns without mass, such as reference nodes, which the stiffness determines.
/// Throws Error, naming the matrices, in three cases: the stiffness or the mass without exponents
/// is missing; the mass is not symmetric to 1e-10; K0, or M0 without its rows of zeros, is not
/// positive definite within round-off (K0 is not if a body has a rigid-body mode).
SymmetricPart symmetricPart(const std::vector<NamedTerm>& terms);

}  // namespace squeal::matrices
