// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The basis of the reduced problem grows, and is orthonormal in the energy of the stiffness K0 to
/// a part in a thousand [M.28]:
///   VᵀK0V ≈ I.
/// Where points have boundary unknowns, their constraint modes come first, which are orthogonal to
/// all others but not to each other.
///
/// Free modes enter as d/ω, corrections as z = K0⁻¹ r [M.31]. The residuals r of a Galerkin
/// solution on V have Vᵀr = 0, so that their corrections come out orthogonal to V. As closely as
/// K0⁻¹ is known, the following takes no product with K0 [M.32]:
///   VᵀK0z = Vᵀr,   zᵀK0z = zᵀr,   K0z = r.
#include <optional>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/complexvector.hpp"
#include "base/petsc/owned.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/subspace/sketch.hpp"
#include "eigen/subspace/substructure.hpp"

namespace squeal::subspace {

/// The basis V, n × size, distributed by rows.
class Basis {
 public:
  /// Collective. Begins with the constraint modes of the boundary unknowns, if there are any, and
  /// the modes of the system, which is that of the interior unknowns. The modes are needed during
  /// this call only, and the system is borrowed during the life of the object. Throws Error if K0
  /// cannot be factorised.
  Basis(const modes::Modes& modes, const factor::AssociatedSystem& system,
        Substructure substructure = {});
  /// Returns V by this rank's rows.
  const linalg::Block& columns() const { return columns_; }
  PetscInt size() const { return columns_.columns(); }
  PetscInt localRows() const { return columns_.rows(); }
  MPI_Comm comm() const { return comm_; }
  Mat stiffness() const { return substructure_.stiffness; }  ///< K of all unknowns
  /// Returns the number of boundary unknowns of all ranks, which are the first vectors.
  PetscInt boundarySize() const { return boundaryStiffness_.rows(); }
  /// Returns S of the constraint modes, boundary × boundary [M.60].
  const linalg::DenseMatrix& boundaryStiffness() const { return boundaryStiffness_; }
  /// Sets the rows of the boundary unknowns to zero. Not collective.
  void clearBoundary(linalg::Block& columns) const;
  /// Collective. Returns a copy of V.
  OwnedBV vectors() const;
  /// Not collective. Returns columns of the interior unknowns, by this rank's rows, with zeros at
  /// the boundary.
  linalg::Block prolonged(const linalg::DenseView& interior) const;

  /// Collective. Adds K0⁻¹ of the columns of `residuals`, solved for together; combinations that
  /// depend on others or on V are dropped. The rows of the boundary unknowns do not count: the
  /// constraint modes answer for them. Returns the number of columns added.
  PetscInt add(linalg::Block residuals);
  /// Collective. Appends the vectors that add() has found in an earlier run, by this rank's rows,
  /// with what it knew then.
  void restore(const linalg::DenseView& columns, double lastEnergyRatio, long solves);
  /// Collective. Returns K0⁻¹ of the interior rows of the columns, solved for together, with zeros
  /// at the boundary.
  linalg::Block responses(const linalg::Block& forces);
  /// Collective. Replaces V by V · combinations, former size × new size. The columns of
  /// `combinations` must be orthonormal.
  void combine(const linalg::DenseMatrix& combinations);

  /// Collective. Appends A times the columns [first, last) of V to the columns of `result`, which
  /// has this rank's rows of A.
  void appendProducts(Mat matrix, PetscInt first, PetscInt last, linalg::Block& result) const;
  /// Returns K0 times the columns last added, by this rank's rows, and VᵀK0 times them, size() ×
  /// columns. Where these are not known without products, both have no columns.
  const linalg::Block& forces() const { return forces_; }
  const linalg::DenseMatrix& energies() const { return energies_; }
  /// Collective. Returns V q, n entries, for several q, [q]. Entries that a q lacks are zero.
  std::vector<linalg::ComplexVector> expand(const std::vector<std::vector<Complex>>& list) const;
  /// Returns the random signs Ω for columns with n entries [M.39]. The weighted norm of their
  /// sketches is √(rᵀ diag(K0)⁻¹ r).
  const Sketch& sketch() const { return *sketch_; }
  /// Returns the unweighted sketch of V.
  const linalg::DenseMatrix& sketched() const { return sketched_; }
  /// Returns a sketch of D^½ V with D = diag(K0), few × size(), whose columns estimate the
  /// round-off of the stiffness: ε √(yᵀDy) √(xᵀDx) bounds what the round-off of its entries adds to
  /// yᵀK0x, up to the number of entries that a row shares with others [M.26].
  const linalg::DenseMatrix& sketchedRigidity() const { return rigidity_; }
  /// Collective. Returns for each block of columns the largest ratio of the energy norm
  /// √(rᵀ K0⁻¹ r) to √(rᵀ diag(K0)⁻¹ r) among its combinations, or 0 for a block without columns.
  /// The ratio turns the second norm, which costs nothing, into an estimate of the first for
  /// columns like these. All blocks are solved for together.
  std::vector<double> energyRatios(const std::vector<linalg::Block>& blocks);
  /// Returns the energy ratio of the residuals that add() was last given; 1 before.
  double lastEnergyRatio() const { return ratio_; }
  /// Returns the number of right-hand sides solved for so far.
  long solves() const { return solves_; }

 private:
  double ratio(const linalg::Block& residuals, const linalg::DenseMatrix& energy) const;
  bool addAcross(const linalg::Block& z, const linalg::Block& residuals,
                 const linalg::DenseMatrix& energy, const linalg::DenseMatrix& parts);
  void append(const linalg::Block& z, linalg::Block forces, const linalg::DenseMatrix& along);
  void addOrthogonalised(linalg::Block& z, const linalg::DenseMatrix& parts);
  double solutionError(const linalg::Block& z, const linalg::Block& residuals) const;
  void sketchColumns(PetscInt first);

  void addConstraintModes();
  void answerAtBoundary(const linalg::DenseMatrix& answers, linalg::Block& residuals) const;

  MPI_Comm comm_;
  Substructure substructure_;
  bool isPlain_;                // K is K0
  PetscInt firstBoundary_ = 0;  // place of this rank's first boundary unknown among all
  linalg::DenseMatrix boundaryStiffness_;
  KSP solver_;
  linalg::Block columns_;
  linalg::Block forces_;
  linalg::DenseMatrix energies_;
  std::vector<double> inverseDiagonal_;
  std::optional<Sketch> sketch_;
  linalg::DenseMatrix sketched_, rigidity_;
  double ratio_ = 1;
  long solves_ = 0;
};

}  // namespace squeal::subspace
