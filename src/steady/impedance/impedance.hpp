// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Static condensation of the bodies to the unknowns of the contact. It uses the factorised
/// stiffness K0 of the closed, frictionless contact [M.58].
///
/// The unknowns x of the model with all contact open consist of y, which remain unknowns if all
/// contact is closed and held, and of the released unknowns w: the gaps, and the tangential
/// displacements of nodes of sticking interfaces. The rows N of the normal forces and the slip rows
/// S are those of [M.10], here with φ = 1 in S. Let t = f φ R be the magnitudes of the friction
/// forces and q the loads. The first of the following equations is the equilibrium in the rows of
/// y. The others give the normal forces R and the forces F in the rows of w; their constant terms,
/// due to the loads, are omitted:
///   K0 y + K_yw w + S_yᵀ t = q,   R = N K T (y, w),   F = K_wy y + K_ww w + S_wᵀ t.
/// One solve with K0 therefore gives the responses (R, F) at the contact to causes (t, w). This map
/// depends neither on the coefficients of friction nor on which nodes are open or held.
///
/// The responses to w are the columns of the Schur complement of the contact,
///   S_c = K_ww − K_wy K0⁻¹ K_yw,   F = S_c w,   R = F in the rows of the gaps.
/// One factorisation of the stiffness with all contact open gives S_c. Its cost is given at
/// Impedance::worthwhile.
#include <algorithm>
#include <optional>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "model/contact/coupled.hpp"

namespace squeal::impedance {

/// Causes (t, w) or effects (R, F) on this rank. First come the entries of the contact nodes, t or
/// R in newtons, then those of the released unknowns, w in metres or F in newtons.
using ContactVector = std::vector<double>;

class Impedance {
 public:
  /// Collective. `open` is the T in which all gaps are unknowns and no sticking node is held,
  /// `stiffness` is K, symmetric, `slipRows` is S, and `closed` is the system with all nodes closed
  /// and held. Borrows `closed` and `contact` during the lifetime of the object.
  Impedance(const contact::Contact& contact, const contact::Transformation& open, Mat stiffness,
            Mat slipRows, const contact::CoupledSystem& closed);
  /// Returns the number of requested responses to w after which the Schur complement is computed,
  /// for this number of unknowns w. The complement costs as much as 600, 790, 1,100 and 2,740
  /// solves for 1,300, 2,000, 3,500 and 8,000 unknowns. It pays if the responses to about a third
  /// of the unknowns are needed. The first request is for those that are free on the first active
  /// set.
  static long worthwhile(PetscInt unknowns) { return std::max<long>(300, unknowns / 4); }
  /// Sets the number of responses to unit vectors of w (by default worthwhile()) above which they
  /// are taken from the Schur complement, if w has at most 8,000 entries and the complement passes
  /// a check of its accuracy.
  void condenseAfter(long requests) { after_ = requests; }
  /// Returns true if the Schur complement is in use.
  bool isCondensed() const { return isCondensed_; }

  MPI_Comm comm() const { return contact_.mesh->comm; }
  PetscInt size() const { return contact_.interfaces.totalNodes; }  ///< contact nodes of all ranks
  PetscInt nodes() const {
    return contact_.interfaces.nodes.size();
  }  ///< contact nodes of this rank
  /// Returns the contact node of each entry of w on this rank. The first nodes() entries of w are
  /// the gaps of all nodes in their order.
  const std::vector<PetscInt>& nodeOf() const { return nodeOf_; }
  /// Returns the number of entries of a ContactVector.
  PetscInt length() const { return nodes() + std::ssize(nodeOf_); }
  /// Collective. Returns the responses, one column per cause.
  linalg::DenseMatrix responses(const linalg::DenseView& causes) const;
  /// Collective. Returns the responses to the unit vectors of these entries of w, which are
  /// numbered over all ranks.
  linalg::DenseMatrix responsesToUnits(const std::vector<PetscInt>& released) const;
  /// Collective. Adds to each x the unknowns due to the column (t, w) of `causes` with the same
  /// index: w itself to the entries w of x, and the response y to the entries y.
  void addUnknowns(const linalg::DenseView& causes, const std::vector<Vec>& x) const;
  /// Collective. Each residual r has the same rows as x, and thus consists of r_y and r_w. Balances
  /// r_y by adding y = −K0⁻¹ r_y to the x with the same index. Returns one column per residual,
  /// with N K T_y y in the rows of the contact nodes and r_w + K_wy y in those of w.
  linalg::DenseMatrix relax(const std::vector<Vec>& residuals, const std::vector<Vec>& x) const;
  /// Collective. Returns S_wᵀ, released unknowns × contact nodes: the friction that acts
  /// directly in the rows of w, at nodes of sticking interfaces that slide
  /// (steady::Hold::released). The slip rows S must have no entries for y.
  OwnedMat directFriction(Mat slipRows) const;
  long solves() const { return solves_; }  ///< total number of right-hand sides so far

 private:
  linalg::DenseMatrix schurComplement() const;
  void condense() const;
  linalg::Block solved(const linalg::DenseView& forces) const;
  linalg::Block innerOf(const linalg::DenseView& t, const linalg::DenseView& w) const;
  void addInner(const linalg::Block& y, const std::vector<Vec>& x) const;

  const contact::Contact& contact_;
  const contact::CoupledSystem& closed_;
  std::vector<PetscInt> nodeOf_;
  OwnedIS nodeRows_;          // rows of the gaps among all displacements: the rows of N and S
  OwnedIS inner_, released_;  // columns of y and w in x
  OwnedMat innerFriction_, innerReleased_;               // S_yᵀ and K_yw
  OwnedMat normalInner_, normalReleased_;                // N K T for y and for w
  OwnedMat forceInner_, forceReleased_, forceFriction_;  // K_wy, K_ww and S_wᵀ
  OwnedVec work_;                                        // y
  mutable long solves_ = 0;
  mutable long units_ = 0;             // number of requested responses to units of w
  std::optional<long> after_;          // none: worthwhile()
  mutable linalg::DenseMatrix schur_;  // S_c, own rows × all columns
  mutable bool isCondensed_ = false;   // S_c is in use
  mutable bool refused_ = false;       // S_c was too inaccurate
};

}  // namespace squeal::impedance
