#pragma once
/// The steady problem condensed to the contact [3.10–3.18]: the gaps that nodal normal forces open.
///
/// All gaps are unknowns of u = T x + u0, K_o = Tᵀ K T is the stiffness with the contact open, R_N
/// the rows of the gaps. Since Sᵀ N r = U R with U_k = the row φ_k τ_k·[·] T, transposed, L(f)ᵀ (K
/// u − b) = e R, with e the columns of the identity at the gaps, reads
///   K_o x + f U R = Tᵀ (b − K u0) + e R, so that g = eᵀ x = A(f) R + F,
///   A(f) = A0 + f A1,  A0 = eᵀ K_o⁻¹ e,  A1 = −eᵀ K_o⁻¹ U.
#include <vector>

#include "contact/contact.hpp"
#include "contact/coupled.hpp"

namespace squeal::steady {

/// A0 and A1, m/N, column-major, all entries on every rank.
struct Compliance {
  int size = 0;
  std::vector<double> a0, a1;
  std::vector<double> at(double friction) const;  ///< A0 + f A1
};

class Condensed {
 public:
  /// Collective. Factorises K_o (prefix -steady_uniqueness_); no body may be loose with the contact
  /// open. `stiffness`: K on all nodal displacements, symmetric, N/m. Borrows contact for its life.
  Condensed(const contact::Contact& contact, Mat stiffness, const std::vector<contact::Slip>& slip);
  /// False if K_o could not be factorised: nothing else may be called then.
  bool factorised() const;
  /// Collective. False if K_o is known to have a negative eigenvalue: convective terms, beyond a
  /// critical speed.
  bool positiveDefinite() const;
  MPI_Comm comm() const { return contact_.mesh->comm; }
  PetscInt size() const { return size_; }            ///< contact nodes of all ranks
  PetscInt ownedSize() const { return ownedSize_; }  ///< contact nodes of this rank
  /// Collective. A0 and A1, all columns solved for in blocks.
  Compliance dense() const;
  /// Collective. Products without A0 and A1; entries of v in the order of Contact::nodes.
  void multiplyA0(Vec v, Vec product) const;
  void multiplySymmetricA1(Vec v, Vec product) const;
  /// Collective. A0⁻¹ v = (K_gg − K_gi K_ii⁻¹ K_ig) v with the gaps g of K_o and the rest i;
  /// factorises K_ii, the stiffness of the closed contact, on first use.
  void solveA0(Vec v, Vec solution);

 private:
  OwnedMat block(PetscInt columns) const;
  void close();

  const contact::Contact& contact_;
  contact::Transformation transformation_;
  PetscInt size_ = 0, ownedSize_ = 0, first_ = 0;
  OwnedMat stiffness_;        // K_o, n×n
  OwnedMat gaps_, friction_;  // e and U, n×n_c
  OwnedKSP solver_;
  OwnedVec part_;                                       // n_c
  OwnedMat rhs_, solution_;                             // n×2: e v and U v, and K_o⁻¹ of them
  OwnedVec single_, answer_;                            // n
  OwnedMat closedStiffness_, coupling_, gapStiffness_;  // K_ii, K_ig, K_gg
  OwnedKSP closedSolver_;
  OwnedVec inner_, innerAnswer_;
};

/// Collective. Error for a -steady_uniqueness_* option that no solver knows; those of the
/// eigenvalue solver count as known where `dense`, for it is not needed there.
void rejectUnusedUniquenessOptions(bool dense);

}  // namespace squeal::steady
