#pragma once
/// This file makes the associated system of a problem from files: K0 and M0 are sums of the terms
/// without exponents.
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "problem/matrices/matrices.hpp"

namespace squeal::matrices {

/// The associated system is made of the sums of the stiffness and of the mass terms without
/// exponents of friction, speed and damping, but for terms marked as friction. The friction that
/// such a stiffness may hold all the same stays in the pencil.
struct SymmetricPart {
  factor::AssociatedSystem system;  ///< K0 is the symmetric part of the sum
  double asymmetry;  ///< ‖K − Kᵀ‖ / ‖K‖ of the sum; 0 if it is 1e-10 or less
};

/// Collective. Returns the associated system of the terms. Throws Error, naming matrices, if there
/// is no such term of the stiffness or of the mass, if the mass is not symmetric to 1e-10, and if
/// the mass or the stiffness is not positive definite to within rounding, as with massless unknowns
/// or a loose body.
SymmetricPart symmetricPart(const std::vector<NamedTerm>& terms);

}  // namespace squeal::matrices
