// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that P(s) has as many eigenvalues in a region as its block P_VV(s) (kept.hpp).
/// docs/method.md, section 13, states the theorem and defines φ and δ.
#include "eigen/proof/contour.hpp"
#include "eigen/proof/diagonal_form.hpp"

namespace squeal::proof {

enum class Verdict {
  proved,
  indefinite,    ///< δ is not positive: V has too few modes, or the terms on C are too large
  irregular,     ///< P_VV(top) is singular, or the deviation Δ of the diagonal form is not small
  edge,          ///< an eigenvalue of P_VV is nearer to the boundary than 10⁻⁶ of the top
  ratio,         ///< φ is not below 1 at `place`: the coupling of V and C is too strong
  tooManyDiscs,  ///< at `place`, the largest number of expansions is reached
};

struct CountProof {
  Verdict verdict = Verdict::irregular;
  PetscInt count = 0;  ///< eigenvalues s of P_VV in the region, with multiplicities and conjugates
  double definiteness = 0;  ///< δ
  double ratio = 0;         ///< largest φ at the centres of discs
  double bound = 0;         ///< largest bound of ‖P_CV P_VV⁻¹ P_VC‖ on the discs
  Complex place = 0;        ///< where `ratio` is reached, rad/s; the point of failure if not proved
  /// Distance of the boundary from the nearest eigenvalue, as a fraction of the top.
  double edgeDistance = 0;
  PetscInt discs = 0;        ///< number of discs on the upper half of the boundary
  PetscInt evaluations = 0;  ///< expansions: one for each disc, and one for each failed attempt
};

/// Not collective. Proves the count for the region, if the bounds suffice, with at most `largest`
/// expansions. If the verdict is `proved`, P has exactly `count` eigenvalues in the region and none
/// on its boundary. The proof requires δ > 0 and φ < 1 with a margin of 10⁻⁶, which allows for
/// round-off in the given data.
CountProof proveCount(const DiagonalForm& form, const LeftOut& bounds, const Region& region,
                      PetscInt largest = 400);

/// The regions of damped problems that are chosen automatically end at Re s = −a, with a between
/// these fractions of the top.
inline constexpr double leastLeft = 0.02, mostLeft = 0.2;

/// A count with its region.
struct PlacedCount {
  Region region;
  CountProof count;
};

/// Not collective. Proves the count for a region up to `top`, rad/s, of a problem with damping. The
/// left edge is at about Re s = −`left` · top, in a gap of the eigenvalues; if `left` is 0, left of
/// the eigenvalues of the list, or, if the proof then fails, at the least distance. With left ≥ 1
/// the region is the whole disc.
PlacedCount proveDamped(const DiagonalForm& form, const LeftOut& bounds, double top, double left,
                        std::span<const Complex> list, PetscInt largest);

}  // namespace squeal::proof
