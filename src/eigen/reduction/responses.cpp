// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/responses.hpp"

namespace squeal::reduction {
namespace {

/// One term of k, or of kᵀ, by the nonzero rows of its matrix.
struct Forces {
  bool transposed;
  linalg::RowSet rows;
  OwnedMat matrix;
  int power;
  double coefficient;
};

Forces forcesOf(const pencil::Term& term, const sweep::Parameters& at, bool transposed) {
  OwnedMat matrix = term.matrix.share();
  if (transposed) check(MatTranspose(term.matrix, MAT_INITIAL_MATRIX, matrix.out()));
  const linalg::RowSet rows(matrix);
  return {transposed, rows, rows.of(matrix), term.power, term.coefficient(at)};
}

}  // namespace

linalg::Block forcesOnModes(const Basis& basis, const pencil::Pencil& pencil,
                            const sweep::Parameters& at, const std::vector<double>& frequencies,
                            double resolution) {
  const PetscInt count = frequencies.size(), first = basis.boundarySize();
  const auto& terms = pencil.terms();
  std::vector<Forces> list;
  for (const bool transposed : {false, true})
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (terms[t].containsFriction() || t >= pencil.affineCount())
        list.push_back(forcesOf(terms[t], at, transposed));
  // Friction forces are nonzero only at the contact: the columns are stored by their common nonzero
  // rows.
  std::vector<PetscInt> rows, place(basis.localRows(), -1);
  for (const auto& forces : list)
    for (PetscInt i = 0; i < forces.rows.size(); ++i)
      if (auto& known = place[forces.rows[i]]; known < 0) {
        known = rows.size();
        rows.push_back(forces.rows[i]);
      }
  linalg::Block all(rows.size());
  for (const bool transposed : {false, true})
    for (const bool imaginary : {false, true}) {  // (iω)^power
      linalg::Block part(all.rows(), count);
      for (const auto& forces : list) {
        if (forces.transposed != transposed || (forces.power == 1) != imaginary) continue;
        linalg::Block products(forces.rows.size());
        basis.appendProducts(forces.matrix, first, first + count, products);
        for (PetscInt j = 0; j < count; ++j) {
          const double omega = frequencies[j];
          const double factor = forces.coefficient * (forces.power == 0   ? 1
                                                      : forces.power == 1 ? omega
                                                                          : -omega * omega);
          for (PetscInt i = 0; i < products.rows(); ++i)
            part(place[forces.rows[i]], j) += factor * products(i, j);
        }
      }
      all.append(linalg::unitColumns(basis.comm(), part));
    }
  const linalg::Block leading = linalg::principal(basis.comm(), all, resolution);
  linalg::Block whole(basis.localRows(), leading.columns());
  for (PetscInt j = 0; j < leading.columns(); ++j)
    for (PetscInt i = 0; i < leading.rows(); ++i) whole(rows[i], j) = leading(i, j);
  return whole;
}

}  // namespace squeal::reduction
