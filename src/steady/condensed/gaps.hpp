// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The condensed complementarity problem of steady sliding, solved by PETSc's SNES VI.
#include <vector>

#include "steady/impedance/contact_solver.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

/// A complementarity problem of the gaps. Gaps and forces are divided by their units for SNES, so
/// tolerances do not depend on units.
struct GapTask {
  const contact::Contact& contact;
  impedance::ContactSolver& solver;
  const impedance::ContactCase& contactCase;
  double gapUnit;    ///< m
  double forceUnit;  ///< N
  double accuracy;   ///< the tolerance of SNES, a fraction of the unit of forces
};

/// Collective. Solves
///   0 ≤ g ⟂ F(g) ≥ 0,   g = 0 at nodes that do not separate,
/// from the initial `gaps`, [contact node of this rank], m, which become the solution. F are the
/// forces of the case at the gaps, with balanced friction. Sets reason and tolerance of `solution`,
/// and adds to its iterations. If SNES finds no solution, returns false and names the alternating
/// nodes. At least one rank must have a contact node.
bool solveGaps(const GapTask& task, std::vector<double>& gaps, steady::Solution& solution);

}  // namespace squeal::condensed
