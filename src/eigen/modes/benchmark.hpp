#pragma once
/// This file measures the least time that the free-vibration stage could take.
#include "base/petsc/owned.hpp"

namespace squeal::modes {

/// Returns the option `-modes_benchmark`.
bool benchmarkWanted();

/// Collective. Returns the wall time, s, of one factorisation of K0, which is `stiffness`, by MUMPS
/// and of 400 solves with it in blocks of 32, on the slowest rank.
double floorSeconds(Mat stiffness);

}  // namespace squeal::modes
