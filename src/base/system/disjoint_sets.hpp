// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Disjoint sets of numbers, which are merged step by step (union-find).
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace squeal {

/// The numbers 0, 1, …, each in a set of its own at first. Not collective.
template <class Number>
class DisjointSets {
 public:
  explicit DisjointSets(Number count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Number(0));
  }
  /// Returns the smallest number in the set that contains `one`. Shortens the path to that number
  /// for later calls.
  Number smallest(Number one) {
    while (parent_[one] != one) one = std::exchange(parent_[one], parent_[parent_[one]]);
    return one;
  }
  void join(Number one, Number other) {
    const Number a = smallest(one), b = smallest(other);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Number> parent_;
};

}  // namespace squeal
