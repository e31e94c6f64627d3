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
  /// [entry of w] 1: free, F = 0 (gap of an open node, tangential displacement of a node that is
  /// not held); 0: held, w = 0. impedance.hpp defines w, F and t.
  std::vector<unsigned char> free;
  std::vector<double> coefficient;  ///< [contact node] c
  /// S_wᵀ, [entry of w]×[contact node]. S_wᵀ t is the friction that acts directly in the rows of w,
  /// at nodes of sticking interfaces that slide (steady::Hold::released). Borrowed; null without
  /// such nodes.
  Mat direct = nullptr;
};

/// One problem for the ContactSolver.
struct ContactCase {
  ContactConditions conditions;
  ContactVector given;  ///< (R, F)0
  /// The accuracy is relative to this force, N, or to the friction due to the given forces if that
  /// is larger. For a correction, set it to the friction to be corrected: a correction needs fewer
  /// digits.
  double frictionUnit = 0;
};

/// A solution of the condensed problem.
struct ContactSolution {
  ContactVector causes;   ///< (t, w)
  ContactVector effects;  ///< (R, F), including the given ones
  /// False if t = c R cannot be met, or if forces act on a rigid-body mode of the free unknowns, so
  /// that F ≠ 0 there.
  bool found = false;
};

/// Solutions for several given forces, [entry]×[column].
struct ContactResponses {
  linalg::DenseMatrix causes, effects;  ///< (t, w) and (R, F)
  std::vector<int> found;               ///< [column] 1 if ContactSolution::found would be true
};

/// Solves [M.59]
///   (R, F) = (R, F)0 + Z (t, w),   t = c R,   F = 0 or w = 0
/// for any choice of free unknowns, any coefficients c and any given forces (R, F)0. Z contains the
/// responses of an Impedance. Later calls reuse what is known of Z: computed columns, and the
/// products with a space of friction magnitudes t. As in GMRES without restart, residuals outside
/// this space extend it. Cases that are solved together extend it in blocks.
class ContactSolver {
 public:
  /// Collective. Borrows the impedance during the lifetime of the object.
  explicit ContactSolver(const Impedance& impedance);
  /// Collective. Solves the problem to the accuracy `balanced`.
  ContactSolution solve(const ContactCase& one) { return solve({&one, 1}).front(); }
  /// Collective. Solves all cases. At most the fraction `accuracy` of the friction remains
  /// unbalanced.
  std::vector<ContactSolution> solve(std::span<const ContactCase> cases,
                                     double accuracy = balanced);
  /// Collective. Solves one case with given gaps, [contact node], whose entries of `free` are
  /// ignored.
  ContactSolution withGaps(const std::vector<double>& gaps, ContactCase one);
  /// Collective. Returns for each case its solution, in column 0, and its responses to changes of
  /// the entries `changed` of w, numbered over all ranks. The cases may differ only in their
  /// coefficients and given forces. Column k + 1, without the given forces, is the response to w =
  /// 1 of changed[k] if it is held, and to a unit force on it if it is free. F does not include
  /// this unit force, so F = −1 in the row of changed[k] if it is free. The sum of the solution and
  /// of multiples of the responses solves the case with other F or w of the changed unknowns.
  /// `frictionUnits`, [changed], is the ContactCase::frictionUnit of the responses.
  std::vector<ContactResponses> respond(std::span<const ContactCase> cases,
                                        const std::vector<PetscInt>& changed,
                                        const std::vector<double>& frictionUnits);
  /// Returns the force per displacement, N/m, of an entry of w of this rank, with all others held;
  /// 0 if its column is not known. The first unknowns are the gaps of the nodes.
  double stiffness(std::size_t unknown) const;

  /// An accuracy of the friction equivalent to round-off. The residual of all equations may be
  /// larger; refinement reduces it if necessary.
  static constexpr double balanced = 1e-12;

 private:
  struct Search;
  void computeColumns(std::span<const unsigned char> free);
  std::vector<linalg::DenseMatrix> release(const std::vector<Search>& searches,
                                           std::vector<linalg::DenseMatrix>& effects) const;
  void addDirect(const FreeBlock& block, const linalg::DenseView& t,
                 linalg::DenseMatrix& effects) const;
  void noteFriction(std::span<const ContactCase> cases);
  void update(std::span<FreeBlock* const> blocks) const;
  void update(Search& search) const;
  std::vector<std::size_t> groups(std::span<const ContactCase> cases) const;
  void begin(std::vector<Search>& searches);
  void balance(std::vector<Search>& searches, double accuracy);
  std::vector<ContactResponses> responses(const std::vector<Search>& searches,
                                          double accuracy) const;
  ContactResponses responsesOf(const Search& search, const linalg::DenseMatrix& t,
                               const linalg::DenseMatrix& freed, linalg::DenseMatrix all,
                               double accuracy) const;
  bool extend(const linalg::DenseMatrix& directions);

  const Impedance& impedance_;
  FreeUnknowns free_;
  std::vector<PetscInt> frictional_;       // contact nodes with c ≠ 0 in some case so far
  linalg::DenseMatrix frictionalColumns_;  // R of these nodes, [frictional node]×[known column]
  linalg::DenseMatrix magnitudes_, responses_;  // t, orthonormal, and Z (t, 0)
};

}  // namespace squeal::impedance
