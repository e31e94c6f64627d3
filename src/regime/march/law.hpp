// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds on friction laws for a massless boundary, on which friction that depends on the sliding
/// speed acts at once.
#include <vector>

#include "regime/march/model.hpp"

namespace squeal::march {

/// Not collective. Returns μ [M.79], the largest eigenvalue of
///   −(h K_z + C_z)⁻¹ B   and   (h K_z/2 + C_z)⁻¹ B,   B = R_N df/d|w| ττᵀ,
/// in the rows that are free in steady sliding, from slopes df/d|w|, [node], s/m. The slips of the
/// massless boundary follow a coefficient that is a step old without growing if μ < 1. With h = 0
/// it is the ratio of a falling law to the damping; infinite without damping.
double lawGain(const ReducedModel& model, double h, const std::vector<double>& slopes);

/// Returns the slopes of the coefficients in steady sliding, [node].
std::vector<double> steadySlopes(const ReducedModel& model);
/// Returns the steepest slopes between rest and twice the speed of steady sliding: the lowest ones,
/// or the highest.
std::vector<double> steepestSlopes(const ReducedModel& model, bool lowest);

}  // namespace squeal::march
