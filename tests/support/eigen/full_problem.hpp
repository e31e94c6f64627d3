// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small problems of finite elements as dense ones with all unknowns.
#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/pencil.hpp"
#include "support/algebra/sparse.hpp"

namespace squeal::test {

/// Collective. Returns the sum of the terms with this power of s, with all entries on every rank;
/// empty if there are none.
inline linalg::DenseMatrix fullMatrix(const pencil::Pencil& pencil, int power,
                                      const sweep::Parameters& at) {
  return pencil.hasPower(power) ? denseCopy(pencil.assembled(power, at)) : linalg::DenseMatrix();
}

/// Collective. Returns the problem of all unknowns at one point of the sweep.
inline linalg::DenseProblem fullProblem(const pencil::Pencil& pencil, const sweep::Parameters& at) {
  return {fullMatrix(pencil, 2, at), fullMatrix(pencil, 1, at), fullMatrix(pencil, 0, at)};
}

}  // namespace squeal::test
