#pragma once
/// Norms of tall vectors from a few random combinations of their entries.
///
/// For a matrix Ω of k columns of independent random signs, ‖Ωᵀr‖²/k has the mean ‖r‖² and a relative deviation of √(2/k) (Johnson and
/// Lindenstrauss 1984; Achlioptas 2003): the norm is found to within 9 % (one deviation) for k = 64. Ωᵀ A V, kept for a basis V,
/// gives the norms of residuals A V q without their n entries.
#include <vector>

#include "flutter/images.hpp"

namespace squeal::flutter {

class Sketch {
 public:
  static constexpr PetscInt size = 64;  ///< k
  /// Three deviations.
  static constexpr double safety = 1.27;

  /// Collective. For columns laid out like those of `like`; signs belong to global rows, whatever the ranks. Weighted norms are √(rᵀ D r)
  /// for the diagonal D, [local row].
  Sketch(BV like, const std::vector<double>& diagonal);
  /// Collective. Ωᵀ X and Ωᵀ D^½ X, one above the other, 2k × columns, divided by √k: the same on all ranks.
  DenseMatrix of(const double* x, PetscInt columns) const;

 private:
  MPI_Comm comm_;
  Block signs_;  // n × 2k, the second half times D^½
};

/// Norms from a sketch (2k × columns): of all columns in turn.
struct SquaredNorms {
  std::vector<double> euclidean, weighted;
};
SquaredNorms squaredNorms(const DenseMatrix& sketch);

}  // namespace squeal::flutter
