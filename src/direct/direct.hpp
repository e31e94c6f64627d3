#pragma once
/// The eigenproblem on all unknowns, without reduction.
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sweep/parameters.hpp"

namespace squeal::direct {

/// `-flutter_method`: true for the direct solve on all unknowns.
bool directWanted();

/// Collective. Error for -flutter_eps_*, -flutter_pep_* and -flutter_st_* options where the direct
/// method, which alone uses them, is not asked for.
void rejectIdleSolverOptions();

/// Collective. Eigenvalues of the problem on all unknowns, without reduction, by SLEPc with
/// shift-and-invert at zero: the
/// `-flutter_direct_count` nearest to zero, or all of `-flutter_direct_band` (low ≤ Im s ≤ high,
/// |s| ≤ high), as far as
/// `-flutter_direct_limit` of them reach. Error: a band that is none; not converged.
pencil::FrictionPoint solveDirect(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                  Mat trial);

}  // namespace squeal::direct
