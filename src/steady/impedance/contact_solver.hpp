// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The condensed contact problem is solved for a given choice of open and held nodes.
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "steady/impedance/impedance.hpp"

namespace squeal::impedance {

/// Which unknowns are free, and how much friction there is, is asked of the condensed problem.
struct ContactConditions {
  /// [released unknown] 1 where F = 0, as at open gaps and where nothing holds a node; w = 0 at the
  /// others
  std::vector<unsigned char> free;
  std::vector<double> coefficient;  ///< [contact node] c
  /// Forces on w, N, that friction magnitudes t cause directly, released unknowns × contact nodes:
  /// the friction of nodes that stick no longer; borrowed; null: none.
  Mat direct = nullptr;
};

/// One problem for the ContactSolver.
struct ContactCase {
  ContactConditions conditions;
  ContactVector given;  ///< (R, F)0
  /// The part of the friction that may stay unbalanced refers to this, N, if it is larger than what
  /// the given forces cause: a correction needs fewer digits than what it corrects.
  double frictionUnit = 0;
};

/// A solution of the condensed problem.
struct ContactSolution {
  ContactVector causes;   ///< (t, w)
  ContactVector effects;  ///< (R, F), those given included
  /// False where friction cannot be balanced, or where the free unknowns leave a body loose that
  /// forces act on: F is not zero then.
  bool found = false;
};

/// A ContactSolver solves [M.59]
///   (R, F) = (R, F)0 + Z (t, w),   t = c R,   F = 0 or w = 0
/// for any choice of the unknowns that are free, any coefficients c and any given forces (R, F)0.
/// Z stands for the responses of an Impedance. What has been learnt of Z serves all later calls:
/// the columns of unknowns that have once been free, and a space of friction magnitudes t that
/// grows by each residual that it does not cover, as in GMRES without restart. Cases that are
/// solved together let it grow in blocks.
class ContactSolver {
 public:
  /// Collective. Borrows the impedance during the life of the object.
  explicit ContactSolver(const Impedance& impedance);
  ~ContactSolver();
  /// Collective. Solves the problem to rounding.
  ContactSolution solve(const ContactCase& one) { return solve({&one, 1}).front(); }
  /// Collective. Solves all cases. The friction may stay unbalanced by the part `accuracy` of what
  /// causes it.
  std::vector<ContactSolution> solve(std::span<const ContactCase> cases,
                                     double accuracy = balanced);
  /// Collective. Solves one case with all gaps given, [contact node], whatever `free` says of them.
  ContactSolution withGaps(const std::vector<double>& gaps, ContactCase one);
  /// Returns the force on the gap of a contact node of this rank that opening it by a unit takes,
  /// N/m, while all others are closed; 0 if it has never been open.
  double gapStiffness(std::size_t node) const;

  /// The accuracy of the friction that is as good as rounding: the residual of all equations, which
  /// is refined where that is not enough, is known to fewer digits.
  static constexpr double balanced = 1e-12;

 private:
  struct FreeBlock;
  struct Search;
  void learn(std::span<const unsigned char> free);
  std::shared_ptr<FreeBlock> blockOf(const ContactConditions& conditions);
  linalg::DenseMatrix release(const FreeBlock& block, linalg::DenseMatrix& effects) const;
  void addDirect(const FreeBlock& block, const linalg::DenseView& t,
                 linalg::DenseMatrix& effects) const;
  void update(FreeBlock& block) const;
  std::vector<std::size_t> groups(std::span<const ContactCase> cases) const;
  void balance(std::vector<Search>& searches, double accuracy);
  ContactSolution solution(const Search& search, double accuracy) const;
  bool extend(const linalg::DenseMatrix& directions);

  const Impedance& impedance_;
  PetscInt first_ = 0;                              // number of this rank's first released unknown
  std::unordered_map<PetscInt, PetscInt> place_;    // of a released unknown in the next
  linalg::DenseMatrix columns_;                     // Z (0, e), [n + m]×[known column]
  linalg::DenseMatrix magnitudes_, responses_;      // t, orthonormal, and Z (t, 0)
  std::vector<std::shared_ptr<FreeBlock>> blocks_;  // of the last conditions, the newest first
};

}  // namespace squeal::impedance
