// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Complementary pivoting for condensed problems on which Newton's method fails.
#include <vector>

#include "steady/impedance/contact_solver.hpp"

namespace squeal::condensed {

/// Collective. Searches for the gaps of
///   0 ≤ g ⟂ F(g) ≥ 0,
/// with F(g) as in solveGaps(), by Lemke's method (Cottle, Pang and Stone, The Linear
/// Complementarity Problem, SIAM 2009, algorithm 4.4.5): a force λ d with d > 0, large enough to
/// close the contact, is added to F. λ is then reduced along the path of solutions, on which it may
/// grow again for a while, until λ = 0. Without friction the method finds a solution whenever one
/// exists, even if only the contact supports a body. Each pivot opens or closes one node; a node
/// that opens for the first time costs one solve. Nodes that do not separate stay closed. Returns
/// true and sets `gaps`, [contact node of this rank], m, if the path reaches λ = 0; otherwise
/// `gaps` does not change.
bool pivotGaps(impedance::ContactSolver& solver, const contact::Contact& contact,
               const impedance::ContactCase& contactCase, std::vector<double>& gaps);

}  // namespace squeal::condensed
