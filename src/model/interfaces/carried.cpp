// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/carried.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::interfaces {
namespace {

/// The equation of a held component of a tied node.
struct Held {
  PetscInt node;  // global
  int component, group, interface;
  double value;  // m
  Point place;
  int terms;
};

/// The state of a node that masters others, the same on all ranks.
struct Master {
  PetscInt node = -1;  // global
  bool inContact = false;
  std::array<unsigned char, 3> held{};
  Point value{};  // m
};

/// An equation Σ w u = value of components of nodes.
struct Equation {
  const Held* held;
  std::map<PetscInt, double> weights;  // [global node]
  double value, scale;
};

/// Collective. Returns the rows that give u at all nodes from u at the nodes that are not tied, one
/// row per node, since all components are tied in the same way.
OwnedMat tieRows(const mesh::Mesh& mesh, const Interfaces& all) {
  OwnedMat rows;
  for (int level = 1; level <= all.levels; ++level) {
    std::vector<PetscInt> count(mesh.ownedNodes, 1);
    for (const auto& tied : all.tied)
      if (tied.connection.level == level)
        count[tied.connection.node] = tied.connection.masters.size();
    OwnedMat factor;
    check(MatCreateAIJ(mesh.comm, mesh.ownedNodes, mesh.ownedNodes, PETSC_DETERMINE,
                       PETSC_DETERMINE, 0, count.data(), 0, count.data(), factor.out()));
    std::vector<bool> isTied(mesh.ownedNodes, false);
    for (const auto& tied : all.tied) {
      if (tied.connection.level != level) continue;
      isTied[tied.connection.node] = true;
      for (const auto& [master, weight] : tied.connection.masters)
        check(MatSetValue(factor, mesh.firstNode + tied.connection.node, master, weight,
                          INSERT_VALUES));
    }
    for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
      if (!isTied[node])
        check(MatSetValue(factor, mesh.firstNode + node, mesh.firstNode + node, 1, INSERT_VALUES));
    assembled(factor);
    if (!rows) {
      rows = std::move(factor);
      continue;
    }
    OwnedMat product;
    check(MatMatMult(factor, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, product.out()));
    rows = std::move(product);
  }
  return rows;
}

/// The equations of all ranks, ordered by position, independent of the partition.
struct Equations {
  std::vector<Held> held;
  std::vector<Equation> list;
};

Equations equationsOf(const mesh::Mesh& mesh, const Interfaces& all, Mat rows) {
  const auto& constraints = all.constraints;
  std::vector<Held> held;
  std::vector<coupling::Weight> terms;
  for (const auto& tied : all.tied)
    for (int d = 0; d < mesh.dimension; ++d) {
      const PetscInt node = tied.connection.node, at = mesh.dimension * node + d;
      if (!constraints.held[at]) continue;
      PetscInt count = 0;
      const PetscInt* columns = nullptr;
      const PetscScalar* values = nullptr;
      check(MatGetRow(rows, mesh.firstNode + node, &count, &columns, &values));
      int used = 0;
      for (PetscInt k = 0; k < count; ++k)
        if (values[k] != 0) terms.push_back({columns[k], values[k]}), ++used;
      check(MatRestoreRow(rows, mesh.firstNode + node, &count, &columns, &values));
      held.push_back({mesh.firstNode + node, d, constraints.heldBy[at], tied.interface,
                      constraints.displacement[at], mesh.coordinates[node], used});
    }
  Equations found{concatenated(mesh.comm, held), {}};
  const auto allTerms = concatenated(mesh.comm, terms);
  auto next = allTerms.begin();
  for (const auto& one : found.held) {
    Equation equation{&one, {}, one.value, 0};
    for (int k = 0; k < one.terms; ++k, ++next) {
      equation.weights[next->node] += next->value;
      equation.scale = std::max(equation.scale, std::abs(next->value));
    }
    found.list.push_back(std::move(equation));
  }
  std::stable_sort(found.list.begin(), found.list.end(),
                   [](const auto& a, const auto& b) { return a.held->place < b.held->place; });
  return found;
}

/// Collective. Returns the states of the masters in the equations.
std::map<PetscInt, Master> mastersOf(const mesh::Mesh& mesh, const Interfaces& all,
                                     const Equations& equations) {
  std::set<PetscInt> nodes;
  for (const auto& equation : equations.list)
    for (const auto& [node, weight] : equation.weights) nodes.insert(node);
  std::vector<unsigned char> inContact(mesh.ownedNodes, 0);
  for (const auto& node : all.nodes) inContact[node.node] = 1;
  std::vector<Master> own;
  for (auto at = nodes.lower_bound(mesh.firstNode);
       at != nodes.end() && *at < mesh.firstNode + mesh.ownedNodes; ++at) {
    const PetscInt local = *at - mesh.firstNode;
    Master master{*at, inContact[local] != 0, {}, {}};
    for (int d = 0; d < mesh.dimension; ++d) {
      master.held[d] = all.constraints.held[mesh.dimension * local + d];
      master.value[d] = all.constraints.displacement[mesh.dimension * local + d];
    }
    own.push_back(master);
  }
  std::map<PetscInt, Master> masters;
  for (const auto& master : concatenated(mesh.comm, own)) masters[master.node] = master;
  return masters;
}

/// The equations of one component, solved for the pivots, which appear in no other equation.
class Elimination {
 public:
  Elimination(int component, const Interfaces& all, const std::map<PetscInt, Master>& masters)
      : component_(component), all_(all), masters_(masters) {}
  void add(Equation equation);
  /// Returns the equation of each pivot, [pivot], with the weight 1 at the pivot.
  const std::map<PetscInt, Equation>& solved() const { return solved_; }
  /// Returns the equations that depend on the others, exactly or nearly.
  const std::vector<const Held*>& idle() const { return idle_; }

 private:
  void insertKnown(Equation& equation) const;
  PetscInt pivotOf(const Equation& equation) const;
  static void subtract(Equation& from, const Equation& what, PetscInt pivot);
  void reject(const Equation& equation) const;
  int component_;
  const Interfaces& all_;
  const std::map<PetscInt, Master>& masters_;
  std::map<PetscInt, Equation> solved_;
  std::map<PetscInt, std::set<PetscInt>> pivotsWith_;  // [other] pivots whose equations have it
  std::vector<const Held*> idle_;
};

void Elimination::subtract(Equation& from, const Equation& what, PetscInt pivot) {
  const double factor = from.weights.at(pivot);
  for (const auto& [node, weight] : what.weights) {
    double& sum = from.weights[node];
    sum -= factor * weight;
    if (std::abs(sum) < 1e-13 * from.scale || node == pivot) from.weights.erase(node);
  }
  from.value -= factor * what.value;
}

void Elimination::insertKnown(Equation& equation) const {
  const auto weights = equation.weights;
  for (const auto& [node, weight] : weights)
    if (const Master& master = masters_.at(node); master.held[component_]) {
      equation.value -= weight * master.value[component_];
      equation.weights.erase(node);
    } else if (const auto found = solved_.find(node); found != solved_.end()) {
      subtract(equation, found->second, node);
    }
}

/// Returns the node with the largest weight, if possible one that is not in contact; −1 if all
/// weights are too small.
PetscInt Elimination::pivotOf(const Equation& equation) const {
  PetscInt pivot = -1;
  for (const bool inContact : {false, true}) {
    double most = leastPivot * equation.scale;
    for (const auto& [node, weight] : equation.weights)
      if (masters_.at(node).inContact == inContact && std::abs(weight) > most * (1 + 1e-9))
        most = std::abs(weight), pivot = node;
    if (pivot >= 0) break;
  }
  return pivot;
}

std::string nameOf(const Held& held, const Interfaces& all) {
  return "option -constraint_" + all.constraints.groups[held.group] + "_clamped holds component " +
         "xyz"[held.component] + " of a node of " + all.options[held.interface].label() + " at " +
         text(held.place) + ", which follows the master";
}

void Elimination::reject(const Equation& equation) const {
  throw Error(nameOf(*equation.held, all_) +
              "; the displacement differs from that of other supports of slave and master");
}

void Elimination::add(Equation equation) {
  insertKnown(equation);
  const PetscInt pivot = pivotOf(equation);
  if (pivot < 0) {
    // With u = ū at all remaining masters, the equation must hold.
    double rest = equation.value, size = std::abs(equation.held->value);
    for (const auto& [node, weight] : equation.weights) rest -= weight * equation.held->value;
    for (const auto& [node, weight] : equation.weights)
      size = std::max(size, std::abs(masters_.at(node).value[component_]));
    for (const auto& [node, other] : solved_) size = std::max(size, std::abs(other.value));
    if (std::abs(rest) > 1e-9 * size) reject(equation);
    idle_.push_back(equation.held);
    return;
  }
  const double weight = equation.weights.at(pivot);
  for (auto& [node, value] : equation.weights) value /= weight;
  equation.value /= weight, equation.scale = 1;
  if (const auto with = pivotsWith_.find(pivot); with != pivotsWith_.end()) {
    for (const PetscInt other : std::set<PetscInt>(with->second)) {
      Equation& before = solved_.at(other);
      subtract(before, equation, pivot);
      for (const auto& [node, value] : before.weights)
        if (node != other) pivotsWith_[node].insert(other);
    }
    pivotsWith_.erase(pivot);
  }
  for (const auto& [node, value] : equation.weights)
    if (node != pivot) pivotsWith_[node].insert(pivot);
  solved_.emplace(pivot, std::move(equation));
}

/// Throws Error if a component depends on others and one belongs to a contact node, whose unknowns
/// are not Cartesian components.
void rejectContact(const Equation& equation, const Interfaces& all,
                   const std::map<PetscInt, Master>& masters) {
  if (equation.weights.size() == 1) return;
  for (const auto& [node, weight] : equation.weights)
    if (masters.at(node).inContact)
      throw Error(nameOf(*equation.held, all) + " on " + std::to_string(equation.weights.size()) +
                  " nodes, at least one in contact; let the other side be the slave");
}

/// Stores the solution of one component in the constraints of this rank.
void apply(const mesh::Mesh& mesh, int component, const Elimination& elimination, Interfaces& all) {
  auto& constraints = all.constraints;
  for (const auto& [pivot, equation] : elimination.solved()) {
    if (equation.weights.size() > 1) constraints.anyCombined = true;
    const PetscInt local = pivot - mesh.firstNode, at = mesh.dimension * local + component;
    if (local < 0 || local >= mesh.ownedNodes) continue;
    if (equation.weights.size() == 1) {
      constraints.held[at] = 1, constraints.heldBy[at] = equation.held->group;
      constraints.displacement[at] = equation.value;
      continue;
    }
    CombinedComponent combined{local, component, {}, equation.value};
    for (const auto& [node, weight] : equation.weights)
      if (node != pivot) combined.others.push_back({node, -weight});
    constraints.combined.push_back(std::move(combined));
  }
  for (const Held* held : elimination.idle())
    for (auto& tied : all.tied)
      if (mesh.firstNode + tied.connection.node == held->node) tied.apart[component] = 1;
}

}  // namespace

void transferSupports(const mesh::Mesh& mesh, Interfaces& all) {
  PetscInt count = 0;
  for (const auto& tied : all.tied)
    for (int d = 0; d < mesh.dimension; ++d)
      count += all.constraints.held[mesh.dimension * tied.connection.node + d];
  count = mpi::sum(mesh.comm, count);
  if (count == 0) return;
  const OwnedMat rows = tieRows(mesh, all);
  const Equations equations = equationsOf(mesh, all, rows);
  const auto masters = mastersOf(mesh, all, equations);
  for (int component = 0; component < mesh.dimension; ++component) {
    Elimination elimination(component, all, masters);
    for (const auto& equation : equations.list) {
      if (equation.held->component != component) continue;
      elimination.add(equation);
      ++all.reports[equation.held->interface].carried;
      for (const auto& [node, weight] : equation.weights)
        if (const PetscInt local = node - mesh.firstNode; local >= 0 && local < mesh.ownedNodes)
          all.constraints.supported[mesh.dimension * local + component] = 1;
    }
    for (const auto& [pivot, equation] : elimination.solved())
      rejectContact(equation, all, masters);
    apply(mesh, component, elimination, all);
  }
}

}  // namespace squeal::interfaces
