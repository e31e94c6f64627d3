// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Identification of the eigenvalues at one friction with those at another.
#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/pencil/band.hpp"
#include "eigen/tracking/family.hpp"

namespace squeal::tracking {

/// Returns true if |Re s| is at most 1e-6 |s| in a problem in s², or 1e-10 |s| in a damped problem.
/// The first bound is larger because round-off splits multiple eigenvalues in problems in s².
bool neutral(Complex s, bool damped);
/// Returns true if |Im s| is at most 1e-6 |s|.
bool real(Complex s);
/// Returns true if both eigenvalues are neutral or, in a problem in s², if both s² are real.
bool neutralPair(const std::vector<linalg::DensePair>& two, bool damped);
/// Returns true if the eigenvalues are s and −conj s, neither neutral nor real.
bool splitPair(const std::vector<linalg::DensePair>& two, bool damped);
/// Returns true if all eigenvalues are equal within round-off.
bool coincide(const std::vector<linalg::DensePair>& pairs);

/// A group of eigenvalues at one friction ("here") and a group at another ("there") with
/// overlapping subspaces. Π_i and Π_j denote the spectral projectors of eigenvalues here and there.
struct Group {
  std::vector<std::size_t> here, there;  ///< indices of pairs
  double share = 0;  ///< |Σ tr(Π_i Π_j) − here.size()|, small if the subspaces are equal
  /// Returns true if both groups have the same number of members and nearly the same subspace.
  bool joined() const { return here.size() == there.size() && share < 0.25 * here.size(); }
};

/// Not collective. Divides the eigenvalues into the smallest groups such that |tr(Π_i Π_j)| is at
/// most 0.1 for eigenvalues of different groups. Some groups may have members at only one of the
/// frictions.
std::vector<Group> groups(const linalg::Spectrum& here, const linalg::Spectrum& there);

/// Not collective. Returns for each member of `group.here` the index of its partner in
/// `group.there`. Partners are assigned in the order of descending overlaps. The index is the size
/// of `group.there` if no partner is left.
std::vector<std::size_t> assigned(const linalg::Spectrum& here, const linalg::Spectrum& there,
                                  const Group& group);
/// Returns for each entry of `here` the index of its partner in `there`, a list of equal length.
/// Partners have the same place in the order of ascending frequency, then descending growth rate.
/// This is the convention of track() where two neutral eigenvalues become a split pair, or the
/// reverse.
std::vector<std::size_t> ordered(const std::vector<linalg::DensePair>& here,
                                 const std::vector<linalg::DensePair>& there);

/// The problem of a family at a friction; borrowed.
struct ProblemAt {
  Family* family;
  double friction;
  const linalg::DenseProblem* problem;
};

/// Collective. Returns for each problem its watched eigenvalues with Im s ≥ 0, by ascending Im s,
/// with right and left vectors. Known pairs come from the family; the other problems are
/// distributed over the ranks. In a problem in s², −s is an eigenvalue whenever s is, so negative
/// real ones are omitted.
std::vector<std::vector<linalg::DensePair>> watchedPairs(MPI_Comm comm,
                                                         const std::vector<ProblemAt>& list,
                                                         const pencil::WatchedBand& band);

/// Not collective. `from` has one or two eigenvalues at a neighbouring friction. Returns the
/// eigenvalues of `problem` that continue them; none if there are no such eigenvalues. The search
/// starts from the subspace of `from`. `expected` is an estimate of the mean of the result, and
/// `isolation` the distance of this mean from other eigenvalues (see clusterNear()). If this search
/// fails or converges to other eigenvalues, the result is chosen from all eigenvalues. Throws Error
/// if LAPACK fails.
std::optional<linalg::Spectrum> continuedIn(const linalg::DenseProblem& problem,
                                            const linalg::Spectrum& from, Complex expected,
                                            double isolation);

/// Collective. Does the same at a friction of the family, on rank 0, so round-off cannot make the
/// ranks disagree. Also returns none if the family has no problem at this friction.
std::optional<linalg::Spectrum> continuedTo(Family& family, double friction,
                                            const linalg::Spectrum& from, Complex expected,
                                            double isolation);

/// Returns the entries of `all` with these indices.
std::vector<linalg::DensePair> chosen(const std::vector<linalg::DensePair>& all,
                                      const std::vector<std::size_t>& indices);

/// Returns a function of two eigenvalues that is analytic in the friction, positive for two
/// different neutral eigenvalues and negative for a split pair [M.44, M.45]:
///   Re[ −((s1 − s2)/2)² ],   or in a problem in s²   Re[ ((s1² − s2²)/4)² ] / |(s1 + s2)/2|².
/// Both forms have the same zero.
double discriminant(const std::vector<linalg::DensePair>& two, bool damped);
Complex mean(const std::vector<linalg::DensePair>& pairs);

}  // namespace squeal::tracking
