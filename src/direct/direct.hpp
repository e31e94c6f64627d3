#pragma once
/// The direct method: the eigenproblem on all unknowns, without reduction.
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sweep/parameters.hpp"

namespace squeal::direct {

/// Returns true if `-flutter_method` asks for the direct method.
bool directWanted();

/// Throws Error for -flutter_eps_*, -flutter_pep_* and -flutter_st_* options if the direct method,
/// which alone uses them, is not asked for.
void rejectIdleSolverOptions();

/// Collective. Solves the problem on all unknowns by SLEPc with shift-and-invert at zero. Returns
/// the `-flutter_direct_count` eigenvalues nearest to zero, or all in `-flutter_direct_band` (low ≤
/// Im s ≤ high, |s| ≤ high) that `-flutter_direct_limit` of them reach. `trial` is T. Throws Error
/// if the band is not two ascending frequencies, or if the solver does not converge.
pencil::ComplexModes solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                 Mat trial);

}  // namespace squeal::direct
