// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Signs of growth rates, and their changes as the friction changes.
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"

namespace squeal::tracking {

/// Returns the sign of Re s; 0 for a neutral eigenvalue.
int sign(Complex s, bool damped);
/// Returns the sign of the growth of pair k. If all eigenvalues are equal, it is the sign for their
/// mean, since a round-off δ separates equal eigenvalues by about √δ.
int growthOf(const std::vector<linalg::DensePair>& pairs, std::size_t k, bool damped);
/// Returns true if the problem at one of the two ends of a step has a term in s. That at friction 0
/// may have none although the system is damped: if only friction damps it.
bool damped(const linalg::Spectrum& low, const linalg::Spectrum& high);
/// Returns true if exactly one of these two signs is that of an unstable eigenvalue.
bool changes(int before, int after);
/// Returns true if two eigenvalues equal to s may split into a growing and a decaying one: if s is
/// neutral or, in a problem in s², real.
bool meetingPoint(Complex s, bool damped);
/// Returns the number of unstable eigenvalues.
int unstable(const std::vector<linalg::DensePair>& pairs, bool damped);

}  // namespace squeal::tracking
