#pragma once
/// Existence and uniqueness of the steady sliding state (paper, section 3), whatever the loads:
/// what the condensed matrix A(f) of g = A(f) R + F says. sym(A) positive definite, or A a
/// P-matrix: one solution; A strictly copositive: a solution exists.
#include <vector>

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "steady/positivity.hpp"

namespace squeal::steady {

struct Uniqueness {
  std::vector<Judgement> judgements;  ///< [friction]
  /// Friction from which sym(A) is not positive definite; infinite: never; NaN: unknown
  double lostAt = 0;
};

/// -steady_uniqueness: the examination is wanted.
bool uniquenessWanted();

/// Collective. With K + v² K^R and the slip of w = −v V at the speed factor v.
/// A is formed up to -steady_uniqueness_dense contact nodes; beyond, SLEPc finds `lostAt` by solves
/// with the open and with the closed contact's stiffness, and no eigenvalue of sym(A) is known.
/// Where A does not exist, or says nothing, the verdict is "not decided" and the reason says why.
/// Error: an unknown -steady_uniqueness_* option.
Uniqueness examine(const elasticity::Bodies& bodies, const contact::Contact& contact, double speed,
                   const std::vector<double>& frictions);

}  // namespace squeal::steady
