#pragma once
/// Which eigenvalues of one friction are those of another.
#include "flutter/family.hpp"
#include "flutter/subspace.hpp"

namespace squeal::flutter {

/// |Re s| of no account: rounding at multiple eigenvalues where all are neutral or come in pairs ±σ, less where there is damping.
bool neutral(std::complex<double> s, bool damped);
/// Two neutral eigenvalues.
bool neutralPair(const std::vector<DensePair>& two, bool damped);
/// s and −conj s, not neutral.
bool splitPair(const std::vector<DensePair>& two, bool damped);
/// All the same but for rounding.
bool coincide(const std::vector<DensePair>& pairs);

/// A group of eigenvalues here and there that span the same subspace.
struct Group {
  std::vector<std::size_t> here, there;
  double share = 0;  ///< |Σ tr(Π_i Π_j) − number|, small where the subspaces are the same
  bool joined() const { return here.size() == there.size() && share < 0.25 * static_cast<double>(here.size()); }
};

/// Not collective. The smallest groups such that no projector reaches into another one, those that end at the edge included.
std::vector<Group> groups(const Spectrum& here, const Spectrum& there);

/// Not collective. Place in `group.there` of the partner of each of `group.here`, largest overlaps first; its size: none is left.
std::vector<std::size_t> assigned(const Spectrum& here, const Spectrum& there, const Group& group);
/// The same by order: frequency, then growth; at a change between neutral and split, the convention of follow().
std::vector<std::size_t> ordered(const std::vector<DensePair>& here, const std::vector<DensePair>& there);

/// The entries of `all` with these indices.
std::vector<DensePair> chosen(const std::vector<DensePair>& all, const std::vector<std::size_t>& indices);

/// −((s1 − s2)/2)², real part: positive for two different neutral eigenvalues, negative for a split pair.
double discriminant(const std::vector<DensePair>& two);
std::complex<double> mean(const std::vector<DensePair>& pairs);

}  // namespace squeal::flutter
