// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solution of the condensed contact problem for a given set of open and held nodes.
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "steady/impedance/impedance.hpp"

namespace squeal::impedance {

/// The free unknowns and the friction of a condensed problem.
struct ContactConditions {
  /// [released unknown] 1 if F = 0, as at open gaps and at nodes that are not held; w = 0 at the
  /// others
  std::vector<unsigned char> free;
  std::vector<double> coefficient;  ///< [contact node] c
  /// Direct forces on w, N, per friction magnitude t, released unknowns × contact nodes: the
  /// friction of released nodes; borrowed; null: none.
  Mat direct = nullptr;
};

/// One problem for the ContactSolver.
struct ContactCase {
  ContactConditions conditions;
  ContactVector given;  ///< (R, F)0
  /// Reference of the relative accuracy of the friction, N, if it exceeds the effect of the given
  /// forces: a correction needs fewer digits than the quantity that it corrects.
  double frictionUnit = 0;
};

/// A solution of the condensed problem.
struct ContactSolution {
  ContactVector causes;   ///< (t, w)
  ContactVector effects;  ///< (R, F), including the given ones
  /// False if friction cannot be balanced, or if forces act on a rigid-body mode of the free
  /// unknowns: F is not zero then.
  bool found = false;
};

/// Solves [M.59]
///   (R, F) = (R, F)0 + Z (t, w),   t = c R,   F = 0 or w = 0
/// for any choice of the unknowns that are free, any coefficients c and any given forces (R, F)0. Z
/// are the responses of an Impedance. All later calls reuse the computed parts of Z: the columns of
/// unknowns that have been free, and a space of friction magnitudes t. As in GMRES without restart,
/// this space grows by each residual that it does not contain. Cases that are solved together
/// extend it in blocks.
class ContactSolver {
 public:
  /// Collective. Borrows the impedance during the lifetime of the object.
  explicit ContactSolver(const Impedance& impedance);
  ~ContactSolver();
  /// Collective. Solves the problem within round-off.
  ContactSolution solve(const ContactCase& one) { return solve({&one, 1}).front(); }
  /// Collective. Solves all cases. The friction may stay unbalanced by the fraction `accuracy` of
  /// its causes.
  std::vector<ContactSolution> solve(std::span<const ContactCase> cases,
                                     double accuracy = balanced);
  /// Collective. Solves one case with all gaps given, [contact node], regardless of `free`.
  ContactSolution withGaps(const std::vector<double>& gaps, ContactCase one);
  /// Returns the force that opens the gap of a contact node of this rank by a unit, N/m, with all
  /// other gaps closed; 0 if the gap has never been open.
  double gapStiffness(std::size_t node) const;

  /// An accuracy of the friction equivalent to round-off: the residual of all equations, which
  /// refinement reduces if necessary, has fewer digits.
  static constexpr double balanced = 1e-12;

 private:
  struct FreeBlock;
  struct Search;
  void computeColumns(std::span<const unsigned char> free);
  std::shared_ptr<FreeBlock> blockOf(const ContactConditions& conditions);
  linalg::DenseMatrix released(const FreeBlock& block, const linalg::DenseView& effects) const;
  linalg::DenseMatrix release(const FreeBlock& block, linalg::DenseMatrix& effects) const;
  void addDirect(const FreeBlock& block, const linalg::DenseView& t,
                 linalg::DenseMatrix& effects) const;
  void noteFriction(std::span<const ContactCase> cases);
  void update(FreeBlock& block) const;
  std::vector<std::size_t> groups(std::span<const ContactCase> cases) const;
  void balance(std::vector<Search>& searches, double accuracy);
  ContactSolution solution(const Search& search, double accuracy) const;
  bool extend(const linalg::DenseMatrix& directions);

  const Impedance& impedance_;
  PetscInt first_ = 0;                              // number of this rank's first released unknown
  std::unordered_map<PetscInt, PetscInt> place_;    // of a released unknown in the next
  linalg::DenseMatrix columns_;                     // Z (0, e), [n + m]×[known column]
  std::vector<PetscInt> frictional_;                // contact nodes with c in some case so far
  linalg::DenseMatrix frictionalColumns_;           // R of them, [frictional node]×[known column]
  linalg::DenseMatrix magnitudes_, responses_;      // t, orthonormal, and Z (t, 0)
  std::vector<std::shared_ptr<FreeBlock>> blocks_;  // of the last conditions, the newest first
};

}  // namespace squeal::impedance
