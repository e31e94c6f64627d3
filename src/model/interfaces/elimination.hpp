// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Gaussian elimination of equations between components of nodes. Every rank eliminates the
/// equations of all ranks.
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/interfaces/nodes.hpp"

namespace squeal::interfaces {

/// Where an equation comes from: a support of a node that follows others, or an option.
struct Source {
  PetscInt node = -1;  // global node that the support holds
  Point direction{};   // in which the support holds it
  int component = 0, group = -1;
  bool isTurned = false;              // the direction is not that of the component
  int interface = -1, coupling = -1;  // by which the node follows others; −1: none
  int option = -1;                    // index into Constraints::equations
  double value = 0;                   // m, or rad
  Point place{};
  int terms = 0;
};

/// The state of a component in the equations, the same on all ranks.
struct Component {
  PetscInt row = -1;
  bool inContact = false, held = false, isRotation = false;
  double value = 0;
};

/// An equation Σ w u = value with weights w of components u.
struct Equation {
  const Source* source;
  std::map<PetscInt, double> weights;  // [row]
  double value, scale;
  std::map<int, double> origins = {};  // [index into Constraints::origins] factor of this origin
};

/// Returns the option of an equation as the head of a message.
std::string headOf(const constraints::EquationSettings& equation);

/// Equations, each solved for a component of its own, the pivot, which appears in no other
/// equation.
class Elimination {
 public:
  /// `arm`, m, is the length that makes rotations comparable to displacements.
  Elimination(const Interfaces& all, const std::map<PetscInt, Component>& components, double arm)
      : all_(all), components_(components), arm_(arm) {}
  void add(Equation equation);
  /// Returns the equation of each pivot, [pivot], with the weight 1 at the pivot.
  const std::map<PetscInt, Equation>& solved() const { return solved_; }
  /// Returns the sources of the equations that are linearly dependent on the others, exactly or
  /// nearly.
  const std::vector<const Source*>& idle() const { return idle_; }
  /// Throws Error if an equation contains a component of a contact node, whose unknowns are not
  /// Cartesian components. Equations of supports are allowed if they contain only one component.
  void rejectContact() const;

 private:
  void insertKnown(Equation& equation) const;
  PetscInt pivotOf(const Equation& equation) const;
  void subtract(Equation& from, const Equation& what, PetscInt pivot) const;
  /// Returns the magnitude of a weight, with rotations in units of 1/arm.
  double size(PetscInt row, double weight) const {
    return std::abs(weight) / (components_.at(row).isRotation ? arm_ : 1);
  }
  void setIdle(const Equation& equation);
  std::string nameOf(const Source& source) const;
  const Interfaces& all_;
  const std::map<PetscInt, Component>& components_;
  double arm_;
  std::map<PetscInt, Equation> solved_;
  std::map<PetscInt, std::set<PetscInt>> pivotsWith_;  // [other] pivots whose equations contain it
  std::vector<const Source*> idle_;
};

}  // namespace squeal::interfaces
