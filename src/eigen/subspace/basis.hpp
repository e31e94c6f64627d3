// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The growing basis V of the reduced problem, orthonormal in the energy of the stiffness K0 within
/// about a thousandth [M.28]:
///   VᵀK0V ≈ I.
/// Boundary unknowns are those that exist only at some points of the sweep, such as the gaps of
/// nodes that open (Substructure); all others are interior, and K0 is their stiffness. If there are
/// boundary unknowns, their constraint modes come first. In the energy of the stiffness K of all
/// unknowns, these are orthogonal to the other vectors, which are zero at the boundary, but not to
/// each other.
///
/// A free mode d of angular frequency ω enters as d/ω, a correction as z = K0⁻¹ r [M.31]. Since
/// K0z = r up to the error of the solve, these quantities need no product with K0 [M.32]:
///   VᵀK0z = Vᵀr,   zᵀK0z = zᵀr,   K0z = r.
/// If r is the residual of a Galerkin solution on V, then Vᵀr = 0, and z is orthogonal to V in
/// energy.
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
  /// Collective. Starts with the constraint modes of the boundary unknowns, if any, and the modes
  /// of `system`, which has only the interior unknowns. Uses the modes only during this call, and
  /// borrows the system during the lifetime of the object. Throws Error if K0 cannot be factorised.
  Basis(const modes::Modes& modes, const factor::AssociatedSystem& system,
        Substructure substructure = {});
  /// Returns this rank's rows of V.
  const linalg::Block& columns() const { return columns_; }
  PetscInt size() const { return columns_.columns(); }
  PetscInt localRows() const { return columns_.rows(); }
  MPI_Comm comm() const { return comm_; }
  Mat stiffness() const { return substructure_.stiffness; }  ///< K of all unknowns
  /// Returns the number of boundary unknowns of all ranks. Their constraint modes are the first
  /// vectors.
  PetscInt boundarySize() const { return boundaryStiffness_.rows(); }
  /// Returns VᵀKV of the constraint modes, the Schur complement of K on the boundary unknowns,
  /// boundary × boundary [M.60].
  const linalg::DenseMatrix& boundaryStiffness() const { return boundaryStiffness_; }
  /// Sets the rows of the boundary unknowns to zero. Not collective.
  void clearBoundary(linalg::Block& columns) const;
  /// Not collective. Returns the columns `interior`, which have only interior unknowns, padded with
  /// zeros at the boundary unknowns. Argument and result have this rank's rows.
  linalg::Block prolonged(const linalg::DenseView& interior) const;

  /// Collective. Adds K0⁻¹ times the columns of `residuals`, by a block solve. Omits what depends
  /// linearly on V or on the other columns. The rows of the boundary unknowns are ignored, since
  /// the constraint modes represent them. Returns the number of columns added.
  PetscInt add(linalg::Block residuals);
  /// Collective. Does the same for static forces F. Returns FᵀK0⁻¹F, from the interior rows of F.
  /// If VᵀK0V is given as `energies`, orthogonalisation takes fewer passes, and lastEnergyRatio()
  /// stays as it is.
  linalg::DenseMatrix addResponses(linalg::Block forces, const linalg::DenseMatrix& energies = {});
  /// Collective. Appends this rank's rows of the vectors that add() found in an earlier run. Also
  /// sets the values of lastEnergyRatio() and solves() to those of that run.
  void restore(const linalg::DenseView& columns, double lastEnergyRatio, long solves);
  /// Collective. Returns K0⁻¹ times the interior rows of the columns, by a block solve. The result
  /// is zero at the boundary.
  linalg::Block responses(const linalg::Block& forces);
  /// Collective. Returns FᵀK0⁻¹F, from the interior rows of F, the same on all ranks. Since this is
  /// symmetric, computes only one half of it, in panels of columns to limit the memory.
  linalg::DenseMatrix flexibility(const linalg::Block& forces);
  /// Collective. Replaces V by V · combinations. `combinations` is former size × new size and must
  /// have orthonormal columns.
  void combine(const linalg::DenseMatrix& combinations);

  /// Collective. Appends the product of `matrix` and the columns [first, last) of V to the columns
  /// of `result`, which has this rank's rows of `matrix`.
  void appendProducts(Mat matrix, PetscInt first, PetscInt last, linalg::Block& result) const;
  /// Return this rank's rows of K times the columns last added, and VᵀK times these columns,
  /// size() × columns. In a new basis these are all columns, if it has constraint modes. Otherwise,
  /// and after combine() and restore(), both have no columns, since they would need further
  /// products.
  const linalg::Block& forces() const { return forces_; }
  const linalg::DenseMatrix& energies() const { return energies_; }
  /// Frees them.
  void releaseForces();
  /// Collective. Returns the vectors V q, of n entries each, for all q of the list. If a q has too
  /// few entries, the missing ones at its end are treated as zero.
  std::vector<linalg::ComplexVector> expand(const std::vector<std::vector<Complex>>& list) const;
  /// Returns the random signs Ω for columns with n entries [M.39]. The sketch of some columns is
  /// their product with Ω, which has few rows; it serves to estimate their norms. A weighted sketch
  /// serves to estimate √(rᵀ diag(K0)⁻¹ r).
  const Sketch& sketch() const { return *sketch_; }
  /// Returns the unweighted sketch of V.
  const linalg::DenseMatrix& sketched() const { return sketched_; }
  /// Returns a sketch of D^½ V with D = diag(K0), of few rows and size() columns. It serves to
  /// estimate round-off: ε √(yᵀDy) √(xᵀDx) bounds the error of yᵀK0x due to the rounding of the
  /// entries of K0, except for a factor of the order of the number of entries per row [M.26].
  const linalg::DenseMatrix& sketchedRigidity() const { return rigidity_; }
  /// Collective. Returns for each block of columns the largest ratio of the energy norm √(rᵀ K0⁻¹
  /// r) to √(rᵀ diag(K0)⁻¹ r) among the combinations r of its columns, or 0 for a block without
  /// columns. For similar columns, this ratio converts the second norm, which is cheap, into an
  /// estimate of the first. One block solve serves all blocks.
  std::vector<double> energyRatios(const std::vector<linalg::Block>& blocks);
  /// Returns the energy ratio of the residuals of the last add(); 1 before the first one.
  double lastEnergyRatio() const { return ratio_; }
  /// Returns the total number of right-hand sides of all solves so far.
  long solves() const { return solves_; }

 private:
  double ratio(const linalg::Block& residuals, const linalg::DenseMatrix& energy) const;
  bool addOrthogonal(linalg::Block& z, linalg::Block& residuals, const linalg::DenseMatrix& energy,
                     const linalg::DenseMatrix& parts);
  void append(const linalg::Block& z, linalg::Block forces, const linalg::DenseMatrix& along);
  linalg::DenseMatrix alongBasis(const linalg::DenseMatrix& energies,
                                 const linalg::DenseMatrix& parts) const;
  void addOrthogonalised(linalg::Block& z, const linalg::DenseMatrix& parts,
                         linalg::DenseMatrix along);
  double solutionError(const linalg::Block& z, const linalg::Block& residuals) const;
  void sketchColumns(PetscInt first);

  void addConstraintModes();
  void addForces(const linalg::Block& shapes);
  void setBoundaryReactions(const linalg::DenseMatrix& answers, linalg::Block& residuals) const;

  MPI_Comm comm_;
  Substructure substructure_;
  bool isPlain_;                // true if K is K0
  PetscInt firstBoundary_ = 0;  // index of this rank's first boundary unknown among all
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
