// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The unknowns of the points of a sweep. All points have the interior unknowns y. Each point has
/// some of the boundary unknowns w, such as the gaps of contact nodes that open in a part of the
/// sweep; its other boundary unknowns are zero.
///
/// As in the Craig–Bampton method (AIAA J. 6, 1968), the basis starts with a constraint mode for
/// each boundary unknown,
///   Y = (−K0⁻¹ K_yw, I),   S = YᵀK Y = K_ww − K_wy K0⁻¹ K_yw   [M.60],
/// and all other vectors have w = 0. Any such vector is orthogonal to Y in the energy of K. A point
/// uses only the constraint modes of its own boundary unknowns, and only K0, the stiffness of the
/// interior, is factorised.
#include <petscmat.h>

#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::subspace {

/// The unknowns x of a sweep on this rank, and the stiffness of all unknowns. Empty without
/// boundary unknowns.
struct Substructure {
  Mat stiffness = nullptr;         ///< K, symmetric, borrowed
  std::vector<PetscInt> interior;  ///< [unknown of K0 on this rank] its row of K on this rank
  std::vector<PetscInt> boundary;  ///< [boundary unknown of this rank] its row of K on this rank
};

/// The part of a basis that a point uses: the constraint modes of its own boundary unknowns, made
/// orthonormal in energy, and all vectors after the constraint modes. Not collective.
class PointSpace {
 public:
  /// `boundaryStiffness` is S, boundary × boundary, and has[i] is 1 if the point has boundary
  /// unknown i, numbered over all ranks. Throws Error if the part of S for these unknowns is not
  /// positive definite.
  PointSpace(const linalg::DenseMatrix& boundaryStiffness, const std::vector<unsigned char>& has);
  /// Returns true if the point uses the whole basis unchanged.
  bool isWhole() const { return all_ == 0; }
  /// Returns the number of coordinates of the point in a basis of this size.
  PetscInt size(PetscInt basisSize) const { return basisSize - all_ + own(); }
  /// Returns the number of boundary unknowns of the point.
  PetscInt own() const { return std::ssize(boundary_); }
  /// Returns the boundary unknowns of the point, ascending.
  const std::vector<PetscInt>& boundary() const { return boundary_; }
  /// Converts the coordinates q of the point to coordinates of the basis.
  std::vector<Complex> lifted(const std::vector<Complex>& q) const;
  /// Returns the problem projected on the vectors of the point, from its projection on the whole
  /// basis.
  linalg::DenseProblem restricted(linalg::DenseProblem problem) const;
  /// Returns the products of rows with the vectors of the point, from those with the vectors of the
  /// basis. Both have one column per vector.
  linalg::DenseMatrix restrictedColumns(const linalg::DenseMatrix& a) const;

 private:
  linalg::DenseMatrix restricted(const linalg::DenseMatrix& a) const;
  PetscInt all_ = 0;                // boundary unknowns of all points; 0: the basis is unchanged
  std::vector<PetscInt> boundary_;  // boundary unknowns of this point, ascending
  linalg::DenseMatrix turn_;        // L⁻ᵀ, where L Lᵀ is the part of S for boundary_
};

}  // namespace squeal::subspace
