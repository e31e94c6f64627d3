// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// This route leads from a mesh to eigenvalues: mesh, elasticity, contact, steady sliding, and for
/// each active set its modes and flutter.
#include "run/analysis/analysis.hpp"

namespace squeal::analysis {

/// Collective. Adds to the analysis the mesh, the matrices of the bodies and contact, checked
/// against its sweep. Throws Error as these stages and the checks do.
void prepareMesh(Analysis& analysis);

/// Collective. Adds the steady states, the results on their uniqueness, and for each active set its
/// modes and flutter at the points that share it. A point without a steady solution gives a warning
/// and has no modes.
void solveMesh(Analysis& analysis);

}  // namespace squeal::analysis
