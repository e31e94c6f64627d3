// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The direct method: the eigenproblem in all unknowns, without reduction.
#include "eigen/direct/settings.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::direct {

/// Collective. Solves the problem in all unknowns by SLEPc with shift-and-invert at zero. Returns
/// the `count` eigenvalues nearest to zero, and all others with the same |s| as the last one. With
/// a band, returns its eigenvalues (low ≤ Im s ≤ high, |s| ≤ high) among the `limit` ones nearest
/// to zero; none is missing up to |s| = ComplexModes::coveredTo. `trial` is the matrix T, N×n, that
/// maps shapes to nodal displacements. Throws Error if the solver does not converge.
pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial, const Settings& settings);

}  // namespace squeal::direct
