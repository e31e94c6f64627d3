// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The static responses of the bodies to gaps and to tangential forces at the contact nodes.
#include <memory>
#include <span>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "model/contact/coupled.hpp"
#include "regime/regime/contact_nodes.hpp"
#include "regime/regime/full_model.hpp"
#include "steady/impedance/impedance.hpp"

namespace squeal::regime {

class StaticResponses {
 public:
  /// Collective. Borrows the model; `own` are the contact nodes of this rank.
  StaticResponses(const FullModel& full, const std::vector<Node>& own);
  /// Collective. Returns the static responses as nodal displacements. First come the responses to a
  /// unit gap at each node; then, tangent by tangent, those to a unit force along the tangent or,
  /// at nodes of sticking interfaces, to a unit slip. `order` is Order::own().
  linalg::Block all(const std::vector<PetscInt>& order) const;

 private:
  void appendResponses(const impedance::Impedance& impedance, std::span<const PetscInt> nodes,
                       int c, linalg::Block& result) const;
  PetscInt causeOf(const impedance::Impedance& impedance, PetscInt node, int c) const;

  const FullModel& full_;
  contact::Transformation open_;
  std::vector<std::unique_ptr<impedance::Impedance>> impedances_;  // [tangent]
};

}  // namespace squeal::regime
