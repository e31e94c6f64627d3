// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Existence and uniqueness of the steady sliding state for all loads (paper, section 3), from the
/// condensed matrix A(f) of g = A(f) R + F. Exactly one solution exists if sym(A) is positive
/// definite or A is a P-matrix; at least one exists if A is strictly copositive.
#include <vector>

#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "steady/uniqueness/positivity.hpp"
#include "steady/uniqueness/settings.hpp"

namespace squeal::uniqueness {

/// The result of the examination at one speed.
struct Uniqueness {
  std::vector<Judgement> judgements;  ///< [friction]
  /// Friction at which sym(A) ceases to be positive definite; infinite if it never does, NaN if
  /// unknown.
  double lostAt = 0;
};

/// Collective. Examines the problem at the speed factor v, with K + v² K^R and the slip of
/// w = −v V, at all `frictions`. A is formed for up to -steady_uniqueness_dense contact nodes. With
/// more nodes, SLEPc finds `lostAt` by solves with the stiffness of the open and of the closed
/// contact, and the eigenvalues of sym(A) remain unknown. If A does not exist or the tests are
/// inconclusive, the verdict is "not decided", with the reason. Throws Error for an unknown
/// -steady_uniqueness_* option, and if LAPACK fails.
Uniqueness examine(const elasticity::Bodies& bodies, const contact::Contact& contact, double speed,
                   const std::vector<double>& frictions, const Settings& settings);

}  // namespace squeal::uniqueness
