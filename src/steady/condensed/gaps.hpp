// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The condensed complementarity problem of steady sliding, solved by PETSc's SNES VI.
#include <vector>

#include "steady/impedance/contact_solver.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

/// A complementarity problem of the gaps. Gaps and forces are divided by their units for SNES, so
/// that tolerances do not depend on units.
struct GapTask {
  const contact::Contact& contact;
  impedance::ContactSolver& solver;
  const impedance::ContactCase& asked;
  double gapUnit;    ///< m
  double forceUnit;  ///< N
  double accuracy;   ///< the tolerance of SNES, a part of the unit of forces
};

/// Collective. Solves
///   0 ≤ g ⟂ F(g) ≥ 0
/// from the start `gaps`, [contact node of this rank], m, which become the solution. F contains the
/// forces of the case at the gaps, with its friction in balance. Sets reason and tolerance of
/// `solution`, and adds to its iterations. If SNES finds no solution, returns false and names the
/// nodes that alternate. There has to be a contact node on some rank.
bool solveGaps(const GapTask& task, std::vector<double>& gaps, steady::Solution& solution);

}  // namespace squeal::condensed
