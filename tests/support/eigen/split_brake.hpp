// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Random small brakes, split into the space V of modes and static responses and the space C that
/// is left out, with exact couplings.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "algebra/linalg/complexdense.hpp"
#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/qr.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "eigen/proof/contour.hpp"
#include "eigen/proof/kept.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

/// P(s) in the coordinates of the free modes, with K0 = 1 and M0 = diag(1/ω²).
struct RandomBrake {
  std::vector<double> omega;         ///< ascending
  linalg::DenseMatrix jump;          ///< rows J of the contact, in whose span S is
  linalg::DenseMatrix stiffness;     ///< fSᵀN of the first power, with 1
  linalg::DenseMatrix frictionMass;  ///< f Sᵀ N of s²
  linalg::DenseMatrix material;      ///< C ≥ 0, left without the contact
  linalg::DenseMatrix contactDamping, gyroscopic;

  PetscInt size() const { return std::ssize(omega); }
  /// Returns the coefficients of P in the coordinates of the columns of an orthogonal W.
  proof::Coefficients in(const linalg::DenseMatrix& w) const {
    linalg::DenseMatrix mass = frictionMass, damping = material;
    for (PetscInt j = 0; j < size(); ++j) mass(j, j) += 1 / (omega[j] * omega[j]);
    linalg::addScaled(damping, 1, contactDamping);
    linalg::addScaled(damping, 1, gyroscopic);
    return {linalg::congruent(stiffness, w),
            damping.empty() ? damping : linalg::congruent(damping, w), linalg::congruent(mass, w)};
  }
};

enum class Damping { none, all };

/// Returns a brake of n unknowns with 1 to 5 rows of friction.
inline RandomBrake randomBrake(PetscInt n, Damping damped, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::exponential_distribution<double> gap(1);
  std::normal_distribution<double> normal;
  RandomBrake brake;
  double frequency = 1;
  for (PetscInt j = 0; j < n; ++j) brake.omega.push_back(frequency += 0.05 + gap(generator));
  const PetscInt rows = 1 + static_cast<PetscInt>(5 * uniform(generator));
  // Participations of the modes decay as 1/ω in energy.
  const auto row = [&](PetscInt count) {
    linalg::DenseMatrix result(count, n);
    for (PetscInt j = 0; j < n; ++j)
      for (PetscInt i = 0; i < count; ++i) result(i, j) = normal(generator) / brake.omega[j];
    return result;
  };
  const auto slip = row(rows), normals = row(rows), massNormals = row(rows);
  const double friction = 12 * std::pow(uniform(generator), 2);
  brake.stiffness = linalg::DenseMatrix(n, n);
  for (PetscInt j = 0; j < n; ++j) brake.stiffness(j, j) = 1;
  linalg::addScaled(brake.stiffness, 3 * friction, linalg::transposedProduct(slip, normals));
  brake.frictionMass = linalg::DenseMatrix(n, n);
  linalg::addScaled(brake.frictionMass, friction / (brake.omega[n / 2] * brake.omega[n / 2]),
                    linalg::transposedProduct(slip, massNormals));
  brake.jump = slip;
  if (damped == Damping::none) return brake;
  // C = α M + β K with a part of another body, J^T B J of any size, and G
  const auto other = randomMatrix(3, n, generator);
  const double loss = 0.002 * uniform(generator) / brake.omega[n / 6];
  brake.material = linalg::transposedProduct(other, other);
  for (auto& entry : brake.material.entries()) entry *= 0.2 * loss;
  for (PetscInt j = 0; j < n; ++j) brake.material(j, j) += loss * (1 + uniform(generator));
  const auto more = row(2);  // normal rows
  brake.jump = linalg::DenseMatrix(rows + 2, n);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < rows + 2; ++i)
      brake.jump(i, j) = i < rows ? slip(i, j) : more(i - rows, j);
  const auto mixed = linalg::product(randomMatrix(rows + 2, rows + 2, generator), brake.jump);
  brake.contactDamping = linalg::transposedProduct(mixed, mixed);
  const double contact = std::pow(10, 4 * uniform(generator) - 4);
  for (auto& entry : brake.contactDamping.entries()) entry *= contact;
  const auto skew = randomMatrix(n, n, generator);
  brake.gyroscopic = linalg::DenseMatrix(n, n);
  const double speed = 0.02 * uniform(generator);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i)
      brake.gyroscopic(i, j) =
          speed * (skew(i, j) - skew(j, i)) / (brake.omega[i] * brake.omega[j]);
  return brake;
}

/// A brake split into V and C.
struct SplitBrake {
  proof::KeptProblem problem;
  proof::LeftOut leftOut;
};

inline linalg::DenseMatrix block(const linalg::DenseMatrix& a, PetscInt row, PetscInt column,
                                 PetscInt rows, PetscInt columns) {
  linalg::DenseMatrix result(rows, columns);
  for (PetscInt j = 0; j < columns; ++j)
    for (PetscInt i = 0; i < rows; ++i) result(i, j) = a(row + i, column + j);
  return result;
}

/// Returns the split with V of the modes and, if `responses`, K0⁻¹ Jᵀ. The bounds on C are computed
/// from its matrices. With `grams`, the couplings are given by their Grams.
inline SplitBrake split(const RandomBrake& brake, const std::vector<PetscInt>& modes,
                        bool responses, bool grams, double top) {
  const PetscInt n = brake.size(), m = std::ssize(modes);
  linalg::DenseMatrix basis(n, m + (responses ? brake.jump.rows() : 0));
  for (PetscInt j = 0; j < m; ++j) basis(modes[j], j) = 1;
  for (PetscInt j = m; j < basis.columns(); ++j)
    for (PetscInt i = 0; i < n; ++i) basis(i, j) = brake.jump(j - m, i);
  const PetscInt kept = basis.columns(), rest = n - kept;
  const auto all = brake.in(linalg::Qr(basis).q());
  SplitBrake result;
  proof::Coupling to, from;
  for (int k = 0; k < 3; ++k) {
    if (all[k].empty()) continue;
    result.problem.matrices[k] = block(all[k], 0, 0, kept, kept);
    to.coefficients[k] = block(all[k], kept, 0, rest, kept);
    from.coefficients[k] = block(all[k], 0, kept, kept, rest);
  }
  if (grams) {
    const auto gram = [&](const proof::Coupling& coupling) {
      linalg::DenseMatrix columns;
      std::vector<int> powers;
      for (int k = 0; k < 3; ++k)
        if (!coupling.coefficients[k].empty()) {
          columns.append(coupling.coefficients[k]);
          powers.push_back(k);
        }
      return proof::couplingFromGram(linalg::transposedProduct(columns, columns), powers, top);
    };
    to = gram(to);
    from = proof::transposed(gram(proof::transposed(from)));
  }
  result.problem.toLeftOut = {to};
  result.problem.fromLeftOut = {from};
  // On C: 1 + s² M + s (C + G) + what friction leaves there
  const auto onC = [&](const linalg::DenseMatrix& a) { return block(a, kept, kept, rest, rest); };
  const auto norm = [](linalg::DenseMatrix a) {
    const auto values = linalg::symmetricEigenvalues(linalg::transposedProduct(a, a));
    return std::sqrt(std::max(values.back(), 0.0));
  };
  const double rounding = 1 + 1e-9;
  const auto mass = linalg::symmetricPart(onC(all[2]));
  auto skewMass = onC(all[2]);
  linalg::addScaled(skewMass, -1, mass);
  result.leftOut.mass = linalg::symmetricEigenvalues(mass).back() * rounding;
  result.leftOut.skewMass = norm(skewMass) * rounding;
  auto stiffness = onC(all[0]);
  for (PetscInt j = 0; j < rest; ++j) stiffness(j, j) -= 1;
  result.leftOut.rest[0] = norm(stiffness) * rounding;
  if (all[1].empty()) return result;
  const auto damping = linalg::symmetricPart(onC(all[1]));
  auto gyroscopic = onC(all[1]);
  linalg::addScaled(gyroscopic, -1, damping);
  result.leftOut.damping = linalg::symmetricEigenvalues(damping).back() * rounding;
  result.leftOut.gyroscopic = norm(gyroscopic) * rounding;
  return result;
}

/// Returns the numbers of the lowest modes.
inline std::vector<PetscInt> firstModes(PetscInt count) {
  std::vector<PetscInt> modes(count);
  std::iota(modes.begin(), modes.end(), 0);
  return modes;
}

/// Returns P_CV P_VV⁻¹ P_VC at s, for couplings of one part.
inline linalg::ComplexMatrix coupling(const proof::KeptProblem& problem, Complex s) {
  const auto at = [s](const proof::Coefficients& coefficients) {
    linalg::ComplexMatrix sum;
    for (int k = 0; k < 3; ++k) {
      const auto& matrix = coefficients[k];
      if (matrix.empty()) continue;
      if (sum.empty()) sum = linalg::ComplexMatrix(matrix.rows(), matrix.columns());
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum.data()[i] += std::pow(s, k) * matrix.data()[i];
    }
    return sum;
  };
  auto from = at(problem.fromLeftOut[0].coefficients);
  linalg::Lu<Complex>(at(problem.matrices)).solve(from);
  return linalg::product(at(problem.toLeftOut[0].coefficients), from);
}

/// Returns the problem of all unknowns.
inline linalg::DenseProblem fullProblem(const RandomBrake& brake) {
  const auto all = brake.in(identity(brake.size()));
  return {all[2], all[1], all[0]};
}

/// Returns the number of eigenvalues of all unknowns in the region, by LAPACK.
inline PetscInt fullCount(const RandomBrake& brake, const proof::Region& region) {
  PetscInt count = 0;
  for (const auto& pair : linalg::solveQuadratic(fullProblem(brake)))
    if (std::abs(pair.s) < region.top && pair.s.real() > -region.left)
      count += pair.s.imag() > 0 ? 2 : 1;
  return count;
}

}  // namespace squeal::test
