// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/join.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/spread.hpp"
#include "base/system/error.hpp"
#include "eigen/pencil/band.hpp"

namespace squeal::tracking {
namespace {

/// Up to this |tr(Π_i Π_j)|, the subspaces of two eigenvalues count as disjoint.
constexpr double reach = 0.1;

std::size_t rootOf(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

std::vector<std::size_t> byFrequency(const std::vector<linalg::DensePair>& pairs) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) {
    const Complex s = pairs[a].s, t = pairs[b].s;
    // Members of a split pair have the same frequency within round-off.
    return std::abs(s.imag() - t.imag()) > 1e-8 * std::abs(s) ? s.imag() < t.imag()
                                                              : s.real() > t.real();
  });
  return order;
}

/// Returns false for a negative real s in a problem in s², where −s is an eigenvalue too.
bool counted(const linalg::DenseProblem& problem, Complex s) {
  return !problem.damping.empty() || s.imag() != 0 || s.real() >= 0;
}

/// Returns true if |Σ tr(Π_i Π_j) − number| over all pairs of both, with the number of pairs of
/// `a`, is at most 0.5. Returns false also if the sum is unknown.
bool shared(const linalg::Spectrum& a, const linalg::Spectrum& b) {
  const linalg::ComplexMatrix overlaps = a.overlaps(b);
  Complex sum = 0;
  for (const Complex overlap : overlaps.entries()) sum += overlap;
  return std::abs(sum - a.pairs().size()) <= 0.5;  // false for NaN
}

std::optional<linalg::Spectrum> locally(const linalg::DenseProblem& problem,
                                        const linalg::Spectrum& from,
                                        const std::vector<linalg::DensePair>& start,
                                        Complex expected, double isolation) {
  linalg::Cluster cluster = linalg::clusterNear(problem, start, expected, isolation);
  if (!cluster.converged) return {};
  if (problem.damping.empty())  // s and −s have the same vectors
    for (auto& pair : cluster.pairs)
      if (pair.s.imag() < -1e-9 * std::abs(pair.s) || (real(pair.s) && pair.s.real() < 0))
        pair.s = -pair.s;
  linalg::Spectrum found(problem, std::move(cluster.pairs));
  if (!shared(from, found)) return {};
  return found;
}

/// Returns the indices of the pairs of `all` with the largest overlap with `from`, as many as
/// `from` has.
std::vector<std::size_t> closest(const linalg::Spectrum& from, const linalg::Spectrum& all) {
  const linalg::ComplexMatrix overlaps = from.overlaps(all);
  std::vector<std::pair<double, std::size_t>> shares;
  for (std::size_t j = 0; j < all.pairs().size(); ++j) {
    Complex sum = 0;
    for (const Complex overlap : overlaps.column(j)) sum += overlap;
    shares.emplace_back(std::isnan(sum.real()) ? INFINITY : -sum.real(), j);
  }
  std::sort(shares.begin(), shares.end());
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < from.pairs().size() && k < shares.size(); ++k)
    indices.push_back(shares[k].second);
  return indices;
}

}  // namespace

std::optional<linalg::Spectrum> continuedIn(const linalg::DenseProblem& problem,
                                            const linalg::Spectrum& from, Complex expected,
                                            double isolation) {
  if (auto found = locally(problem, from, from.pairs(), expected, isolation)) return found;
  auto pairs = linalg::solveQuadratic(problem, linalg::Vectors::both);
  std::erase_if(pairs, [&](const auto& pair) { return !counted(problem, pair.s); });
  const linalg::Spectrum all(problem, std::move(pairs));
  const auto indices = closest(from, all);
  const linalg::Spectrum whole(problem, chosen(all.pairs(), indices));
  if (!shared(from, whole)) return {};
  const Complex middle = mean(whole.pairs());
  double free = std::abs(middle);
  for (std::size_t j = 0; j < all.pairs().size(); ++j)
    if (std::find(indices.begin(), indices.end(), j) == indices.end())
      free = std::min(free, std::abs(all.pairs()[j].s - middle));
  // If the eigenvalues are closer to each other than to the rest, their subspace is more accurate
  // than the eigenvalues themselves.
  if (auto found = locally(problem, whole, whole.pairs(), middle, free)) return found;
  return whole;
}

std::vector<std::vector<linalg::DensePair>> watchedPairs(MPI_Comm comm,
                                                         const std::vector<ProblemAt>& list,
                                                         const pencil::WatchedBand& band) {
  std::vector<std::vector<linalg::DensePair>> pairs(list.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (auto known = list[i].family->watchedPairs(list[i].friction)) {
      pairs[i] = std::move(*known);
      for (auto& pair : pairs[i])
        for (auto* vector : {&pair.q, &pair.left}) vector->resize(list[i].problem->order());
      std::ranges::sort(pairs[i], [](const auto& a, const auto& b) {
        return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
      });
    } else {
      open.push_back(i);
    }
  auto solved = linalg::spread(comm, open.size(), linalg::Vectors::both, [&](std::size_t k) {
    return linalg::solveQuadratic(*list[open[k]].problem, linalg::Vectors::both,
                                  [&](Complex s) { return band.watches(s); });
  });
  for (std::size_t k = 0; k < open.size(); ++k) pairs[open[k]] = std::move(solved[k]);
  for (std::size_t i = 0; i < list.size(); ++i)
    std::erase_if(pairs[i], [&](const auto& pair) { return !counted(*list[i].problem, pair.s); });
  return pairs;
}

std::optional<linalg::Spectrum> continuedTo(Family& family, double friction,
                                            const linalg::Spectrum& from, Complex expected,
                                            double isolation) {
  const auto problem = family.at(friction);
  if (!problem) return {};
  std::vector<linalg::DensePair> pairs;
  onFirstRank(family.comm(), "", [&] {
    if (auto found = continuedIn(*problem, from, expected, isolation)) pairs = found->pairs();
  });
  linalg::shareFrom(0, family.comm(), pairs, linalg::Vectors::both);
  if (pairs.empty()) return {};
  return linalg::Spectrum(*problem, std::move(pairs));
}

bool neutral(Complex s, bool damped) {
  return std::abs(s.real()) <= (damped ? 1e-10 : 1e-6) * std::abs(s);
}

bool real(Complex s) { return std::abs(s.imag()) <= 1e-6 * std::abs(s); }

bool neutralPair(const std::vector<linalg::DensePair>& two, bool damped) {
  return std::all_of(two.begin(), two.end(),
                     [&](const auto& p) { return neutral(p.s, damped) || (!damped && real(p.s)); });
}

bool splitPair(const std::vector<linalg::DensePair>& two, bool damped) {
  const Complex a = two[0].s, b = two[1].s;
  return !neutral(a, damped) && !real(a) &&
         std::abs(a + std::conj(b)) <= (damped ? 1e-8 : 1e-5) * std::abs(a.real());
}

bool coincide(const std::vector<linalg::DensePair>& pairs) {
  const Complex middle = mean(pairs);
  return std::all_of(pairs.begin(), pairs.end(), [&](const auto& p) {
    return std::abs(p.s - middle) <= 1e-7 * std::abs(middle);
  });
}

std::vector<Group> groups(const linalg::Spectrum& here, const linalg::Spectrum& there) {
  const std::size_t n = here.pairs().size(), all = n + there.pairs().size();
  const linalg::ComplexMatrix overlaps = here.overlaps(there);
  std::vector<std::size_t> parent(all);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n; j < all; ++j)
      if (std::abs(overlaps(i, j - n)) > reach) parent[rootOf(parent, i)] = rootOf(parent, j);
  std::vector<Group> found(all);
  for (std::size_t k = 0; k < all; ++k) {
    Group& group = found[rootOf(parent, k)];
    (k < n ? group.here : group.there).push_back(k < n ? k : k - n);
  }
  std::erase_if(found,
                [](const Group& group) { return group.here.empty() && group.there.empty(); });
  for (auto& group : found) {
    Complex sum = 0;
    for (const auto i : group.here)
      for (const auto j : group.there) sum += overlaps(i, j);
    group.share = std::abs(sum - group.here.size());
  }
  return found;
}

std::vector<std::size_t> assigned(const linalg::Spectrum& here, const linalg::Spectrum& there,
                                  const Group& group) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> list;
  for (std::size_t a = 0; a < group.here.size(); ++a)
    for (std::size_t b = 0; b < group.there.size(); ++b) {
      const double overlap = std::abs(here.overlap(group.here[a], there, group.there[b]));
      list.emplace_back(std::isnan(overlap) ? INFINITY : -overlap, a, b);
    }
  std::sort(list.begin(), list.end());
  std::vector<std::size_t> mate(group.here.size(), group.there.size());
  std::vector<bool> used(group.there.size());
  for (const auto& [size, a, b] : list)
    if (mate[a] == group.there.size() && !used[b]) {
      mate[a] = b;
      used[b] = true;
    }
  return mate;
}

std::vector<std::size_t> ordered(const std::vector<linalg::DensePair>& here,
                                 const std::vector<linalg::DensePair>& there) {
  const auto a = byFrequency(here), b = byFrequency(there);
  std::vector<std::size_t> mate(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) mate[a[k]] = b[k];
  return mate;
}

std::vector<linalg::DensePair> chosen(const std::vector<linalg::DensePair>& all,
                                      const std::vector<std::size_t>& indices) {
  std::vector<linalg::DensePair> list;
  for (const auto i : indices) list.push_back(all[i]);
  return list;
}

double discriminant(const std::vector<linalg::DensePair>& two, bool damped) {
  const Complex half = 0.5 * (two[0].s - two[1].s), middle = mean(two);
  if (damped) return -(half * half).real();
  if (middle == 0.0) return 0;  // both are zero
  return (half * half * middle * middle).real() / std::norm(middle);
}

Complex mean(const std::vector<linalg::DensePair>& pairs) {
  Complex sum = 0;
  for (const auto& pair : pairs) sum += pair.s;
  return sum / pairs.size();
}

}  // namespace squeal::tracking
