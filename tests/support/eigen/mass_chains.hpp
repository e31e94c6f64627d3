// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Chains of masses whose eigenvalues are known in closed form, of any multiplicity, with and
/// without damping.
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "eigen/pencil/pencil.hpp"
#include "support/eigen/spectrum.hpp"

namespace squeal::test {

/// `copies` equal chains of `length` masses m between walls, springs k, dampers proportional: Z = α
/// M + β K. With
///   κ_j = 4 k/m sin²(jπ / (2 (length + 1))):  s² + (α + β κ_j) s + κ_j = 0, `copies` times.
struct Chains {
  PetscInt length, copies;
  double mass, spring, alpha, beta;

  PetscInt size() const { return length * copies; }
  OwnedMat tridiagonal(double diagonal, double beside) const {
    OwnedMat matrix;
    check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size(), size(), 3, nullptr, 2,
                       nullptr, matrix.out()));
    PetscInt first = 0, end = 0;
    check(MatGetOwnershipRange(matrix, &first, &end));
    for (PetscInt i = first; i < end; ++i)
      for (const PetscInt j : {i - 1, i, i + 1})
        if (j >= 0 && j < size() && j / length == i / length)
          check(MatSetValue(matrix, i, j, i == j ? diagonal : beside, INSERT_VALUES));
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    return matrix;
  }
  pencil::Pencil pencil() const {
    std::vector<pencil::Term> terms;
    terms.push_back({tridiagonal(2 * spring, -spring), 0, 0, 1});
    terms.push_back({tridiagonal(mass, 0), 2, 0, 1});
    if (alpha > 0) terms.push_back({tridiagonal(mass, 0), 1, 0, alpha});
    if (beta > 0) terms.push_back({tridiagonal(2 * spring, -spring), 1, 0, beta});
    return pencil::Pencil(std::move(terms));
  }
  /// Im s ≥ 0, by ascending |s|.
  std::vector<Complex> exact() const {
    std::vector<Complex> list;
    for (PetscInt j = 1; j <= length; ++j)
      for (PetscInt copy = 0; copy < copies; ++copy) {
        const double sine = std::sin(static_cast<double>(j) * M_PI /
                                     (2.0 * (static_cast<double>(length) + 1))),
                     kappa = 4 * spring / mass * sine * sine, half = (alpha + beta * kappa) / 2;
        const Complex root = std::sqrt(Complex(half * half - kappa));
        list.push_back(-half + root);
        if (root.imag() == 0) list.push_back(-half - root);
      }
    std::sort(list.begin(), list.end(),
              [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    return list;
  }
};

/// `alpha` is one of three: undamped; all under-damped; the lowest modes overdamped, with two real
/// eigenvalues each.
inline Chains chains(PetscInt length, PetscInt copies, double alpha) {
  return {length, copies, 0.01, 4e5, alpha, alpha > 0 ? 1e-6 : 0.0};
}
inline constexpr double alphas[] = {0, 20, 3e3};

}  // namespace squeal::test
