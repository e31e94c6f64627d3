// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds on friction laws for a massless boundary, which responds immediately to friction that
/// depends on the sliding speed.
#include <vector>

#include "regime/march/model.hpp"

namespace squeal::march {

/// Not collective. Returns μ [M.79], the largest eigenvalue of
///   −(h K_z + C_z)⁻¹ B   and   (h K_z/2 + C_z)⁻¹ B,   B = R_N df/d|w| ττᵀ,
/// in the rows that are free in steady sliding, from slopes df/d|w|, [node], s/m. If μ < 1, the
/// slips of the massless boundary do not grow although the coefficient is one step old. With h = 0,
/// μ is the ratio of the slope of a falling law to the damping; infinite without damping.
double lawGain(const ReducedModel& model, double h, const std::vector<double>& slopes);

/// Returns the slopes of the coefficients in steady sliding, [node].
std::vector<double> steadySlopes(const ReducedModel& model);
/// Returns the steepest slopes between rest and twice the speed of steady sliding: the lowest or
/// the highest ones.
std::vector<double> steepestSlopes(const ReducedModel& model, bool lowest);

}  // namespace squeal::march
