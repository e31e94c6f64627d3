// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The first-order change of the steady state with its data, from the derivatives of the equations
/// of steady.hpp with a fixed active set [M.48, M.49].
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/contact/coupled.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// The direct effect of a parameter on the steady equations, per unit of the parameter.
struct Cause {
  /// Change dr of the nodal forces r = (K + v² K^R) u − b at fixed u, N entries; borrowed; null:
  /// none.
  Vec force = nullptr;
  Vec held = nullptr;   ///< change of p u0, N entries; borrowed; null: none
  double friction = 0;  ///< df
  double speed = 0;     ///< dv, only for its effect through the friction law
};

/// The first-order change of the steady state with a fixed active set.
struct Change {
  OwnedVec displacement;            ///< du, N entries
  std::vector<double> normalForce;  ///< dR_N, [contact node]
};

/// Collective. Returns the change of the converged `solution` such that dF = 0 on the active set of
/// `system` [M.48]. It is computed by iterative refinement with GMRES, preconditioned by the
/// factorised K0. Throws Error if the refinement does not converge.
Change change(const Problem& problem, const Solution& solution,
              const contact::CoupledSystem& system, const Cause& cause);

}  // namespace squeal::steady
