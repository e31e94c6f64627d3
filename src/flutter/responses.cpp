/// Static responses to friction as the beginning of a basis.
#include <algorithm>

#include "flutter/reduced.hpp"

namespace squeal::flutter {

/// K0⁻¹ k φ_i and K0⁻¹ kᵀφ_i for the free modes of the band at their own frequencies, where k are the forces of friction and of all
/// else that belongs to this point: the change of the right and left vectors with them, to first order in them and to lowest order
/// in the frequency.
void ReducedProblem::addStaticResponses(const PointProblem& point) {
  const auto count = static_cast<PetscInt>(std::upper_bound(modes_.begin(), modes_.end(), bandTop_) - modes_.begin());
  const auto& terms = point.pencil.terms();
  Block forces(basis_.localRows());
  for (const bool transposed : {false, true})
    for (const bool imaginary : {false, true}) {  // (iω)^power
      Block part(basis_.localRows(), count);
      for (std::size_t t = 0; t < terms.size(); ++t) {
        const Term& term = terms[t];
        const bool perturbs = term.frictionExponent != 0 || t >= point.pencil.affineCount();
        if (!perturbs || (term.power == 1) != imaginary) continue;
        OwnedMat matrix = term.matrix.share();
        if (transposed) check(MatTranspose(term.matrix, MAT_INITIAL_MATRIX, matrix.out()));
        const RowSet rows(matrix);
        Block images(rows.size());
        basis_.appendImages(rows.of(matrix), 0, count, images);
        for (PetscInt j = 0; j < count; ++j) {
          const double omega = modes_[static_cast<std::size_t>(j)];
          const double factor = term.coefficient(point.at) * (term.power == 0 ? 1 : term.power == 1 ? omega : -omega * omega);
          for (PetscInt i = 0; i < images.rows; ++i) part.column(j)[rows[i]] += factor * images.column(j)[i];
        }
      }
      append(forces, unitColumns(basis_.comm(), part));
    }
  basis_.add(principal(basis_.comm(), forces, resolution));
  rightRatio_ = std::max(measuredRatio_, basis_.lastEnergyRatio());
}

}  // namespace squeal::flutter
