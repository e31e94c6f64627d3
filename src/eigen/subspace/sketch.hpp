// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Estimates of the norms of tall vectors from a few random combinations of their entries.
///
/// For a matrix Ω with k columns of independent random signs [M.39],
///   ‖Ωᵀ r‖² / k
/// has the mean ‖r‖² and a relative standard deviation of √(2/k) (Johnson and Lindenstrauss 1984;
/// Achlioptas 2003). For k = 64 the norm has a relative standard deviation of 9 %. The norms of
/// residuals A V q in a basis V follow from a stored Ωᵀ A V, without computing the n entries of the
/// residuals.
#include <optional>
#include <vector>

#include "algebra/linalg/block.hpp"

namespace squeal::subspace {

/// The matrix Ω of random signs, distributed by rows.
class Sketch {
 public:
  static constexpr PetscInt size = 64;  ///< k, the number of columns of Ω
  /// A factor that raises a norm by three standard deviations.
  static constexpr double safety = 1.27;

  /// Collective. Creates Ω for vectors distributed like `diagonal`, [local row], which is the
  /// diagonal D ≥ 0 of the weighted norm √(rᵀ D r). The signs depend only on the global row, not on
  /// the number of ranks. The Euclidean and the weighted norm ignore the local rows `leftOut`.
  Sketch(MPI_Comm comm, const std::vector<double>& diagonal,
         const std::vector<PetscInt>& leftOut = {});
  /// Collective. Returns the rows of Ωᵀ X / √k, followed by those of Ωᵀ D^½ X / √k, 2k × columns,
  /// the same on all ranks. `x` has this rank's rows of X.
  linalg::DenseMatrix of(const linalg::DenseView& x) const;
  /// Collective. Returns only Ωᵀ X / √k, with the first `count` ≤ k columns of Ω, count × columns.
  linalg::DenseMatrix unweighted(const linalg::DenseView& x, PetscInt count = size) const;
  /// Collective. Returns the same as the first overload. `x` has only the rows `rows` of X; the
  /// others are zero.
  linalg::DenseMatrix of(const linalg::RowSet& rows, const linalg::DenseView& x) const;
  /// Returns this rank's rows of Ω / √k and D^½ Ω / √k, n × 2k: the sketch of Aᵀ X is also
  /// (A Ω)ᵀ X.
  linalg::DenseView signs() const { return signs_; }

 private:
  MPI_Comm comm_;
  linalg::Block signs_;  // n × 2k, the second half times D^½
};

/// Estimates of squared norms, [column].
struct SquaredNorms {
  std::vector<double> euclidean, weighted;
};
/// Not collective. Returns the squared norms of all columns from a sketch, 2k × columns.
SquaredNorms squaredNorms(const linalg::DenseView& sketch);
/// Not collective. Returns the squared Euclidean norms of all columns from an unweighted sketch, k
/// × columns.
std::vector<double> squaredLengths(const linalg::DenseView& unweighted);

/// Not collective. Returns the coefficients of orthogonal combinations of columns, all × count,
/// estimated from the sketches of the columns, 2k × all. Each column is first multiplied by its
/// factor, [column]; the coefficients include the factors. The combinations are the right singular
/// vectors of the unweighted half of the sketch with singular values above `small`; `count` is the
/// number of combinations, which is small if the columns are nearly dependent. If all singular
/// values exceed `small`, returns the diagonal matrix of the factors. Returns nothing if nearly k
/// singular values exceed `small`, since the sketch then does not show how many are needed.
std::optional<linalg::DenseMatrix> leadingCombinations(const linalg::DenseView& sketches,
                                                       const std::vector<double>& factors,
                                                       double small);

/// Not collective. Returns the coefficients of the combinations [first, last) of all columns,
/// all × (last − first): random signs, times the factor of each column. A few more combinations
/// than leading directions almost surely span the leading directions (Halko, Martinsson and Tropp
/// 2011).
linalg::DenseMatrix randomCombinations(const std::vector<double>& factors, PetscInt first,
                                       PetscInt last);

}  // namespace squeal::subspace
