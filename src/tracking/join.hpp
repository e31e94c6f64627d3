#pragma once
/// Which eigenvalues of one friction are those of another.
#include "linalg/dense.hpp"
#include "linalg/subspace.hpp"
#include "pencil/band.hpp"
#include "tracking/family.hpp"

namespace squeal::tracking {

/// |Re s| of no account: rounding at multiple eigenvalues where all are neutral or come in pairs
/// ±σ, less where there is damping.
bool neutral(std::complex<double> s, bool damped);
/// Im s of no account.
bool real(std::complex<double> s);
/// Two neutral eigenvalues; of a problem in s², two real s².
bool neutralPair(const std::vector<linalg::DensePair>& two, bool damped);
/// s and −conj s, neither neutral nor real.
bool splitPair(const std::vector<linalg::DensePair>& two, bool damped);
/// All the same but for rounding.
bool coincide(const std::vector<linalg::DensePair>& pairs);

/// A group of eigenvalues here and there that span the same subspace.
struct Group {
  std::vector<std::size_t> here, there;
  double share = 0;  ///< |Σ tr(Π_i Π_j) − number|, small where the subspaces are the same
  bool joined() const {
    return here.size() == there.size() && share < 0.25 * static_cast<double>(here.size());
  }
};

/// Not collective. The smallest groups such that no projector reaches into another one, those that
/// end at the edge included.
std::vector<Group> groups(const linalg::Spectrum& here, const linalg::Spectrum& there);

/// Not collective. Place in `group.there` of the partner of each of `group.here`, largest overlaps
/// first; its size: none is left.
std::vector<std::size_t> assigned(const linalg::Spectrum& here, const linalg::Spectrum& there,
                                  const Group& group);
/// The same by order: frequency, then growth; at a change between neutral and split, the convention
/// of follow().
std::vector<std::size_t> ordered(const std::vector<linalg::DensePair>& here,
                                 const std::vector<linalg::DensePair>& there);

/// Collective. The eigenvalues of several problems that the band watches, Im s ≥ 0, with both
/// vectors, by solveSpread; of a problem in s², of which −s is one with every s, without negative
/// real ones.
std::vector<std::vector<linalg::DensePair>> watchedPairs(
    MPI_Comm comm, const std::vector<linalg::DenseProblem>& problems,
    const pencil::WatchedBand& band);

/// Not collective. The eigenvalues of `from`, one or two of a neighbouring friction, in this
/// problem: by their own subspace begun with `expected` and `isolation` (see clusterNear), or,
/// where that fails or ends elsewhere, out of all eigenvalues. Nothing: none of its eigenvalues
/// continue these. Error: LAPACK fails.
std::optional<linalg::Spectrum> continuedIn(const linalg::DenseProblem& problem,
                                            const linalg::Spectrum& from,
                                            std::complex<double> expected, double isolation);

/// Collective. The same at a friction of the family, on rank 0, so that rounding cannot make the
/// ranks disagree. Nothing also: there is no problem at this friction.
std::optional<linalg::Spectrum> pursued(Family& family, double friction,
                                        const linalg::Spectrum& from, std::complex<double> expected,
                                        double isolation);

/// The entries of `all` with these indices.
std::vector<linalg::DensePair> chosen(const std::vector<linalg::DensePair>& all,
                                      const std::vector<std::size_t>& indices);

/// Positive for two different neutral eigenvalues, negative for a split pair: −((s1 − s2)/2)², real
/// part; of a problem in s²
/// ((s1² − s2²)/4)² / |(s1 + s2)/2|², the same where they meet, and the more analytic.
double discriminant(const std::vector<linalg::DensePair>& two, bool damped);
std::complex<double> mean(const std::vector<linalg::DensePair>& pairs);

}  // namespace squeal::tracking
