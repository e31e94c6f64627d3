// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The forces and moments of everything that holds or joins the bodies of a steady state, and their
/// balance.
#include <string>
#include <vector>

#include "model/attachments/forms.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "steady/steady/condition_forces.hpp"
#include "steady/steady/steady.hpp"
#include "steady/steady/wrench.hpp"

namespace squeal::steady {

/// A row of the table of reactions.
struct Reaction {
  std::string kind;  ///< "support", "coupling", …, "sum"
  std::string name;  ///< of the group, coupling, interface, …
  Wrench wrench;
};

/// The reactions of the steady states of one model.
class Reactions {
 public:
  /// Collective. Borrows mesh, bodies and contact during the lifetime of the object.
  Reactions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
            const contact::Contact& contact);
  /// Collective. Returns the reactions of a converged solution, the same on all ranks. The last one
  /// is the sum of all external forces: supports, equations, springs and bushings to the ground,
  /// obstacles and loads. The sum includes the moments of pairs of internal forces that act at
  /// different points: those of periodicity, and of interfaces whose surfaces do not coincide.
  std::vector<Reaction> of(const Solution& solution) const;

 private:
  class List;
  /// The resultants of one load over the nodes of this rank.
  struct Load {
    std::string name;
    Wrench hydraulic, constant, squared;  // squared: grows with the square of the speed
  };
  void findLoads();
  void addLoad(const std::string& name, Vec hydraulic, Vec constant, Vec squared);
  /// The forces of contact on the nodes of this rank.
  struct ContactForces {
    std::vector<Wrench> sums;  // [interface] over both sides
    OwnedVec rest;             // the nodal forces without those of contact
  };
  ContactForces contactForces(const Solution& solution) const;
  void addGround(const Solution& solution, List& list) const;
  void addLinks(const Solution& solution, List& list) const;
  void addConditions(const ConditionForces& forces, List& list) const;
  void addInterfaces(const Solution& solution, const std::vector<Wrench>& sums,
                     const ConditionForces& conditions, List& list) const;
  void addLoads(const Solution& solution, List& list) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  Conditions conditions_;
  std::vector<Load> loads_;
};

}  // namespace squeal::steady
