// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The state of closed, frictionless contact under the loads of a point.
#include <array>
#include <vector>

#include "steady/impedance/impedance.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

/// The state at a point with the pressure factor p and the speed factor v is the sum of three: the
/// state at p = v = 0, p times the contribution of p = 1, and v² times the contribution of v = 1.
class Loads {
 public:
  /// Collective. Computes the three states, each by one solve for its residual. `open` is the
  /// problem in which no sticking node is held, borrowed during the lifetime of the object.
  Loads(const steady::Problem& open, const impedance::Impedance& impedance);
  /// Returns the forces (R, F) of Impedance at a point.
  impedance::ContactVector forces(const sweep::Parameters& at) const;
  /// Collective. Returns the unknowns of the open contact at a point.
  OwnedVec unknowns(const sweep::Parameters& at) const;

 private:
  struct State {
    OwnedVec x;                      // in the unknowns of the open contact
    impedance::ContactVector given;  // (R, F)
  };
  const steady::Problem& open_;
  std::vector<State> states_;
};

}  // namespace squeal::condensed
