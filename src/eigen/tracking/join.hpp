// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Identification of the eigenvalues at one friction with those at another.
#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/pencil/band.hpp"
#include "eigen/tracking/family.hpp"

namespace squeal::tracking {

/// Returns true if |Re s| is at most 1e-6 |s|, or 1e-10 |s| in a damped problem. The first bound is
/// larger because round-off splits multiple eigenvalues in problems in s².
bool neutral(Complex s, bool damped);
/// Returns true if |Im s| is at most 1e-6 |s|.
bool real(Complex s);
/// Returns true if both eigenvalues are neutral or, in a problem in s², if both s² are real.
bool neutralPair(const std::vector<linalg::DensePair>& two, bool damped);
/// Returns true if the eigenvalues are s and −conj s, neither neutral nor real.
bool splitPair(const std::vector<linalg::DensePair>& two, bool damped);
/// Returns true if all eigenvalues are equal within round-off.
bool coincide(const std::vector<linalg::DensePair>& pairs);

/// A group of eigenvalues at one friction ("here") and a group at another ("there") whose subspaces
/// overlap.
struct Group {
  std::vector<std::size_t> here, there;  ///< indices of pairs
  double share = 0;  ///< |Σ tr(Π_i Π_j) − number here|, small if the subspaces are the same
  /// Returns true if both groups have the same number of members and nearly the same subspace.
  bool joined() const { return here.size() == there.size() && share < 0.25 * here.size(); }
};

/// Not collective. Returns the smallest groups between which all |tr(Π_i Π_j)| are at most 0.1. The
/// list includes groups with members on only one side.
std::vector<Group> groups(const linalg::Spectrum& here, const linalg::Spectrum& there);

/// Not collective. Returns the place in `group.there` of the partner of each member of
/// `group.here`, assigned in the order of descending overlaps. The place is the size of
/// `group.there` if no partner is left.
std::vector<std::size_t> assigned(const linalg::Spectrum& here, const linalg::Spectrum& there,
                                  const Group& group);
/// Returns the same for two lists of equal length by their order: ascending frequency, then
/// descending growth rate. At a change between neutral and split this is the convention of
/// track().
std::vector<std::size_t> ordered(const std::vector<linalg::DensePair>& here,
                                 const std::vector<linalg::DensePair>& there);

/// The problem of a family at a friction; borrowed.
struct ProblemAt {
  Family* family;
  double friction;
  const linalg::DenseProblem* problem;
};

/// Collective. Returns the watched eigenvalues with Im s ≥ 0, by ascending Im s, with both vectors,
/// of these problems. It takes known pairs from the family and distributes the other problems over
/// the ranks. In a problem in s², where −s is an eigenvalue with every s, it omits negative real
/// ones.
std::vector<std::vector<linalg::DensePair>> watchedPairs(MPI_Comm comm,
                                                         const std::vector<ProblemAt>& list,
                                                         const pencil::WatchedBand& band);

/// Not collective. Returns the eigenvalues of this problem that continue those of `from`, one or
/// two at a neighbouring friction. It searches in their own subspace, from `expected` and
/// `isolation` (see clusterNear()). If that fails or converges to other eigenvalues, it chooses
/// from all eigenvalues. Returns nothing if none continue those of `from`. Throws Error if LAPACK
/// fails.
std::optional<linalg::Spectrum> continuedIn(const linalg::DenseProblem& problem,
                                            const linalg::Spectrum& from, Complex expected,
                                            double isolation);

/// Collective. Returns the same at a friction of the family, computed on rank 0, so round-off
/// cannot make the ranks disagree. It also returns nothing at a friction without a problem.
std::optional<linalg::Spectrum> continuedTo(Family& family, double friction,
                                            const linalg::Spectrum& from, Complex expected,
                                            double isolation);

/// Returns the entries of `all` with these indices.
std::vector<linalg::DensePair> chosen(const std::vector<linalg::DensePair>& all,
                                      const std::vector<std::size_t>& indices);

/// Returns a function of two eigenvalues that is analytic in the friction, positive for two
/// different neutral eigenvalues and negative for a split pair [M.44, M.45]:
///   Re[ −((s1 − s2)/2)² ],   or in a problem in s²   Re[ ((s1² − s2²)/4)² ] / |(s1 + s2)/2|².
/// Both have the same zero.
double discriminant(const std::vector<linalg::DensePair>& two, bool damped);
Complex mean(const std::vector<linalg::DensePair>& pairs);

}  // namespace squeal::tracking
