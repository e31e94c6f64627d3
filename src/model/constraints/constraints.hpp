// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Supports: clamped, guided and displaced groups of nodes, in any axes.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/constraints/settings.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::constraints {

using mesh::Matrix3;
using mesh::Point;

/// A factor times a component of a node. The component is given by its row in the distributed nodal
/// vectors, dimension · global node + component.
struct Term {
  PetscInt row;
  double factor;
};

/// A component of a node that depends on other components by an equation:
///   u = constant + Σ factor · others.
struct DependentComponent {
  PetscInt row;  ///< owned node · dimension + component
  std::vector<Term> others;
  double constant;  ///< m, or rad
};

/// A direction in which a group holds a node.
struct HeldDirection {
  Point direction;  ///< unit
  int group;        ///< index into Constraints::groups
};

/// The origin of an equation: a support of a node that follows others, or an option.
struct EquationOrigin {
  int group = -1;      ///< of the support, index into Constraints::groups; −1: an option
  int option = -1;     ///< index into Constraints::equations; −1: a support
  PetscInt node = -1;  ///< global node that the support holds
  Point direction{};   ///< direction in which the support holds the node
};

/// A component for which the equations were solved (a pivot). An equation Σ w u = value exerts the
/// forces λ w. Here λ is the sum of factor · force over all pivots that have the equation among
/// their origins; force is the force at the pivot.
struct EquationPivot {
  PetscInt row;                                 ///< owned node · dimension + component
  std::vector<std::pair<int, double>> origins;  ///< index into Constraints::origins, and factor
};

/// The components that are held at the nodes owned by this rank. They refer to the axes of the
/// node. These are x, y, z or, if a support acts in other directions, turned axes with the held
/// directions first.
struct Constraints {
  std::vector<unsigned char> held;  ///< [owned node · dimension + component] 1 if held
  std::vector<int> heldBy;  ///< [owned node · dimension + component] index into groups, or −1
  std::vector<std::string> groups;  ///< groups with a clamp
  /// [owned node · dimension + component] prescribed value where held, m, or rad
  std::vector<double> displacement;
  std::map<PetscInt, Matrix3> axes;  ///< [owned node] turned axes, by rows
  /// [owned node with turned axes] the held directions as given, which need not be orthogonal;
  /// directions that depend linearly on earlier ones are omitted
  std::map<PetscInt, std::vector<HeldDirection>> given;
  bool anyTurned = false;                     ///< true if any rank has turned axes
  std::vector<DependentComponent> dependent;  ///< owned by this rank
  bool anyDependent = false;                  ///< true if any rank has some
  std::vector<EquationOrigin> origins;        ///< of all equations, the same on all ranks
  std::vector<EquationPivot> pivots;          ///< owned by this rank
  /// [owned node · dimension + component] 1 if supports act on the Cartesian component, directly or
  /// through nodes that follow it
  std::vector<unsigned char> supported;
  std::vector<EquationSettings> equations;
  /// [owned node · dimension + component] values of held components that no sweep scales: the
  /// lengths of bolts; Constraints::displacement is zero for these components
  std::map<PetscInt, double> locked;

  /// Returns the direction of a component of an owned node.
  Point direction(PetscInt node, int component) const;
  /// Returns true if the supports of an owned node hold its displacement along a direction.
  bool holds(PetscInt node, const Point& direction, int dimension) const;
};

/// Not collective. Returns the local node of a term of an equation on the rank that owns the node,
/// and −1 on the others.
PetscInt nodeOf(const mesh::Mesh& mesh, const EquationTerm& term);

/// Not collective. Fixes the length of a bolt, given by its section, an index into Mesh::sections.
/// `opening` is the displacement of the section's reference node along the normal, m.
void lockBolt(const mesh::Mesh& mesh, int section, double opening, Constraints& constraints);

/// Collective. Returns the supports. Throws Error for a component that is given twice or does not
/// exist in the dimension, and for two groups that displace a node differently. Warns about
/// displacements given for components that are not held.
Constraints constraintsOf(const mesh::Mesh& mesh, const Settings& settings);

}  // namespace squeal::constraints
