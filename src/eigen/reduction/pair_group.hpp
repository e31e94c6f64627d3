// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Joint improvement of groups of neighbouring eigenpairs of a dense problem.
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/reduction/companion.hpp"

namespace squeal::reduction {

/// A pair that needs improvement, by its index in a list.
struct UnconvergedPair {
  std::size_t pair;
  double right;  ///< fraction of its residual P(s) x that may remain
  double left;   ///< fraction of its left residual P(s)ᴴ y that may remain
};

/// A group of neighbouring pairs (its members). Their right and left vectors are iterated together,
/// by two-sided block inverse iteration with a shift in the middle of the members.
class PairGroup {
 public:
  /// Borrows the companion form and the pairs. Their vectors must have the order of the problem.
  PairGroup(const Companion& companion, std::vector<linalg::DensePair>& pairs,
            const std::vector<UnconvergedPair>& open);
  /// Returns the indices of the members in the list of pairs.
  const std::vector<std::size_t>& members() const { return members_; }
  enum class Outcome { untouched, done, unfinished, failed };
  /// Iterates until the residuals are small enough, at least once if `forced`, and at most twice.
  Outcome iterate(bool forced);

 private:
  /// The lengths of P(s) x and P(s)ᴴ y for vectors of 2-norm 1, [member].
  struct Residuals {
    std::vector<double> right, left;
  };
  /// Right and left vectors of the members and their neighbours, and of the Ritz pairs.
  struct Subspaces {
    ComplexMatrix right, left, ritzRight, ritzLeft;
  };
  bool isDone();
  bool step();
  Residuals residuals() const;
  std::vector<double> residuals(std::vector<Complex> linalg::DensePair::*vector, bool left) const;
  double roundOff() const;
  std::vector<std::optional<std::size_t>> assigned(const Subspaces& subspaces) const;
  bool replace(std::size_t member, Complex s, const ComplexMatrix& x, const ComplexMatrix& y);

  const Companion& companion_;
  std::vector<linalg::DensePair>& pairs_;
  std::vector<std::size_t> members_, neighbours_;
  Complex shift_ = 0;
  double reach_ = 0;  // largest distance of a member from the middle of the group
  std::optional<ShiftInvert> inverse_;
  Residuals wanted_, first_;  // permitted fractions of the first residuals; first residuals
  double roundOff_ = 0;
};

/// Returns the open pairs in groups of neighbours, each within a limited frequency range.
std::vector<std::vector<UnconvergedPair>> groupsOf(const std::vector<linalg::DensePair>& pairs,
                                                   std::vector<UnconvergedPair> open);

}  // namespace squeal::reduction
