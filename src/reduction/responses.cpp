/// Static responses to friction as the beginning of a basis.
#include <algorithm>

#include "linalg/block.hpp"
#include "pencil/pencil.hpp"
#include "reduction/reduced.hpp"
#include "sweep/parameters.hpp"

namespace squeal::reduction {
namespace {

/// coefficient · matrix · s^power, or its transpose, by the rows that hold anything.
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

/// K0⁻¹ k φ_i and K0⁻¹ kᵀφ_i for the free modes of the band at their own frequencies, where k are
/// the forces of friction and of all else that belongs to this point: the change of the right and
/// left vectors with them, to first order in them and to lowest order in the frequency.
void ReducedProblem::addStaticResponses(const PointProblem& point) {
  const PetscInt count = std::ranges::upper_bound(modes_, band_.top) - modes_.begin();
  const auto& terms = point.pencil.terms();
  std::vector<Forces> list;
  for (const bool transposed : {false, true})
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (terms[t].frictionExponent != 0 || t >= point.pencil.affineCount())
        list.push_back(forcesOf(terms[t], point.at, transposed));
  // Forces of friction are zero but at the contact: the columns are kept by the rows that any of
  // them has.
  std::vector<PetscInt> rows, place(basis_.localRows(), -1);
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
        linalg::Block images(forces.rows.size());
        basis_.appendProducts(forces.matrix, 0, count, images);
        for (PetscInt j = 0; j < count; ++j) {
          const double omega = modes_[j];
          const double factor = forces.coefficient * (forces.power == 0   ? 1
                                                      : forces.power == 1 ? omega
                                                                          : -omega * omega);
          for (PetscInt i = 0; i < images.rows(); ++i)
            part(place[forces.rows[i]], j) += factor * images(i, j);
        }
      }
      all.append(linalg::unitColumns(basis_.comm(), part));
    }
  const linalg::Block leading = linalg::principal(basis_.comm(), all, resolution);
  linalg::Block whole(basis_.localRows(), leading.columns());
  for (PetscInt j = 0; j < leading.columns(); ++j)
    for (PetscInt i = 0; i < leading.rows(); ++i) whole(rows[i], j) = leading(i, j);
  basis_.add(whole);
  rightRatio_ = std::max(measuredRatio_, basis_.lastEnergyRatio());
}

}  // namespace squeal::reduction
