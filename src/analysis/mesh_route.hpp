#pragma once
/// From a mesh to eigenvalues: mesh, elasticity, contact, steady sliding, and for each active set
/// its modes and flutter.
#include "analysis/analysis.hpp"
#include "mesh/mesh.hpp"

namespace squeal::analysis {

/// Returns the groups and interfaces that the options of all stages ask of the mesh.
mesh::Request meshRequest();

/// Collective. Adds to the analysis the mesh, the matrices of the bodies and contact, checked
/// against its sweep.
void prepareMesh(Analysis& analysis);

/// Collective. Adds the steady states, what is known of their uniqueness, and for each active set
/// its modes and flutter at the points that share it.
void solveMesh(Analysis& analysis);

}  // namespace squeal::analysis
