// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Vibrations of a meshed brake about its states of steady sliding.
#include "base/checkpoint/checkpoint.hpp"
#include "eigen/sweep_solver/sweep_solver.hpp"
#include "run/analysis/flutter.hpp"
#include "run/analysis/sliding_brake.hpp"

namespace squeal::analysis {

/// Collective. Returns the eigenvalues at all points of the sweep that have a steady state, the
/// onsets of their unstable modes, and the motions after flutter. The points are treated in groups
/// (mesh_sweep.hpp). A group that fails does not affect the others. Throws Error if all groups
/// fail.
Flutter meshFlutter(const SlidingBrake& brake, const sweep_solver::Request& request,
                    checkpoint::Checkpoint& checkpoint, CurrentSystem& current);

}  // namespace squeal::analysis
