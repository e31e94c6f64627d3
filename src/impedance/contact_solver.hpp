#pragma once
/// The condensed contact problem is solved for a given choice of open and held nodes.
#include <memory>
#include <unordered_map>
#include <vector>

#include "impedance/impedance.hpp"
#include "linalg/dense.hpp"

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

/// A solution of the condensed problem.
struct ContactSolution {
  ContactVector causes;   ///< (t, w)
  ContactVector effects;  ///< (R, F), those given included
  bool found = false;     ///< false where friction cannot be balanced
};

/// A ContactSolver solves [M.59]
///   (R, F) = (R, F)0 + Z (t, w),   t = c R,   F = 0 or w = 0
/// for any choice of the unknowns that are free, any coefficients c and any given forces (R, F)0.
/// Z stands for the responses of an Impedance. What has been learnt of Z serves all later calls:
/// the columns of unknowns that have once been free, and a space of friction magnitudes t that
/// grows by each residual that it does not cover, as in GMRES without restart.
class ContactSolver {
 public:
  /// Collective. Borrows the impedance during the life of the object.
  explicit ContactSolver(const Impedance& impedance);
  ~ContactSolver();
  /// Collective. Solves the problem.
  ContactSolution solve(const ContactConditions& conditions, const ContactVector& given);
  /// Collective. The same with all gaps given, [contact node], whatever `free` says of them.
  ContactSolution withGaps(const std::vector<double>& gaps, ContactConditions conditions,
                           const ContactVector& given);
  /// Returns the force on the gap of a contact node of this rank that opening it by a unit takes,
  /// N/m, while all others are closed; 0 if it has never been open.
  double gapStiffness(std::size_t node) const;

 private:
  struct FreeBlock;
  void learn(const std::vector<unsigned char>& free);
  FreeBlock& blockOf(const ContactConditions& conditions);
  linalg::DenseMatrix release(const FreeBlock& block, linalg::DenseMatrix& effects) const;
  bool extend(std::vector<double> direction);

  const Impedance& impedance_;
  PetscInt first_ = 0;                            // number of this rank's first released unknown
  std::unordered_map<PetscInt, PetscInt> place_;  // of a released unknown in the next
  linalg::DenseMatrix columns_;                   // Z (0, e), [n + m]×[known column]
  linalg::DenseMatrix magnitudes_, responses_;    // t, orthonormal, and Z (t, 0)
  std::unique_ptr<FreeBlock> closed_, open_;      // of the last conditions without and with an
                                                  // open gap
};

}  // namespace squeal::impedance
