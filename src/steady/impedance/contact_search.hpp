// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The state of a search of ContactSolver; internal to its sources.
#include <memory>
#include <vector>

#include "steady/impedance/contact_solver.hpp"

namespace squeal::impedance {

/// The search, in the space of friction magnitudes, for the friction due to several given forces
/// under the same conditions.
struct ContactSolver::Search {
  const ContactConditions& conditions;
  linalg::DenseMatrix given;  // (R, F)0, one column for each
  std::vector<double> unit;   // [column] reference of the unbalanced part, N
  std::shared_ptr<FreeBlock> block = nullptr;
  linalg::DenseMatrix wanted = {};  // t without its own effects, [contact node]×[column]
  linalg::DenseMatrix weights{0, given.columns()};  // [direction]×[column]
  std::vector<double> left = {};                    // [column] 2-norm of the unbalanced part, N
  linalg::DenseMatrix g = {}, gram = {};  // t − c R of the space, [contact node]×[direction]; GᵀG

  bool isBalanced(std::size_t column, double accuracy) const {
    return left[column] <= accuracy * unit[column];
  }
  bool isBalanced(double accuracy) const {
    for (std::size_t j = 0; j < left.size(); ++j)
      if (!isBalanced(j, accuracy)) return false;
    return true;
  }
};

}  // namespace squeal::impedance
