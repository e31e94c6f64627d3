// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The condensed complementarity problem of steady sliding, solved by PETSc's SNES VI.
#include <vector>

#include "steady/impedance/contact_solver.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

/// A complementarity problem in the gaps. For SNES, gaps and forces are divided by `gapUnit` and
/// `forceUnit`, so tolerances do not depend on physical units.
struct GapTask {
  const contact::Contact& contact;
  impedance::ContactSolver& solver;
  const impedance::ContactCase& contactCase;
  double gapUnit;    ///< m
  double forceUnit;  ///< N
  double accuracy;   ///< the tolerance of SNES, as a fraction of `forceUnit`
};

/// Collective. Solves
///   0 ≤ g ⟂ F(g) ≥ 0,   g = 0 at nodes that do not separate,
/// starting from `gaps`, [contact node of this rank], m, which become the last iterate. F are the
/// forces of the contact case at these gaps, with balanced friction. Sets the reason and the
/// tolerance of `solution`, and adds to its iterations. If SNES finds no solution, returns false;
/// the reason then names any nodes that alternate between open and closed. At least one rank must
/// have a contact node.
bool solveGaps(const GapTask& task, std::vector<double>& gaps, steady::Solution& solution);

}  // namespace squeal::condensed
