// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The associated system of a problem from files: K0 and M0, the sums of the terms without
/// exponents.
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "problem/matrices/matrices.hpp"

namespace squeal::matrices {

/// The associated system: the sums of the stiffness and of the mass terms without exponents of
/// friction, speed and damping, except terms marked as friction. If such a stiffness contains
/// unmarked friction, the friction stays in the pencil.
struct SymmetricPart {
  factor::AssociatedSystem system;  ///< K0 is the symmetric part of the sum
  double asymmetry;   ///< ‖K − Kᵀ‖ / ‖K‖ of the sum; 0 if it is 1e-10 or less
  PetscInt massless;  ///< number of unknowns without mass
};

/// Collective. Returns (A + Aᵀ)/2, marked as symmetric.
OwnedMat symmetrised(Mat matrix);

/// Collective. Returns the associated system of the terms. Throws Error, naming the matrices, if
/// there is no such stiffness or mass, if the mass is not symmetric to 1e-10, and if the stiffness,
/// or the mass without its rows of zeros, is not positive definite within round-off, as with a
/// rigid-body mode. The stiffness determines unknowns without mass, such as reference nodes.
SymmetricPart symmetricPart(const std::vector<NamedTerm>& terms);

}  // namespace squeal::matrices
