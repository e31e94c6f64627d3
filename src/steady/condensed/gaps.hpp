#pragma once
/// This function solves the condensed complementarity problem of steady sliding by PETSc's SNES VI.
#include <vector>

#include "steady/impedance/contact_solver.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

/// Gaps and forces are divided by these for SNES, so that tolerances do not depend on units.
struct GapUnits {
  double gap;    ///< m
  double force;  ///< N
};

/// Collective. Solves
///   0 ≤ g ⟂ F(g) ≥ 0
/// from the start `gaps`, [contact node of this rank], m, which become the solution. F holds the
/// forces of the case `asked` at the gaps, with its friction in balance, and SNES is asked for
/// `accuracy`, a part of the unit of forces. Sets reason and tolerance of `solution`, adds to its
/// iterations, and says which nodes alternate where SNES finds no solution, which makes it return
/// false. There has to be a contact node on some rank.
bool solveGaps(const contact::Contact& contact, impedance::ContactSolver& solver,
               const impedance::ContactCase& asked, const GapUnits& units, double accuracy,
               std::vector<double>& gaps, steady::Solution& solution);

}  // namespace squeal::condensed
