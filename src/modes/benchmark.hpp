#pragma once
/// The least time that the free-vibration stage could take.
#include "petsc/owned.hpp"

namespace squeal::modes {

/// `-modes_benchmark`.
bool benchmarkWanted();

/// Collective. Wall time of one factorisation of K0 and 400 solves in blocks of 32 with it, s.
double floorSeconds(Mat stiffness);

}  // namespace squeal::modes
