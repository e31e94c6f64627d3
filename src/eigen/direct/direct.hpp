// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The direct method solves the eigenproblem on all unknowns, without reduction.
#include "eigen/direct/settings.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::direct {

/// Collective. Solves the problem on all unknowns by SLEPc with shift-and-invert at zero. Returns
/// the `count` eigenvalues nearest to zero, with others that are as near as the last of them, or
/// all in the band (low ≤ Im s ≤ high, |s| ≤ high) that `limit` of them reach:
/// ComplexModes::coveredTo. `trial` is T, N×n, for the shapes. Throws Error if the solver does not
/// converge.
pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial, const Settings& settings);

}  // namespace squeal::direct
