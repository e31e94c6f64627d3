// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The forces of supports, equations, ties, couplings and periodicity on the nodes of a steady
/// state.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/contact/contact.hpp"
#include "steady/steady/wrench.hpp"

namespace squeal::steady {

/// The resultants of these forces over the nodes of this rank.
struct ConditionForces {
  std::vector<Wrench> supports;    ///< [Constraints::groups]
  std::vector<Wrench> equations;   ///< [Constraints::equations]
  std::vector<Wrench> references;  ///< [Mesh::references] of all couplings, on the reference node
  /// [Interfaces::couplings, without bolts] of each coupling, on its reference node
  std::vector<Wrench> couplings;
  std::vector<Wrench> bolts;            ///< [Mesh::sections] on the upper side
  std::vector<Wrench> slaves, masters;  ///< [interface] of ties, on slaves and masters
  Wrench periodicity;                   ///< sum over images and primaries
};

/// Finds the forces of all conditions. It begins with the nodes on which no others depend: periodic
/// images first, then the slaves of ties and the coupled nodes, from the highest level down. The
/// force on each node is passed on to the nodes on which it depends.
class Conditions {
 public:
  /// Collective. Borrows the contact during the lifetime of the object.
  explicit Conditions(const contact::Contact& contact);
  /// Collective. Returns the forces whose sum at each node is `forces` (N entries, in newtons).
  /// These are the forces that the bodies need for equilibrium, without those of contact. If
  /// several groups hold the same component, its force is attributed to one of them.
  ConditionForces of(Vec forces) const;

 private:
  void findPlaces();
  void transfer(Vec forces, ConditionForces* found) const;
  void addPeriodicity(const double* forces, ConditionForces& found) const;
  void addTies(int level, const double* forces, ConditionForces& found) const;
  void addCouplings(int level, const double* forces, ConditionForces& found) const;
  void addOnReference(PetscInt global, const Point& value, ConditionForces& found) const;
  std::vector<double> multipliers(Vec forces) const;
  void takeEquations(const std::vector<double>& multipliers, Vec forces,
                     ConditionForces& found) const;
  void addSupports(Vec forces, ConditionForces& found) const;
  void addSupport(PetscInt node, const Point& force, ConditionForces& found) const;

  const contact::Contact& contact_;
  const interfaces::Interfaces& all_;
  const mesh::Mesh& mesh_;
  std::vector<OwnedMat> rows_;           // [level − 1] of the followers; null if there are none
  std::vector<Point> places_;            // [tied node] Σ P_il x_l, its place on the master
  std::vector<int> levels_;              // [owned node] of a follower; 0 for all others
  std::vector<unsigned char> isTurned_;  // [owned node] 1: its unknowns are in turned axes
};

}  // namespace squeal::steady
