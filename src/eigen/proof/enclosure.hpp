// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Discs that each contain exactly one eigenvalue of P (kept.hpp), and the judgement of a list of
/// eigenvalues by these discs.
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/proof/contour.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/diagonal_form.hpp"

namespace squeal::proof {

/// The result of the proof for one eigenvalue of P_VV.
enum class Isolation {
  single,      ///< each disc with a radius from inner to outer holds exactly one eigenvalue of P
  indefinite,  ///< δ (definiteness()) is not positive at the eigenvalue
  neighbour,   ///< another eigenvalue is too near, given the coupling to C
};

struct Enclosure {
  Complex s;  ///< eigenvalue of P_VV, the centre, rad/s
  Isolation isolation = Isolation::neighbour;
  double inner = 0, outer = 0;  ///< radii, rad/s
  bool neutral = false;         ///< the eigenvalue of P is proved to be imaginary
};

/// Not collective. Returns an enclosure for each wanted eigenvalue of P_VV in the region, by
/// default for all; none if the form is not regular. If `count` is proved for this region, an
/// eigenvalue whose vectors are hardly coupled to C takes almost no time. Any other eigenvalue
/// takes as much time as one disc of proveCount().
std::vector<Enclosure> enclose(const DiagonalForm& form, const LeftOut& bounds,
                               const Region& region, const CountProof& count = {},
                               const linalg::EigenvalueFilter& wanted = {});

/// Agreement of an entry of a list with the eigenvalues of P. If the count is proved and all
/// enclosures are single, the discs of the inner radii contain all eigenvalues in the region.
enum class Agreement {
  right,     ///< its distance from a centre is at most the inner radius plus the tolerance
  inexact,   ///< farther from the centre, but in the disc of the outer radius
  repeated,  ///< as close as `right` or `inexact`, but the discs there have other entries
  wrong,     ///< in none of the discs
  unproved,  ///< the enclosure of the nearest eigenvalue of P_VV is not single
  outside,   ///< not in the region, and not `right`
};

struct JudgedEntry {
  Agreement agreement = Agreement::wrong;
  /// Radius of the disc about the entry that holds exactly one eigenvalue of P; 0 if none is known.
  double radius = 0;
  /// Index of the enclosure that the entry belongs to, or of the nearest one; none if that is not
  /// single.
  std::optional<std::size_t> disc = {};
};

struct JudgedList {
  std::vector<JudgedEntry> entries;
  std::vector<Enclosure> missing;  ///< single enclosures without an entry
  /// Enclosures that are not single and not the nearest ones of any entry.
  std::vector<Enclosure> unresolved;
};

/// Not collective. Judges a list of eigenvalues with Im s ≥ 0 by the enclosures of the region. The
/// list must contain a multiple eigenvalue as often as its multiplicity. `tolerance`, rad/s, is the
/// largest error that entries at the top of the region should have. Eigenvalues closer to each
/// other than the tolerance relative to |s| take one entry each, in any order.
JudgedList judge(std::span<const Complex> list, const std::vector<Enclosure>& enclosures,
                 const Region& region, double tolerance);

}  // namespace squeal::proof
