#pragma once
/// Friction that depends on the sliding speed acts on a boundary without mass at once. This file
/// tells whether a march can follow it.
#include <vector>

#include "regime/march/model.hpp"

namespace squeal::march {

/// Not collective. Returns μ [M.79], the largest eigenvalue of
///   −(h K_z + C_z)⁻¹ B   and   (h K_z/2 + C_z)⁻¹ B,   B = R_N df/d|w| ττᵀ,
/// in the rows that are free in steady sliding, from slopes df/d|w|, [node], s/m. The slips of the
/// massless boundary follow a coefficient that is a step old without growing where μ < 1. Without
/// a step, h = 0, this is what its damping holds of a law that falls; infinite without damping.
double lawGain(const ReducedModel& model, double h, const std::vector<double>& slopes);

/// Returns the slopes of the coefficients in steady sliding, [node].
std::vector<double> steadySlopes(const ReducedModel& model);
/// Returns the steepest slopes between rest and twice the speed of steady sliding: the lowest ones,
/// or the highest.
std::vector<double> steepestSlopes(const ReducedModel& model, bool lowest);

}  // namespace squeal::march
