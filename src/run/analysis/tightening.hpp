// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The tightening of bolts before the sweep.
#include <vector>

#include "model/constraints/settings.hpp"
#include "run/analysis/model.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::analysis {

/// Collective. Solves a first load step with the forces of the bolts and the loads that no sweep
/// scales, and then fixes the lengths of the bolts. In this step the swept friction is 0, and so is
/// the pressure unless Settings::boltsUnderPressure is set. Without a bolt force, no step is
/// solved. Warns of bolts whose length changes by too much for small strains. Throws Error if the
/// step has no solution.
void tightenBolts(Model& model, const constraints::Settings& settings);

/// Collective. Returns the tension of each bolt in a steady state, N, [section of the mesh].
std::vector<double> boltForces(const Model& model, const steady::Solution& solution);

}  // namespace squeal::analysis
