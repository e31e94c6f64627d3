// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/equations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/dependence.hpp"

namespace squeal::interfaces {
namespace {

using constraints::DependentComponent;
using constraints::Term;

/// Where an equation comes from: a support of a node that follows others, or an option.
struct Source {
  PetscInt row = -1;  // of the held component
  int component = 0, group = -1;
  int interface = -1, coupling = -1;  // which the node follows; −1: not this one
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

/// An equation Σ w u = value of components.
struct Equation {
  const Source* source;
  std::map<PetscInt, double> weights;  // [row]
  double value, scale;
};

/// The equations of all ranks, ordered by position, independent of the partition.
struct Equations {
  std::vector<Source> sources;
  std::vector<Equation> list;
};

/// Appends the entries of a row of this rank, times a factor, and returns their number.
int appendRow(Mat rows, PetscInt row, double factor, std::vector<Term>& terms) {
  PetscInt count = 0;
  const PetscInt* columns = nullptr;
  const PetscScalar* values = nullptr;
  check(MatGetRow(rows, row, &count, &columns, &values));
  int used = 0;
  for (PetscInt k = 0; k < count; ++k)
    if (values[k] != 0) terms.push_back({columns[k], factor * values[k]}), ++used;
  check(MatRestoreRow(rows, row, &count, &columns, &values));
  return used;
}

/// Collective. Returns the equations of supports of nodes that follow others.
Equations heldFollowers(const mesh::Mesh& mesh, const Interfaces& all, Mat rows) {
  const auto& constraints = all.constraints;
  std::vector<Source> sources;
  std::vector<Term> terms;
  const auto add = [&](PetscInt node, int interface, int coupling) {
    for (int d = 0; d < mesh.dimension; ++d) {
      const PetscInt at = mesh.dimension * node + d, row = mesh.dimension * mesh.firstNode + at;
      if (!constraints.held[at] || constraints.heldBy[at] < 0) continue;
      const int used = appendRow(rows, row, 1, terms);
      sources.push_back({row, d, constraints.heldBy[at], interface, coupling, -1,
                         constraints.displacement[at], mesh.coordinates[node], used});
    }
  };
  for (const auto& tied : all.tied) add(tied.connection.node, tied.interface, -1);
  for (const auto& coupled : all.coupled) add(coupled.node, -1, coupled.coupling);
  Equations found{concatenated(mesh.comm, sources), {}};
  const auto allTerms = concatenated(mesh.comm, terms);
  auto next = allTerms.begin();
  for (const auto& source : found.sources) {
    Equation equation{&source, {}, source.value, 0};
    for (int k = 0; k < source.terms; ++k, ++next) equation.weights[next->row] += next->factor;
    found.list.push_back(std::move(equation));
  }
  std::stable_sort(found.list.begin(), found.list.end(),
                   [](const auto& a, const auto& b) { return a.source->place < b.source->place; });
  return found;
}

/// Throws Error unless the group of the term has one node and the component exists.
void requireTerm(const mesh::Mesh& mesh, const constraints::EquationTerm& term,
                 const std::string& head) {
  const PetscInt count = mpi::sum(mesh.comm, PetscInt(mesh.nodeGroups.at(term.group).size()));
  if (count != 1)
    throw Error(head + "group '" + term.group + "' has " + std::to_string(count) +
                " nodes; a term needs a group of one node, or a reference node");
  if (mesh.dimension == 2 && (term.rotation ? term.component != 2 : term.component == 2))
    throw Error(head + "in the plane the components are x, y and rz");
}

/// A term of an equation of the options, on the rank that owns its node.
struct Piece {
  int equation;
  Term term;
};

std::string headOf(const constraints::EquationSettings& equation) {
  return "option " + constraints::equationName(equation.name) + " '" + equation.text + "': ";
}

/// Collective. Returns the sources and equations of the options.
Equations optionEquations(const mesh::Mesh& mesh, const Interfaces& all, Mat rows) {
  Equations found;
  std::vector<Piece> pieces;
  const auto& given = all.constraints.equations;
  for (int e = 0; e < std::ssize(given); ++e)
    for (const auto& term : given[e].terms) {
      requireTerm(mesh, term, headOf(given[e]));
      const PetscInt node = constraints::nodeOf(mesh, term);
      if (node < 0) continue;
      const int component = mesh.dimension == 2 && term.rotation ? 0 : term.component;
      std::vector<Term> terms;
      appendRow(rows, mesh.dimension * (mesh.firstNode + node) + component, term.factor, terms);
      for (const Term& one : terms) pieces.push_back({e, one});
    }
  for (int e = 0; e < std::ssize(given); ++e)
    found.sources.push_back({.option = e, .value = given[e].value});
  for (const auto& source : found.sources) found.list.push_back({&source, {}, source.value, 0});
  for (const auto& [equation, term] : concatenated(mesh.comm, pieces))
    found.list[equation].weights[term.row] += term.factor;
  return found;
}

/// Collective. Returns the states of the components in the equations.
std::map<PetscInt, Component> componentsOf(const mesh::Mesh& mesh, const Interfaces& all,
                                           const std::vector<const Equations*>& equations) {
  std::set<PetscInt> rows;
  for (const auto* some : equations)
    for (const auto& equation : some->list)
      for (const auto& [row, weight] : equation.weights) rows.insert(row);
  std::vector<unsigned char> inContact(mesh.ownedNodes, 0);
  for (const auto& node : all.nodes) inContact[node.node] = 1;
  std::vector<Component> own;
  const PetscInt first = mesh.dimension * mesh.firstNode;
  for (auto at = rows.lower_bound(first);
       at != rows.end() && *at < first + mesh.dimension * mesh.ownedNodes; ++at) {
    const PetscInt local = *at - first;
    const PetscInt node = local / mesh.dimension;
    // A contact node has tangents and normal for its axes, whatever the directions of its supports.
    const bool isKnown = all.constraints.held[local] != 0 &&
                         !(inContact[node] && all.constraints.axes.contains(node));
    own.push_back({*at, inContact[node] != 0, isKnown, mesh.isRotation(mesh.firstNode + node),
                   isKnown ? all.constraints.displacement[local] : 0});
  }
  std::map<PetscInt, Component> components;
  for (const auto& one : concatenated(mesh.comm, own)) components[one.row] = one;
  return components;
}

/// Returns the largest weight of a rotation, m, at least 1e-30: the length that makes rotations
/// comparable to displacements.
double largestArm(const std::vector<const Equations*>& equations,
                  const std::map<PetscInt, Component>& components) {
  double arm = 1e-30;
  for (const auto* some : equations)
    for (const auto& equation : some->list)
      for (const auto& [row, weight] : equation.weights)
        if (components.at(row).isRotation) arm = std::max(arm, std::abs(weight));
  return arm;
}

/// Equations solved for the pivots, which appear in no other equation.
class Elimination {
 public:
  /// `arm`, m, is the length that makes rotations comparable to displacements.
  Elimination(const Interfaces& all, const std::map<PetscInt, Component>& components, double arm)
      : all_(all), components_(components), arm_(arm) {}
  void add(Equation equation);
  /// Returns the equation of each pivot, [pivot], with the weight 1 at the pivot.
  const std::map<PetscInt, Equation>& solved() const { return solved_; }
  /// Returns the equations that depend on the others, exactly or nearly.
  const std::vector<const Source*>& idle() const { return idle_; }
  /// Throws Error if a component depends on others and one belongs to a contact node, whose
  /// unknowns are not Cartesian components.
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
  std::map<PetscInt, std::set<PetscInt>> pivotsWith_;  // [other] pivots whose equations have it
  std::vector<const Source*> idle_;
};

void Elimination::subtract(Equation& from, const Equation& what, PetscInt pivot) const {
  const double factor = from.weights.at(pivot);
  for (const auto& [row, weight] : what.weights) {
    double& sum = from.weights[row];
    sum -= factor * weight;
    if (size(row, sum) < 1e-13 * from.scale || row == pivot) from.weights.erase(row);
  }
  from.value -= factor * what.value;
}

void Elimination::insertKnown(Equation& equation) const {
  const auto weights = equation.weights;
  for (const auto& [row, weight] : weights)
    if (const Component& component = components_.at(row); component.held) {
      equation.value -= weight * component.value;
      equation.weights.erase(row);
    } else if (const auto found = solved_.find(row); found != solved_.end()) {
      subtract(equation, found->second, row);
    }
}

/// Returns the component with the largest weight, if possible one that is not in contact; −1 if all
/// weights are too small.
PetscInt Elimination::pivotOf(const Equation& equation) const {
  // Only ties have quadrature errors.
  const double least = equation.source->interface >= 0 ? leastPivot : 1e-10;
  PetscInt pivot = -1;
  for (const bool inContact : {false, true}) {
    double most = least * equation.scale;
    for (const auto& [row, weight] : equation.weights)
      if (components_.at(row).inContact == inContact && size(row, weight) > most * (1 + 1e-9))
        most = size(row, weight), pivot = row;
    if (pivot >= 0) break;
  }
  return pivot;
}

std::string Elimination::nameOf(const Source& source) const {
  if (source.option >= 0) return headOf(all_.constraints.equations[source.option]);
  const std::string& group = all_.constraints.groups[source.group];
  const std::string follows = source.interface >= 0
                                  ? all_.options[source.interface].label() + " at " +
                                        text(source.place) + ", which follows the master; "
                                  : all_.couplings[source.coupling] + " at " + text(source.place) +
                                        ", which follows other nodes; ";
  return "option -constraint_" + group + "_clamped holds component " + "xyz"[source.component] +
         " of a node of " + follows;
}

void Elimination::setIdle(const Equation& equation) {
  // With u = ū at all remaining components of a support, the equation must hold.
  const Source& source = *equation.source;
  double rest = equation.value, size = std::abs(source.value);
  for (const auto& [row, weight] : equation.weights) {
    if (source.interface >= 0) rest -= weight * source.value;
    size = std::max(size, std::abs(components_.at(row).value));
  }
  for (const auto& [row, other] : solved_) size = std::max(size, std::abs(other.value));
  if (std::abs(rest) > 1e-9 * size)
    throw Error(nameOf(source) + (source.option >= 0
                                      ? "it contradicts other equations and supports"
                                      : "the displacement differs from that of other supports of "
                                        "slave and master"));
  idle_.push_back(&source);
}

void Elimination::add(Equation equation) {
  for (const auto& [row, weight] : equation.weights)
    equation.scale = std::max(equation.scale, size(row, weight));
  insertKnown(equation);
  const PetscInt pivot = pivotOf(equation);
  if (pivot < 0) {
    setIdle(equation);
    return;
  }
  const double weight = equation.weights.at(pivot);
  for (auto& [row, value] : equation.weights) value /= weight;
  equation.value /= weight, equation.scale = size(pivot, 1);
  if (const auto with = pivotsWith_.find(pivot); with != pivotsWith_.end()) {
    for (const PetscInt other : std::set<PetscInt>(with->second)) {
      Equation& before = solved_.at(other);
      if (!before.weights.contains(pivot)) continue;  // it has cancelled since
      subtract(before, equation, pivot);
      for (const auto& [row, value] : before.weights)
        if (row != other) pivotsWith_[row].insert(other);
    }
    pivotsWith_.erase(pivot);
  }
  for (const auto& [row, value] : equation.weights)
    if (row != pivot) pivotsWith_[row].insert(pivot);
  solved_.emplace(pivot, std::move(equation));
}

void Elimination::rejectContact() const {
  for (const auto& [pivot, equation] : solved_) {
    const bool alone = equation.weights.size() == 1;
    if (alone && equation.source->option < 0) continue;
    for (const auto& [row, weight] : equation.weights)
      if (components_.at(row).inContact)
        throw Error(nameOf(*equation.source) +
                    (equation.source->option >= 0
                         ? "a node in contact is in it; choose other nodes"
                         : "it depends on " + std::to_string(equation.weights.size()) +
                               " components, at least one in contact; let the other side be the "
                               "slave"));
  }
}

/// Stores the solution in the constraints of this rank.
void apply(const mesh::Mesh& mesh, const Elimination& elimination, Interfaces& all) {
  auto& constraints = all.constraints;
  const PetscInt first = mesh.dimension * mesh.firstNode;
  for (const auto& [pivot, equation] : elimination.solved()) {
    if (equation.weights.size() > 1) constraints.anyDependent = true;
    const PetscInt at = pivot - first;
    if (at < 0 || at >= mesh.dimension * mesh.ownedNodes) continue;
    if (equation.weights.size() == 1) {
      constraints.held[at] = 1, constraints.heldBy[at] = equation.source->group;
      constraints.displacement[at] = equation.value;
      continue;
    }
    DependentComponent dependent{at, {}, equation.value};
    for (const auto& [row, weight] : equation.weights)
      if (row != pivot) dependent.others.push_back({row, -weight});
    constraints.dependent.push_back(std::move(dependent));
  }
  for (const Source* source : elimination.idle())
    if (source->interface >= 0)
      for (auto& tied : all.tied)
        if (mesh.firstNode + tied.connection.node == source->row / mesh.dimension)
          tied.apart[source->component] = 1;
}

/// Collective. Returns true if a support holds a node that follows others, or an option gives an
/// equation.
bool anyEquation(const mesh::Mesh& mesh, const Interfaces& all) {
  bool any = !all.constraints.equations.empty();
  const auto levels = levelsOfFollowers(mesh, all);
  for (std::size_t i = 0; i < all.constraints.held.size(); ++i)
    any = any || (levels[i / mesh.dimension] > 0 && all.constraints.held[i] &&
                  all.constraints.heldBy[i] >= 0);
  return mpi::any(mesh.comm, any);
}

}  // namespace

void solveEquations(const mesh::Mesh& mesh, Interfaces& all) {
  if (!anyEquation(mesh, all)) return;
  const OwnedMat rows = followedRows(mesh, all);
  const Equations supports = heldFollowers(mesh, all, rows),
                  options = optionEquations(mesh, all, rows);
  const auto components = componentsOf(mesh, all, {&supports, &options});
  Elimination elimination(all, components, largestArm({&supports, &options}, components));
  const PetscInt first = mesh.dimension * mesh.firstNode;
  for (const auto* equations : {&supports, &options})
    for (const auto& equation : equations->list) {
      elimination.add(equation);
      if (equation.source->interface >= 0) ++all.reports[equation.source->interface].carried;
      for (const auto& [row, weight] : equation.weights)
        if (const PetscInt at = row - first; at >= 0 && at < mesh.dimension * mesh.ownedNodes)
          all.constraints.supported[at] = 1;
    }
  elimination.rejectContact();
  apply(mesh, elimination, all);
}

}  // namespace squeal::interfaces
