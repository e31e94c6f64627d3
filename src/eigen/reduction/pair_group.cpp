// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/pair_group.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace squeal::reduction {

using linalg::DensePair;
using linalg::DenseProblem;

namespace {

constexpr double neighbourhood = 2.5;  // of the reach of the members

void append(ComplexMatrix& x, const ComplexMatrix& more) {
  for (PetscInt j = 0; j < more.columns(); ++j) x.append(more.column(j));
}

}  // namespace

PairGroup::PairGroup(const Companion& companion, std::vector<DensePair>& pairs,
                     const std::vector<UnconvergedPair>& open)
    : companion_(companion), pairs_(pairs) {
  for (const auto& one : open) {
    members_.push_back(one.pair);
    wanted_.right.push_back(one.right);
    wanted_.left.push_back(one.left);
  }
  double low = std::numeric_limits<double>::infinity(), high = -low, real = 0;
  for (const auto j : members_) {
    real += pairs_[j].s.real() / members_.size();
    low = std::min(low, pairs_[j].s.imag());
    high = std::max(high, pairs_[j].s.imag());
  }
  const Complex middle(real, 0.5 * (low + high));
  for (const auto j : members_) reach_ = std::max(reach_, std::abs(pairs_[j].s - middle));
  reach_ = std::max(reach_, 1e-3 * std::abs(middle));
  shift_ = middle + reach_ * Complex(0.1, 0.05);  // near an eigenvalue, not on it
  for (std::size_t j = 0; j < pairs_.size(); ++j)
    if (std::ranges::find(members_, j) == members_.end() &&
        std::abs(pairs_[j].s - middle) <= neighbourhood * reach_)
      neighbours_.push_back(j);
}

PairGroup::Outcome PairGroup::iterate(bool forced) {
  constexpr int patience = 2;
  Outcome outcome = isDone() ? Outcome::untouched : Outcome::unfinished;
  if (outcome == Outcome::untouched && !forced) return outcome;
  for (int k = 0; k < patience && outcome != Outcome::done; ++k) {
    if (!step()) return Outcome::failed;
    outcome = isDone() ? Outcome::done : Outcome::unfinished;
  }
  inverse_.reset();  // only one of these large matrices exists at a time
  return outcome;
}

/// Returns true if the residuals are within their tolerances.
bool PairGroup::isDone() {
  const Residuals now = residuals();
  if (first_.right.empty()) {
    first_ = now;
    roundOff_ = roundOff();
  }
  for (std::size_t j = 0; j < members_.size(); ++j)
    if (now.right[j] > std::max(wanted_.right[j] * first_.right[j], roundOff_) ||
        now.left[j] > std::max(wanted_.left[j] * first_.left[j], roundOff_))
      return false;
  return true;
}

/// Projects the operator on the vectors of the group and its neighbours, and on the operator times
/// those of the group, right and left. Replaces the members by their Ritz vectors times the
/// operator. Returns false on failure.
bool PairGroup::step() {
  if (!inverse_) inverse_.emplace(companion_, shift_);
  if (!inverse_->regular()) return false;
  std::vector<const DensePair*> members, known;
  for (const auto j : members_) members.push_back(&pairs_[j]);
  known = members;
  for (const auto j : neighbours_) known.push_back(&pairs_[j]);
  Subspaces subspaces{.right = companion_.right(known),
                      .left = companion_.left(known),
                      .ritzRight = {},
                      .ritzLeft = {}};
  ComplexMatrix trial = subspaces.right, test = subspaces.left;
  append(trial, inverse_->apply(companion_.right(members)));
  append(test, inverse_->applyAdjoint(companion_.left(members)));
  for (auto* space : {&trial, &test}) {
    if (space->columns() > space->rows()) space->resizeColumns(space->rows());
    normalise(*space);
    linalg::orthonormalise(*space);
  }
  const ComplexMatrix images = inverse_->apply(trial);
  const linalg::Lu<Complex> mass(linalg::adjointProduct(test, trial));
  if (mass.pivotRatio() == 0) return false;
  ComplexMatrix projected = linalg::adjointProduct(test, images);
  mass.solve(projected);
  linalg::ComplexEigen ritz = linalg::eigen(std::move(projected));
  mass.solve(ritz.left, true);
  subspaces.ritzRight = linalg::product(trial, ritz.right);
  subspaces.ritzLeft = linalg::product(test, ritz.left);
  const auto mine = assigned(subspaces);
  ComplexMatrix x(trial.columns()), y(trial.columns());
  for (std::size_t j = 0; j < members_.size(); ++j) {
    if (!mine[j] || ritz.value[*mine[j]] == 0.0) return false;
    x.append(std::span<const Complex>(ritz.right.column(*mine[j])));
    y.append(std::span<const Complex>(ritz.left.column(*mine[j])));
  }
  x = linalg::product(rowsOf(images, 0, companion_.order()), x);
  y = inverse_->leftVectors(linalg::product(test, y));
  for (std::size_t j = 0; j < members_.size(); ++j)
    if (!replace(j, shift_ + 1.0 / ritz.value[*mine[j]], x, y)) return false;
  return true;
}

/// Sets the pair of a member to s and its columns of x and y, scaled to the 2-norm 1. Returns false
/// if that is impossible.
bool PairGroup::replace(std::size_t member, Complex s, const ComplexMatrix& x,
                        const ComplexMatrix& y) {
  DensePair& pair = pairs_[members_[member]];
  pair.s = s;
  for (const auto& [to, from] : {std::pair{&pair.q, &x}, std::pair{&pair.left, &y}}) {
    const double size = length(from->column(member));
    if (!(size > 0) || !std::isfinite(size)) return false;
    for (std::size_t i = 0; i < to->size(); ++i) (*to)[i] = (*from)(i, member) / size;
  }
  return true;
}

PairGroup::Residuals PairGroup::residuals() const {
  return {residuals(&DensePair::q, false), residuals(&DensePair::left, true)};
}

/// Returns the lengths of the residuals of one side, [member].
std::vector<double> PairGroup::residuals(std::vector<Complex> DensePair::*vector, bool left) const {
  const DenseProblem& problem = companion_.problem();
  ComplexMatrix x(companion_.order());
  for (const auto j : members_) x.append(std::span<const Complex>(pairs_[j].*vector));
  const ComplexMatrix k = linalg::product(problem.stiffness, x, left),
                      z = linalg::product(problem.damping, x, left),
                      m = linalg::product(problem.mass, x, left);
  std::vector<double> lengths;
  for (std::size_t j = 0; j < members_.size(); ++j) {
    const Complex s = left ? std::conj(pairs_[members_[j]].s) : pairs_[members_[j]].s;
    double sum = 0;
    for (PetscInt i = 0; i < x.rows(); ++i) sum += std::norm(k(i, j) + s * (z(i, j) + s * m(i, j)));
    lengths.push_back(std::sqrt(sum) / length(x.column(j)));
  }
  return lengths;
}

/// Returns the length of a residual that may consist only of round-off, in the residual or in a
/// solve.
double PairGroup::roundOff() const {
  constexpr double margin = 100;
  const DenseProblem& problem = companion_.problem();
  double largest = 0;
  for (const auto j : members_) largest = std::max(largest, std::abs(pairs_[j].s));
  const auto norm = [](const linalg::DenseMatrix& a) {
    return std::sqrt(linalg::squaredLength(a.entries()));
  };
  return margin * std::numeric_limits<double>::epsilon() *
         (norm(problem.stiffness) + largest * norm(problem.damping) +
          largest * largest * norm(problem.mass));
}

/// Assigns each Ritz pair to at most one known pair, in the order of descending trace of the
/// product of spectral projectors [M.41]. Returns the Ritz pairs of the members, [member].
std::vector<std::optional<std::size_t>> PairGroup::assigned(const Subspaces& subspaces) const {
  const auto& [right, left, ritzRight, ritzLeft] = subspaces;
  const ComplexMatrix there = linalg::adjointProduct(left, ritzRight),
                      back = linalg::adjointProduct(ritzLeft, right);
  const auto own = [](const ComplexMatrix& l, const ComplexMatrix& r, PetscInt j) {
    return innerProduct(std::span<const Complex>(l.column(j)),
                        std::span<const Complex>(r.column(j)));
  };
  std::multimap<double, std::pair<std::size_t, std::size_t>, std::greater<>> traces;
  for (PetscInt k = 0; k < there.columns(); ++k) {
    const Complex ofRitz = own(ritzLeft, ritzRight, k);
    for (PetscInt j = 0; j < there.rows(); ++j)
      if (const double trace = std::abs(there(j, k) * back(k, j) / (own(left, right, j) * ofRitz));
          std::isfinite(trace))
        traces.emplace(trace, std::pair{j, k});
  }
  std::vector<std::optional<std::size_t>> of(there.rows());
  std::vector<bool> taken(there.columns(), false);
  for (const auto& [trace, both] : traces) {
    const auto [j, k] = both;
    if (of[j] || taken[k]) continue;
    of[j] = k;
    taken[k] = true;
  }
  of.resize(members_.size());
  return of;
}

std::vector<std::vector<UnconvergedPair>> groupsOf(const std::vector<DensePair>& pairs,
                                                   std::vector<UnconvergedPair> open) {
  constexpr double widestPart = 0.2;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const auto& pair : pairs) {
    low = std::min(low, pair.s.imag());
    high = std::max(high, pair.s.imag());
  }
  const auto place = [&](const UnconvergedPair& one) { return pairs[one.pair].s.imag(); };
  std::ranges::sort(open, {}, place);
  std::vector<std::vector<UnconvergedPair>> groups;
  for (const auto& one : open) {
    if (groups.empty() || place(one) - place(groups.back().front()) > widestPart * (high - low))
      groups.emplace_back();
    groups.back().push_back(one);
  }
  return groups;
}

}  // namespace squeal::reduction
