// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Signs of growth rates, and their changes over the friction.
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::tracking {

/// Returns the sign of Re s; 0 for a neutral eigenvalue.
int sign(Complex s, bool damped);
/// Returns the sign of the growth of pair k. If all pairs are equal, it is the sign of their mean,
/// since round-off splits equal eigenvalues like a square root.
int growthOf(const std::vector<linalg::DensePair>& pairs, std::size_t k, bool damped);
/// Returns true if exactly one of the two signs of growth is unstable.
bool changes(int before, int after);
/// Returns true if equal eigenvalues s may split into a growing and a decaying one: they are
/// neutral or, in a problem in s², real.
bool meetingPoint(Complex s, bool damped);
/// Returns the number of unstable eigenvalues.
int unstable(const std::vector<linalg::DensePair>& pairs, bool damped);

}  // namespace squeal::tracking
