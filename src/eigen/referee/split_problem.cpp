// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/split_problem.hpp"

#include <cmath>

#include "base/system/error.hpp"
#include "base/system/text.hpp"

namespace squeal::referee {
namespace {

constexpr double roundOff = 1e-13;  // pivots of scaled matrices that count as zero

double norm(Mat matrix) {
  PetscReal norm = 0;
  if (matrix) check(MatNorm(matrix, NORM_FROBENIUS, &norm));
  return norm;
}

/// Collective. Returns (A + sign Aᵀ)/2; null if it is zero.
OwnedMat part(Mat matrix, double sign) {
  OwnedMat part;
  check(MatTranspose(matrix, MAT_INITIAL_MATRIX, part.out()));
  check(MatScale(part, sign));
  check(MatAXPY(part, 1, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatScale(part, 0.5));
  if (sign > 0) check(MatSetOption(part, MAT_SYMMETRIC, PETSC_TRUE));
  return norm(part) > 0 ? std::move(part) : OwnedMat();
}

/// Collective. Returns K + σ M, marked as symmetric.
OwnedMat shifted(Mat stiffness, Mat mass, double shift) {
  OwnedMat sum;
  check(MatDuplicate(stiffness, MAT_COPY_VALUES, sum.out()));
  if (shift > 0) check(MatAXPY(sum, shift, mass, DIFFERENT_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_TRUE));
  return sum;
}

}  // namespace

SplitProblem::SplitProblem(const pencil::Pencil& pencil, const sweep::Parameters& at) {
  for (const int power : {0, 1, 2}) {
    const OwnedMat sum = pencil.assembled(power, at);
    if (!sum) continue;
    parts_[power][0] = part(sum, 1);
    parts_[power][1] = part(sum, -1);
    if (power == 0 && norm(sum) > 0) asymmetry_ = 2 * norm(skew(0)) / norm(sum);
  }
  if (!symmetric(0) || !symmetric(2))
    throw Error("options -matrices_<name>_role: the judged problem needs a mass and a stiffness");
  const auto [negative, zero] = factor::inertia(symmetric(2), roundOff);
  if (const PetscInt free = factor::zeroRows(symmetric(2)); negative > 0 || zero > free)
    throw Error(formatted("the symmetric part of the mass has %" PetscInt_FMT
                          " negative and %" PetscInt_FMT " zero eigenvalues, but %" PetscInt_FMT
                          " rows of zeros; the proof needs a mass that is positive definite "
                          "except for unknowns without mass",
                          negative, zero, free));
}

std::vector<pencil::Term> SplitProblem::perturbations() const {
  constexpr double printed = 1e-10;  // digits of exports
  std::vector<pencil::Term> terms;
  const auto add = [&](int power, int part) {
    const OwnedMat& matrix = parts_[power][part];
    if (!matrix || (power != 1 && norm(matrix) <= printed * norm(symmetric(power)))) return;
    pencil::Term term;
    term.matrix = matrix.share();
    term.power = power;
    term.ofFriction = true;
    terms.push_back(std::move(term));
  };
  for (const int power : {0, 1, 2}) add(power, 1);
  add(1, 0);
  return terms;
}

ShiftedSystem shiftedSystem(const SplitProblem& problem, double top) {
  const Mat stiffness = problem.symmetric(0), mass = problem.symmetric(2);
  const auto isDefinite = [&](double shift) {
    const auto [negative, zero] = factor::inertia(shifted(stiffness, mass, shift), roundOff);
    return negative == 0 && zero == 0;
  };
  double shift = 0;
  for (double tried : {0.0, 1. / 256, 1. / 64, 1. / 16, 1. / 4, 1., 4., 16., 64., 256.}) {
    shift = tried * top * top;
    if (isDefinite(shift)) {
      shift *= 2;  // not barely definite
      OwnedMat copy;
      check(MatDuplicate(mass, MAT_COPY_VALUES, copy.out()));
      check(MatSetOption(copy, MAT_SYMMETRIC, PETSC_TRUE));
      return {factor::AssociatedSystem(
                  shifted(stiffness, mass, shift), std::move(copy),
                  shift > 0 ? "shifted symmetric stiffness" : "symmetric part of the stiffness"),
              shift};
    }
  }
  // With a definite mass a larger shift would do, but no bound relative to it is below 1.
  const bool isMassless = factor::zeroRows(mass) > 0;
  throw Error(
      formatted("the symmetric part of the stiffness plus %.3g times the mass is not "
                "positive definite; %s",
                shift,
                isMassless ? "is an unknown without stiffness and mass?"
                           : "the unsymmetric part is too large for a proof, as with "
                             "friction on a soft layer"));
}

}  // namespace squeal::referee
