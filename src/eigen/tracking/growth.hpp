// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Signs of growth rates, and their changes over the friction.
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::tracking {

/// Returns the sign of Re s; 0 for a neutral eigenvalue.
int sign(Complex s, bool damped);
/// Returns the sign of the growth of pair k. Where all are equal, it is that of their mean:
/// round-off splits them like a square root.
int growthOf(const std::vector<linalg::DensePair>& pairs, std::size_t k, bool damped);
/// Returns true if one of both signs of the growth is that of an unstable eigenvalue.
bool changes(int before, int after);
/// Returns true if equal eigenvalues s may split there into a growing and a decaying one: they are
/// neutral or, in a problem in s², real.
bool meetingPoint(Complex s, bool damped);
/// Returns the number of unstable eigenvalues.
int unstable(const std::vector<linalg::DensePair>& pairs, bool damped);

}  // namespace squeal::tracking
