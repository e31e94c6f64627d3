// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solution of the condensed contact problem for a given set of open and held nodes.
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "steady/impedance/free_unknowns.hpp"
#include "steady/impedance/impedance.hpp"

namespace squeal::impedance {

/// The free unknowns and the friction of a condensed problem.
struct ContactConditions {
  /// [released unknown] 1 if F = 0, as for open gaps and for nodes that are not held; 0 if w = 0
  std::vector<unsigned char> free;
  std::vector<double> coefficient;  ///< [contact node] c
  /// The direct effect of friction magnitudes t on F, released unknowns × contact nodes: the
  /// friction on nodes that slide (steady::Hold::released). Borrowed; null if there is none.
  Mat direct = nullptr;
};

/// One problem for the ContactSolver.
struct ContactCase {
  ContactConditions conditions;
  ContactVector given;  ///< (R, F)0
  /// Reference of the accuracy, N, unless the friction due to the given forces is larger. For a
  /// correction, set it to the friction to be corrected: a correction needs fewer digits.
  double frictionUnit = 0;
};

/// A solution of the condensed problem.
struct ContactSolution {
  ContactVector causes;   ///< (t, w)
  ContactVector effects;  ///< (R, F), including the given ones
  /// False if friction cannot be balanced, or if forces act on a rigid-body mode of the free
  /// unknowns, where F is then not zero.
  bool found = false;
};

/// Solves [M.59]
///   (R, F) = (R, F)0 + Z (t, w),   t = c R,   F = 0 or w = 0
/// for any choice of free unknowns, any coefficients c and any given forces (R, F)0. Z contains the
/// responses of an Impedance. All later calls reuse the computed parts of Z: the columns of
/// unknowns that have been free, and a space of friction magnitudes t. As in GMRES without restart,
/// each residual that this space does not contain extends it. Cases that are solved together extend
/// it in blocks.
class ContactSolver {
 public:
  /// Collective. Borrows the impedance during the lifetime of the object.
  explicit ContactSolver(const Impedance& impedance);
  /// Collective. Solves the problem up to round-off.
  ContactSolution solve(const ContactCase& one) { return solve({&one, 1}).front(); }
  /// Collective. Solves all cases. At most the fraction `accuracy` of the friction remains
  /// unbalanced.
  std::vector<ContactSolution> solve(std::span<const ContactCase> cases,
                                     double accuracy = balanced);
  /// Collective. Solves one case with all gaps given, [contact node], regardless of `free`.
  ContactSolution withGaps(const std::vector<double>& gaps, ContactCase one);
  /// Returns the force that opens the gap of a contact node of this rank by a unit, N/m, with all
  /// other gaps closed; 0 if the gap has never been open.
  double gapStiffness(std::size_t node) const;

  /// An accuracy of the friction equivalent to round-off. The residual of all equations may be
  /// larger; refinement reduces it if necessary.
  static constexpr double balanced = 1e-12;

 private:
  struct Search;
  void computeColumns(std::span<const unsigned char> free);
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
  FreeUnknowns free_;
  std::vector<PetscInt> frictional_;       // contact nodes with c ≠ 0 in some case so far
  linalg::DenseMatrix frictionalColumns_;  // R of these nodes, [frictional node]×[known column]
  linalg::DenseMatrix magnitudes_, responses_;  // t, orthonormal, and Z (t, 0)
};

}  // namespace squeal::impedance
