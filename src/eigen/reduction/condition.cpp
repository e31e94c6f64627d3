// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/condition.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/symmetric.hpp"

namespace squeal::reduction {
namespace {

constexpr double oneCluster = 1e-6;

/// Returns yᴴ P'(s) d for one left vector y and the right vector d of pair b.
Complex pairing(const std::vector<Complex>& left, Complex s, const linalg::ComplexMatrix& massTimes,
                const linalg::ComplexMatrix& dampingTimes, std::size_t b) {
  Complex sum = 0;
  for (std::size_t i = 0; i < left.size(); ++i)
    sum += std::conj(left[i]) * (2.0 * s * massTimes(i, b) + dampingTimes(i, b));
  return sum;
}

/// Returns the smallest singular value of a complex matrix G from the real matrix
///   [Re G  −Im G; Im G  Re G].
double smallestSingularValue(const linalg::ComplexMatrix& g) {
  const PetscInt p = g.rows();
  if (p == 1) return std::abs(g(0, 0));
  linalg::DenseMatrix real(2 * p, 2 * p);
  for (PetscInt j = 0; j < p; ++j)
    for (PetscInt i = 0; i < p; ++i) {
      real(i, j) = real(p + i, p + j) = g(i, j).real();
      real(p + i, j) = g(i, j).imag();
      real(i, p + j) = -g(i, j).imag();
    }
  const auto squares = linalg::symmetricEigenvalues(linalg::transposedProduct(real, real));
  return std::sqrt(std::max(0.0, squares.front()));
}

}  // namespace

std::vector<double> conditionNumbers(const linalg::DenseProblem& problem,
                                     const std::vector<linalg::DensePair>& pairs, double least) {
  const auto massTimes = linalg::timesVectors(problem.mass, pairs),
             dampingTimes = linalg::timesVectors(problem.damping, pairs);
  std::vector<double> numbers;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const double size = std::max(std::abs(pairs[j].s), least);
    const Complex s = size == std::abs(pairs[j].s) ? pairs[j].s
                      : pairs[j].s == 0.0          ? size
                                                   : pairs[j].s * (size / std::abs(pairs[j].s));
    const double simple = 1 / std::abs(pairing(pairs[j].left, s, massTimes, dampingTimes, j));
    std::vector<std::size_t> cluster;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (std::abs(pairs[k].s - pairs[j].s) <= oneCluster * size) cluster.push_back(k);
    double number = simple;
    if (cluster.size() > 1) {
      const PetscInt p = cluster.size();
      linalg::ComplexMatrix g(p, p);
      for (PetscInt b = 0; b < p; ++b)
        for (PetscInt a = 0; a < p; ++a)
          g(a, b) = pairing(pairs[cluster[a]].left, s, massTimes, dampingTimes, cluster[b]);
      // The change of the cluster is G⁻¹YᴴR: p unit vectors on either side. A single pair does not
      // determine it, since the vectors of a multiple eigenvalue are arbitrary.
      number = p / smallestSingularValue(g);
    }
    number /= size;
    numbers.push_back(std::isfinite(number) ? number : INFINITY);
  }
  return numbers;
}

}  // namespace squeal::reduction
