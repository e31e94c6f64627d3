// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/elimination.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/equations.hpp"

namespace squeal::interfaces {

std::string headOf(const constraints::EquationSettings& equation) {
  return "option " + constraints::equationName(equation.name) + " '" + equation.text + "': ";
}

void Elimination::subtract(Equation& from, const Equation& what, PetscInt pivot) const {
  const double factor = from.weights.at(pivot);
  for (const auto& [row, weight] : what.weights) {
    double& sum = from.weights[row];
    sum -= factor * weight;
    if (size(row, sum) < 1e-13 * from.scale || row == pivot) from.weights.erase(row);
  }
  for (const auto& [origin, share] : what.origins) from.origins[origin] -= factor * share;
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
                                  : all_.couplings[source.coupling].label() + " at " +
                                        text(source.place) + ", which follows other nodes; ";
  const std::string what = source.isTurned ? "the direction " + text(source.direction)
                                           : std::string("component ") + "xyz"[source.component];
  return "option " + constraints::clampedName(group) + " holds " + what + " of a node of " +
         follows;
}

void Elimination::setIdle(const Equation& equation) {
  // With u = ū at all remaining components of a support, the equation must hold.
  const Source& source = *equation.source;
  double rest = equation.value, size = std::abs(source.value);
  for (const auto& [row, weight] : equation.weights) {
    if (source.interface >= 0 && !source.isTurned) rest -= weight * source.value;
    size = std::max(size, std::abs(components_.at(row).value));
  }
  for (const auto& [row, other] : solved_) size = std::max(size, std::abs(other.value));
  // In turned axes the remaining components are not known, but their weights are small.
  const double exact = source.interface >= 0 && source.isTurned ? 3 * leastPivot : 1e-9;
  if (std::abs(rest) > exact * size)
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
  for (auto& [origin, share] : equation.origins) share /= weight;
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

}  // namespace squeal::interfaces
