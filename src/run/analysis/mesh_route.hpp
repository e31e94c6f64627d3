#pragma once
/// This route leads from a mesh to eigenvalues: mesh, elasticity, contact, steady sliding, and for
/// each active set its modes and flutter.
#include "model/mesh/mesh.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::analysis {

/// Returns the groups and interfaces that the options of all stages ask of the mesh.
mesh::Request meshRequest();

/// Collective. Adds to the analysis the mesh, the matrices of the bodies and contact, checked
/// against its sweep. Throws Error as these stages and the checks do.
void prepareMesh(Analysis& analysis);

/// Collective. Adds the steady states, the results on their uniqueness, and for each active set its
/// modes and flutter at the points that share it. A point without a steady solution gives a warning
/// and has no modes.
void solveMesh(Analysis& analysis);

}  // namespace squeal::analysis
