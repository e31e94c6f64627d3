// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The steady problem condensed to the contact [3.10–3.18]: the gaps that nodal normal forces open.
///
/// All gaps are unknowns of u = T x + p u0, and K_o = Tᵀ K T is the stiffness with the contact
/// open. K denotes K + v² K^R here. R are the normal forces, e the columns of the identity at the
/// gaps, and U the slip rows as columns: Sᵀ N r = U R. Equilibrium, L(f)ᵀ (K u − b) = e R, reads
/// [M.17]
///   K_o x + f U R = Tᵀ (b − K p u0) + e R,
/// and the gaps are
///   g = eᵀ x = A(f) R + F0,   A(f) = A0 + f A1,   A0 = eᵀ K_o⁻¹ e,   A1 = −eᵀ K_o⁻¹ U   [M.18].
/// Interfaces with a fixed coefficient of friction add −eᵀ K_o⁻¹ U_0 to A, with their slip rows
/// U_0.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "model/contact/contact.hpp"
#include "model/contact/coupled.hpp"

namespace squeal::uniqueness {

/// The matrices of A(f), m/N, with all entries on every rank.
struct Compliance {
  linalg::DenseMatrix a0;  ///< at the swept friction 0: A0 plus the terms of fixed coefficients
  linalg::DenseMatrix a1;
  /// Returns A(f) at the swept friction.
  linalg::DenseMatrix at(double friction) const;
};

/// The condensed problem, with a factorisation of K_o.
class OpenContact {
 public:
  /// Collective. Factorises K_o (prefix -steady_uniqueness_); factorised() returns whether this
  /// succeeded. No body may be under-constrained with open contact. `stiffness` is K on all nodal
  /// displacements, N×N, symmetric, N/m, and `slip`, [contact node], defines U; both are used
  /// only during this call. Borrows `contact` during the lifetime of the object.
  OpenContact(const contact::Contact& contact, Mat stiffness,
              const std::vector<contact::Slip>& slip);
  /// Returns false if K_o could not be factorised; no other function may be called then.
  bool factorised() const { return factorised_; }
  /// Collective. Returns false if K_o has a negative eigenvalue, as with convective terms beyond a
  /// critical speed.
  bool positiveDefinite() const;
  MPI_Comm comm() const { return contact_.mesh->comm; }
  PetscInt size() const { return size_; }            ///< number of contact nodes of all ranks
  PetscInt ownedSize() const { return ownedSize_; }  ///< number of contact nodes of this rank
  /// Returns true if an interface has a fixed coefficient. dense() includes it; multiplyA0() and
  /// multiplySymmetricA1() do not.
  bool hasFixedFriction() const { return fixedFriction_ != nullptr; }
  /// Collective. Returns A(f), by block solves for all columns.
  Compliance dense() const;
  /// Collective. Sets product = A0 v without forming A0. The entries of v are in the order of
  /// Contact::nodes.
  void multiplyA0(Vec v, Vec product) const;
  /// Collective. Sets product = sym(A1) v without forming A1.
  void multiplySymmetricA1(Vec v, Vec product) const;
  /// Collective. Sets solution = A0⁻¹ v with
  ///   A0⁻¹ = K_gg − K_gi K_ii⁻¹ K_ig,
  /// where g are the gaps and i the other unknowns of K_o. K_ii, the stiffness of the closed
  /// contact, is factorised on first use.
  void solveA0(Vec v, Vec solution);

 private:
  OwnedMat block(PetscInt columns) const;
  void close();

  const contact::Contact& contact_;
  contact::Transformation transformation_;
  PetscInt size_ = 0, ownedSize_ = 0, first_ = 0;
  OwnedMat stiffness_;        // K_o, n×n
  OwnedMat gaps_, friction_;  // e and U, n×n_c
  OwnedMat fixedFriction_;    // U_0, n×n_c; null without fixed coefficients
  OwnedKSP solver_;
  bool factorised_ = false;
  OwnedVec part_;             // n_c
  OwnedMat rhs_, solution_;   // n×2: e v and U v, and K_o⁻¹ times these
  OwnedVec single_, answer_;  // n
  OwnedMat closedStiffness_, coupling_, gapStiffness_;  // K_ii, K_ig, K_gg
  OwnedKSP closedSolver_;
  OwnedVec inner_, innerAnswer_;
};

/// Collective. Throws Error for a -steady_uniqueness_* option that is unknown to all solvers. If
/// `dense` is true, options of the eigenvalue solver, which is then unused, are accepted.
void rejectUnusedUniquenessOptions(bool dense);

}  // namespace squeal::uniqueness
