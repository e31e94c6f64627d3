// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/norms.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/error.hpp"

namespace squeal::referee {
namespace {

constexpr int mostTrials = 60;

/// Collective. Returns the largest |A_ij| / √(H_ii H_jj), which no bound of A in H is below.
double lowerBound(Mat matrix, Mat energy) {
  const OwnedVec scale = rightVector(energy);
  check(MatGetDiagonal(energy, scale));
  check(VecPow(scale, -0.5));
  OwnedMat scaled;
  check(MatDuplicate(matrix, MAT_COPY_VALUES, scaled.out()));
  check(MatDiagonalScale(scaled, scale, scale));
  const OwnedVec largest = rightVector(energy);
  check(MatGetRowMaxAbs(scaled, largest, nullptr));
  PetscReal bound = 0;
  check(VecMax(largest, nullptr, &bound));
  return bound;
}

/// Collective. Returns true if g H + sign A ≥ 0.
bool isBounded(Mat matrix, Mat energy, double g, double sign) {
  OwnedMat sum;
  check(MatDuplicate(energy, MAT_COPY_VALUES, sum.out()));
  check(MatScale(sum, g));
  check(MatAXPY(sum, sign, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_TRUE));
  return factor::inertia(sum).negative == 0;
}

/// Collective. Returns true if |xᵀ A y| ≤ g √(xᵀ H x yᵀ H y).
bool isBoundedSkew(Mat skew, Mat energy, double g) {
  OwnedMat scaled, transposed, nested, whole;
  check(MatDuplicate(energy, MAT_COPY_VALUES, scaled.out()));
  check(MatScale(scaled, g));
  check(MatTranspose(skew, MAT_INITIAL_MATRIX, transposed.out()));
  Mat blocks[] = {scaled, skew, transposed, scaled};
  check(MatCreateNest(commOf(energy), 2, nullptr, 2, nullptr, blocks, nested.out()));
  check(MatConvert(nested, MATAIJ, MAT_INITIAL_MATRIX, whole.out()));
  check(MatSetOption(whole, MAT_SYMMETRIC, PETSC_TRUE));
  return factor::inertia(whole).negative == 0;
}

/// Returns a g ≥ start that is confirmed. Unless g · weight is negligible, it is less than 1.2
/// times the smallest one.
template <class Confirmed>
double smallest(double start, double weight, const Confirmed& confirmed) {
  constexpr double negligible = 5e-3, close = 1.2;
  double g = start, ratio = start * weight < negligible ? 4 : 2;
  for (int i = 0; !confirmed(g); ++i, g *= ratio)
    if (i == mostTrials)
      throw Error("a damping or gyroscopic matrix has no bound in the energy of the stiffness");
  while (ratio > close && g > start && g * weight > negligible) {
    ratio = std::sqrt(ratio);
    if (confirmed(g / ratio)) g /= ratio;
  }
  return g;
}

}  // namespace

void boundOthers(const SplitProblem& problem, const factor::AssociatedSystem& system, double top,
                 double left, proof::LeftOut& bounds) {
  if (bounds.mass == 0) return;  // nothing is left out
  OwnedMat energy;               // H
  check(MatDuplicate(system.k0(), MAT_COPY_VALUES, energy.out()));
  check(MatAXPY(energy, 1 / bounds.mass, system.m0(), DIFFERENT_NONZERO_PATTERN));
  const auto skewBound = [&](Mat matrix, double weight) {
    if (!matrix) return 0.0;
    return 2 * smallest(lowerBound(matrix, energy), 2 * weight,
                        [&](double g) { return isBoundedSkew(matrix, energy, g); });
  };
  bounds.skewMass = skewBound(problem.skew(2), top * top);
  bounds.gyroscopic = skewBound(problem.skew(1), top);
  const Mat damping = problem.symmetric(1);
  if (!damping) return;
  const double start = lowerBound(damping, energy);
  const double above =
      2 * smallest(start, 2 * left, [&](double g) { return isBounded(damping, energy, g, -1); });
  // Round-off of a semi-definite C, or a C that feeds motions: C + κ H ≥ 0.
  const double below = 2 * smallest(1e-9 * start, 2 * top,
                                    [&](double g) { return isBounded(damping, energy, g, 1); });
  bounds.damping = above + below;  // of C + κ H
  bounds.rest[1] += below;
}

}  // namespace squeal::referee
