// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Continuation of tracked eigenvalues from one basis to the next.
#include "eigen/stability/followed.hpp"

namespace squeal::stability {

/// Not collective. Adds `later`, tracked in another basis, to `earlier`, which has the same speed,
/// pressure and damping and lower frictions. If `later` continues a line and begins at the last
/// friction of `earlier`, its branches get the numbers of those of `earlier` that have the same
/// eigenvalues there; the others get new numbers. Differences between the two bases become gaps: an
/// eigenvalue in both bands that only one basis has, and a different stability. Eigenvalues too
/// close to be distinguished become a gap in their identity. Otherwise the part between the two
/// lines is a gap, all branches of `later` get new numbers, and what it contains below its first
/// swept friction is omitted. If `earlier` has no result, `later` replaces it.
void append(TrackedLine& earlier, TrackedLine later);

/// Not collective. If the line was to continue another one, which has no result, and does not begin
/// at friction 0, adds a gap below its first friction.
void nameMissingStart(TrackedLine& line);

/// Not collective. If the line was to be continued and was not, adds a gap up to this friction.
void nameMissingEnd(TrackedLine& line, double last);

}  // namespace squeal::stability
