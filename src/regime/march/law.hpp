// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds on friction laws for a massless boundary. Such a boundary responds without delay to
/// friction that depends on the sliding speed.
#include <vector>

#include "regime/march/model.hpp"

namespace squeal::march {

/// Not collective. Returns μ [M.79], the largest eigenvalue of
///   −(h K_z + C_z)⁻¹ B   and   (h K_z/2 + C_z)⁻¹ B,   B = R_N df/d|w| ττᵀ,
/// in the rows that are free in steady sliding. `slopes` are df/d|w|, [node], s/m, and h is the
/// time step, s. Each step uses the coefficient of friction at the speed of the previous step. Even
/// so, the slips of the massless boundary do not grow if μ < 1. With h = 0, only the first matrix
/// is used: μ is then the ratio of the slope of a falling law to the damping, and infinite without
/// damping.
double lawGain(const ReducedModel& model, double h, const std::vector<double>& slopes);

/// Returns the slopes df/d|w| in steady sliding, [node].
std::vector<double> steadySlopes(const ReducedModel& model);
/// Returns the extreme slopes df/d|w| between rest and twice the speed of steady sliding, [node]:
/// the lowest ones, at most 0, if `lowest`; otherwise the highest ones, at least 0.
std::vector<double> steepestSlopes(const ReducedModel& model, bool lowest);

}  // namespace squeal::march
