// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The closed contact without friction under the loads of a point.
#include <array>
#include <vector>

#include "steady/impedance/impedance.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::condensed {

/// States are sums of three: one without loads, and what p = 1 and v = 1 add.
class Loads {
 public:
  /// Collective. Finds the three states, with the residual of each balanced by one solve. `open` is
  /// the problem without holds, and is borrowed during the life of the object.
  Loads(const steady::Problem& open, const impedance::Impedance& impedance);
  /// Returns (R, F) at a point.
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
