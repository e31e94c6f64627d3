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
#include "model/interfaces/elimination.hpp"

namespace squeal::interfaces {
namespace {

using constraints::DependentComponent;
using constraints::Term;

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
      const PetscInt at = mesh.dimension * node + d, row = mesh.dimension * (mesh.firstNode + node);
      if (!constraints.held[at] || constraints.heldBy[at] < 0) continue;
      const Point direction = constraints.direction(node, d);
      int used = 0;
      for (int c = 0; c < mesh.dimension; ++c)
        if (direction[c] != 0) used += appendRow(rows, row + c, direction[c], terms);
      sources.push_back({.node = mesh.firstNode + node,
                         .direction = direction,
                         .component = d,
                         .group = constraints.heldBy[at],
                         .isTurned = constraints.axes.contains(node),
                         .interface = interface,
                         .coupling = coupling,
                         .value = constraints.displacement[at],
                         .place = mesh.coordinates[node],
                         .terms = used});
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
    throw Error(head + "in plane problems the components are x, y and rz");
}

/// A term of an equation of the options, on the rank that owns its node.
struct Piece {
  int equation;
  Term term;
};

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

/// Stores the solution in the constraints of this rank.
void apply(const mesh::Mesh& mesh, const Elimination& elimination, Interfaces& all) {
  auto& constraints = all.constraints;
  const PetscInt first = mesh.dimension * mesh.firstNode;
  for (const auto& [pivot, equation] : elimination.solved()) {
    if (equation.weights.size() > 1) constraints.anyDependent = true;
    const PetscInt at = pivot - first;
    if (at < 0 || at >= mesh.dimension * mesh.ownedNodes) continue;
    constraints.pivots.push_back({at, {equation.origins.begin(), equation.origins.end()}});
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
    if (source->interface >= 0 && !source->isTurned)  // ties leave out only components
      for (auto& tied : all.tied)
        if (mesh.firstNode + tied.connection.node == source->node)
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
  auto& origins = all.constraints.origins;
  for (const auto* equations : {&supports, &options}) {
    const int before = std::ssize(origins);
    for (const auto& source : equations->sources)
      origins.push_back({source.group, source.option, source.node, source.direction});
    for (Equation equation : equations->list) {
      equation.origins = {{before + int(equation.source - equations->sources.data()), 1}};
      elimination.add(equation);
      if (equation.source->interface >= 0) ++all.reports[equation.source->interface].carried;
      for (const auto& [row, weight] : equation.weights)
        if (const PetscInt at = row - first; at >= 0 && at < mesh.dimension * mesh.ownedNodes)
          all.constraints.supported[at] = 1;
    }
  }
  elimination.rejectContact();
  apply(mesh, elimination, all);
}

}  // namespace squeal::interfaces
