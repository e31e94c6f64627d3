// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/reducedfamily.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::tracking {
namespace {

/// Computes
///   sum += factor · part,
/// where a `part` of a smaller basis is extended by zeros.
void add(linalg::DenseProblem& sum, double factor, const linalg::DenseProblem& part) {
  const PetscInt m = sum.order();
  for (const auto matrix : {&linalg::DenseProblem::mass, &linalg::DenseProblem::damping,
                            &linalg::DenseProblem::stiffness}) {
    const linalg::DenseMatrix& from = part.*matrix;
    linalg::DenseMatrix& to = sum.*matrix;
    if (!from.empty() && to.empty()) to = linalg::DenseMatrix(m, m);
    linalg::addExtended(to, factor, from);
  }
}

}  // namespace

sweep::Parameters ReducedFamily::point(double friction) const {
  sweep::Parameters at = line_;
  at.friction = friction;
  return at;
}

/// Returns the projection of the terms common to all points of the line.
linalg::DenseProblem ReducedFamily::ofAll(double friction) const {
  return reduced_.project(point(friction), source_.set);
}

std::optional<linalg::DenseProblem> ReducedFamily::at(double friction) {
  constexpr std::size_t most = 32;  // a node is two or three dense matrices
  if (source_.local || known(friction)) return near(friction);
  const auto problem = source_.at(point(friction));
  if (!problem) return {};
  Node node{friction, reduced_.basisSize(), reduced_.projectOwn(*problem)};
  linalg::DenseProblem sum = ofAll(friction);
  add(sum, 1, node.own);
  if (nodes_.size() < most) storeNode(std::move(node));
  return sum;
}

linalg::Spectrum ReducedFamily::shared(double friction,
                                       const std::vector<linalg::DensePair>& pairs) {
  const auto problem = source_.local ? std::nullopt : source_.at(point(friction));
  std::vector<linalg::DensePair> lifted;
  for (const auto& pair : pairs)
    lifted.push_back(
        {pair.s, reduced_.lifted(source_.set, pair.q), reduced_.lifted(source_.set, pair.left)});
  const auto whole = problem ? reduced_.projectOnAll(*problem)
                             : reduced_.projectOnAll(point(friction), source_.set);
  return linalg::Spectrum(whole, std::move(lifted));
}

/// Returns true if there is a node at this friction in the present basis.
bool ReducedFamily::known(double friction) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return node.friction == friction && node.basisSize == reduced_.basisSize();
  });
}

void ReducedFamily::addFrictions(const std::vector<double>& frictions) {
  if (source_.local) return;
  for (double friction : frictions)
    if (!known(friction))
      if (const auto problem = source_.at(point(friction)))
        storeNode({friction, reduced_.basisSize(), reduced_.projectOwn(*problem)});
}

/// Stores the node. It replaces one at the same friction, which belongs to a smaller basis.
void ReducedFamily::storeNode(Node node) {
  std::erase_if(nodes_, [&](const Node& other) { return other.friction == node.friction; });
  nodes_.push_back(std::move(node));
}

/// Returns the smallest distance of nodes: with closer ones the slope of the interpolant would be
/// round-off.
double ReducedFamily::closest() const {
  double largest = 0;
  for (const auto& node : nodes_) largest = std::max(largest, std::abs(node.friction));
  return 1e-4 * largest;
}

/// Returns at most six nearest nodes that are not too close to each other.
std::vector<const ReducedFamily::Node*> ReducedFamily::nodesFor(double friction) const {
  constexpr std::size_t most = 6;
  std::vector<const Node*> all, chosen;
  for (const auto& node : nodes_) all.push_back(&node);
  std::stable_sort(all.begin(), all.end(), [&](const Node* a, const Node* b) {
    return std::abs(a->friction - friction) < std::abs(b->friction - friction);
  });
  const double apart = closest();
  for (const Node* node : all)
    if (chosen.size() < most && std::all_of(chosen.begin(), chosen.end(), [&](const Node* other) {
          return std::abs(node->friction - other->friction) > apart;
        }))
      chosen.push_back(node);
  return chosen;
}

std::optional<linalg::DenseProblem> ReducedFamily::near(double friction) {
  if (source_.local) return ofAll(friction);
  if (nodes_.empty()) return {};
  linalg::DenseProblem sum = ofAll(friction);
  const auto nodes = nodesFor(friction);
  for (const Node* node : nodes) {  // Lagrange interpolation
    double weight = 1;
    for (const Node* other : nodes)
      if (other != node)
        weight *= (friction - other->friction) / (node->friction - other->friction);
    if (weight != 0) add(sum, weight, node->own);
  }
  return sum;
}

ReducedFamily::LocatedProblems ReducedFamily::problemsOf(
    const std::vector<PairsAtFriction>& located) const {
  LocatedProblems result;
  for (std::size_t k = 0; k < located.size(); ++k)
    if (auto problem = source_.at(point(located[k].friction))) {
      result.list.emplace_back(std::move(*problem), located[k].pairs);
      result.places.push_back(k);
    }
  return result;
}

namespace {

/// Returns the errors of the pairs at these places of a longer list, with NaN elsewhere.
reduction::Improvement placed(const reduction::Improvement& found,
                              const std::vector<std::size_t>& places, std::size_t count) {
  reduction::Improvement result{found.changed, std::vector<double>(count, NAN),
                                std::vector<double>(count, NAN)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    result.backwardError[places[i]] = found.backwardError[i];
    result.roundOff[places[i]] = found.roundOff[i];
  }
  return result;
}

}  // namespace

reduction::Improvement ReducedFamily::errorsOf(const std::vector<PairsAtFriction>& located) {
  const auto [list, places] = problemsOf(located);
  return placed(reduced_.errorsOf(list), places, located.size());
}

reduction::Improvement ReducedFamily::improve(const std::vector<PairsAtFriction>& located) {
  const auto [list, places] = problemsOf(located);
  auto result = placed(reduced_.improve(list), places, located.size());
  if (source_.local) return result;
  result.changed = true;
  const double apart =
      closest();  // older nodes must not be near these, which may be near each other
  for (std::size_t place : places)
    std::erase_if(nodes_, [&](const Node& node) {
      return std::abs(node.friction - located[place].friction) <= apart;
    });
  for (std::size_t i = 0; i < places.size(); ++i)
    nodes_.push_back(
        {located[places[i]].friction, reduced_.basisSize(), reduced_.projectOwn(list[i].first)});
  return result;
}

}  // namespace squeal::tracking
