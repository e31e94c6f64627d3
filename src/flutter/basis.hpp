#pragma once
/// A growing basis of the reduced problem, orthonormal in the energy of the stiffness K0: VᵀK0V = I.
///
/// Free modes enter as φ/ω, corrections as K0⁻¹ r. The residuals r of a Galerkin solution on V have Vᵀr = 0, so that their
/// corrections come out orthogonal to V, and the energy of the corrections is zᵀr: neither needs a product with K0.
#include <optional>
#include <vector>

#include "flutter/sketch.hpp"
#include "modes/modes.hpp"
#include "petsc/owned.hpp"

namespace squeal::flutter {

class Basis {
 public:
  /// Collective. Begins with the modes. Borrows the solver of K0 and K0.
  Basis(const modes::Modes& modes, Mat stiffness, KSP solver);
  BV columns() const { return columns_; }  ///< n × size(), type svec
  PetscInt size() const { return size_; }
  PetscInt localRows() const;
  MPI_Comm comm() const;

  /// Collective. Adds K0⁻¹ of the columns of `residuals`, solved for together; combinations that depend on others or on V are dropped.
  /// Returns the number of columns added.
  PetscInt add(const Block& residuals);
  /// V ← V · combinations (size() × count), which has orthonormal columns.
  void combine(const DenseMatrix& combinations, PetscInt count);

  /// Collective. A times columns [first, last) of V.
  OwnedBV times(Mat matrix, PetscInt first, PetscInt last) const;
  /// Fills the vectors with V q; entries that q lacks are zero.
  void expand(const std::vector<std::complex<double>>& q, Vec real, Vec imaginary) const;
  /// Of columns of length n; the weighted norm is √(rᵀ diag(K0)⁻¹ r).
  const Sketch& sketch() const { return *sketch_; }
  /// Sketch of V.
  const DenseMatrix& sketched() const { return sketched_; }
  /// Collective. For each block of columns, all solved for together, the largest ratio of the energy norm √(rᵀ K0⁻¹ r) to
  /// √(rᵀ diag(K0)⁻¹ r) among its combinations: it turns the second norm, which costs nothing, into an estimate of the first for columns
  /// like these. 0: no columns.
  std::vector<double> energyRatios(const std::vector<Block>& blocks);
  /// That of the columns last added.
  double lastEnergyRatio() const { return ratio_; }
  /// Columns solved for so far.
  long solves() const { return solves_; }

 private:
  Block solve(const Block& right);
  double ratio(const Block& residuals, const Block& solutions) const;
  Block scaled(const Block& residuals) const;

  KSP solver_;
  PetscInt size_ = 0;
  OwnedBV columns_;
  std::vector<double> inverseDiagonal_;
  std::optional<Sketch> sketch_;
  DenseMatrix sketched_;
  double ratio_ = 1;
  long solves_ = 0;
};

/// Collective. A BV of `columns` columns laid out like `like`, type svec.
OwnedBV columnsLike(BV like, PetscInt columns);

}  // namespace squeal::flutter
