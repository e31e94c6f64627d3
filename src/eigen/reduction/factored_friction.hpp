// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Friction terms of many active sets, projected on a growing basis.
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/friction_factors.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::reduction {

/// Collective. Returns A times the columns of the basis from `first` on, on all ranks, for a matrix
/// A of few rows.
linalg::DenseMatrix productWithBasis(const subspace::Basis& basis, Mat rows, PetscInt first = 0);

/// The factors of friction terms with the vectors of the basis V, on all ranks. The terms of an
/// active set are products of the rows of its sliding nodes. In contrast to ProjectedTerms, the
/// residuals in the full problem are not known.
class FactoredFriction {
 public:
  /// Collective. Borrows the basis during the lifetime of the object.
  FactoredFriction(const subspace::Basis& basis, pencil::FrictionFactors factors);
  /// Returns the number of rows of a factor.
  PetscInt rows() const { return slip_.empty() ? 0 : slip_.front().timesV.rows(); }
  /// Collective. Extends the products to the new vectors of the basis.
  void extend();
  /// Not collective. Updates the products for a basis that has become V · combinations.
  void combine(const linalg::DenseMatrix& combinations);
  /// Not collective. Adds the friction terms of these rows, ascending, to the projected problem,
  /// which has the terms of all sets.
  void addTo(const sweep::Parameters& at, const std::vector<PetscInt>& rows,
             linalg::DenseProblem& sum) const;

 private:
  struct Factor {
    pencil::Term term;
    linalg::DenseMatrix timesV;  // r × size
  };
  /// (S_a V)ᵀ N_X V in some rows, borrowing the factors.
  struct Product {
    const pencil::Term *slip, *normal;
    linalg::DenseMatrix matrix;
  };
  const std::vector<Product>& products(const std::vector<PetscInt>& rows) const;

  const subspace::Basis& basis_;
  std::vector<Factor> slip_, normal_;
  // Of the last call: the ends of a piece of a path, and neighbouring sets, often have the same
  // rows.
  mutable std::vector<PetscInt> lastRows_;
  mutable std::vector<Product> last_;
};

}  // namespace squeal::reduction
