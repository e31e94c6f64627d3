// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/kept.hpp"

#include <cmath>
#include <limits>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"

namespace squeal::proof {

PetscInt KeptProblem::order() const {
  PetscInt order = 0;
  for (const auto& matrix : matrices) order = std::max(order, matrix.rows());
  return order;
}

double definiteness(const LeftOut& bounds, double reach, double left) {
  const double square = reach * reach;
  return 1 - (square + bounds.shift) * bounds.mass - square * bounds.skewMass -
         std::max(left, 0.0) * bounds.damping - reach * bounds.gyroscopic - bounds.rest[0] -
         reach * bounds.rest[1] - square * bounds.rest[2];
}

Coupling couplingFromGram(const linalg::DenseView& gram, std::span<const int> powers, double top,
                          double negligible) {
  const PetscInt size = gram.rows(), count = std::ssize(powers),
                 order = count > 0 ? size / count : 0;
  ensure(gram.columns() == size && order * count == size, "a Gram matrix has a block per power");
  const auto weight = [&](PetscInt i) { return std::pow(top, powers[i / order]); };
  linalg::DenseMatrix vectors(gram);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i) vectors(i, j) *= weight(i) * weight(j);
  // G = Q Λ Qᵀ,   F = Λ^½ Qᵀ for the kept directions.   On the dropped ones, ‖C q‖² = qᵀ G q ≤ λ +
  // round-off.
  const auto values = linalg::symmetricEigen(vectors);
  // Differences of products may have negative eigenvalues by round-off: all are raised by twice the
  // most negative one.
  const double largest = values.empty() ? 0 : std::max(values.back(), 0.0),
               raise = values.empty() ? 0 : 2 * std::max(-values.front(), 0.0),
               small = std::max({4 * size * std::numeric_limits<double>::epsilon() * largest,
                                 2 * raise, negligible * negligible / static_cast<double>(count)});
  constexpr double contradiction = 1e-6, negligibleSquare = 1e-10;
  if (size > 0 && values.front() < -contradiction * largest - negligibleSquare)
    throw Error("the products of the couplings contradict each other");
  PetscInt first = 0;
  while (first < size && values[first] + raise <= small) ++first;
  Coupling coupling;
  for (PetscInt block = 0; block < count; ++block) {
    auto& factor = coupling.coefficients[powers[block]];
    factor = linalg::DenseMatrix(size - first, order);
    for (PetscInt j = 0; j < order; ++j)
      for (PetscInt i = first; i < size; ++i)
        factor(i - first, j) =
            std::sqrt(values[i] + raise) * vectors(block * order + j, i) / weight(block * order);
    // ‖[x; ŝ x; ŝ² x]‖ ≤ Σ |ŝ|ᵏ ‖x‖,   ŝ = s / top
    coupling.error[powers[block]] = std::sqrt(2 * small) / weight(block * order);
  }
  return coupling;
}

Coupling transposed(const Coupling& coupling) {
  Coupling result = coupling;
  for (auto& matrix : result.coefficients) matrix = linalg::transposed(matrix);
  return result;
}

}  // namespace squeal::proof
