// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Complementary pivots lead to a solution of the condensed problem where Newton's method does not.
#include <vector>

#include "steady/impedance/contact_solver.hpp"

namespace squeal::condensed {

/// Collective. Looks for the gaps of
///   0 ≤ g ⟂ F(g) ≥ 0,
/// with F(g) as in solveGaps(), by Lemke's method (Cottle, Pang and Stone, The Linear
/// Complementarity Problem, SIAM 2009, algorithm 4.4.5): λ d with d > 0 is added to F, so large
/// that the contact is closed, and is taken back along the path of solutions, which may turn, until
/// λ = 0. Without friction that finds a solution whenever there is one, also where the contact
/// alone holds a body. Each pivot opens or closes one node; one that opens for the first time costs
/// a solve with the factorisation. Returns true, with the gaps [contact node of this rank], m, if
/// the path leads to λ = 0; otherwise the gaps stay as they are.
bool pivotGaps(impedance::ContactSolver& solver, MPI_Comm comm, const impedance::ContactCase& asked,
               std::vector<double>& gaps);

}  // namespace squeal::condensed
