#pragma once
/// Norms of tall vectors from a few random combinations of their entries.
///
/// For a matrix Ω of k columns of independent random signs, ‖Ωᵀr‖²/k has the mean ‖r‖² and a
/// relative deviation of √(2/k) (Johnson and Lindenstrauss 1984; Achlioptas 2003): the norm is
/// found to within 9 % (one deviation) for k = 64. Ωᵀ A V, kept for a basis V, gives the norms of
/// residuals A V q without their n entries.
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/images.hpp"

namespace squeal::linalg {

class Sketch {
 public:
  static constexpr PetscInt size = 64;  ///< k
  /// Three deviations.
  static constexpr double safety = 1.27;

  /// Collective. For columns whose local rows are as many as those of the diagonal D, [local row];
  /// signs belong to global rows, whatever the ranks. Weighted norms are √(rᵀ D r).
  Sketch(MPI_Comm comm, const std::vector<double>& diagonal);
  /// Collective. Ωᵀ X and Ωᵀ D^½ X, one above the other, 2k × columns, divided by √k: the same on
  /// all ranks.
  DenseMatrix of(const double* x, PetscInt columns) const;
  /// Collective. Ωᵀ X alone, k × columns.
  DenseMatrix unweighted(const double* x, PetscInt columns) const;
  /// `of` for columns given by some rows, zero elsewhere.
  DenseMatrix of(const RowSet& rows, const double* x, PetscInt columns) const;

 private:
  MPI_Comm comm_;
  Block signs_;  // n × 2k, the second half times D^½
};

/// Norms from a sketch (2k × columns): of all columns in turn.
struct SquaredNorms {
  std::vector<double> euclidean, weighted;
};
SquaredNorms squaredNorms(const DenseMatrix& sketch);
/// Squared Euclidean norms from an unweighted sketch (k × columns).
std::vector<double> squaredLengths(const DenseMatrix& unweighted);

/// Orthogonal combinations of columns, each first multiplied by its factor, that hold them but for
/// parts of length `small`, as far as their sketches can tell (all × count, the factors included):
/// right singular vectors of the sketch. `count` is a fraction of `all` where the columns are much
/// alike; where there are too many directions for a sketch to tell, the columns themselves.
DenseMatrix leadingCombinations(const DenseMatrix& sketches, const std::vector<double>& factors,
                                double small);

}  // namespace squeal::linalg
