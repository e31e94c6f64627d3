// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Random numbers that are the same on every machine.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace squeal::fuzz {

/// splitmix64: the standard library promises the numbers of its generators, but not those of its
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }
  /// From 0 to `bound` - 1; `bound` > 0.
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(next() % bound); }
  /// A whole number from `low` to `high`, both included.
  int between(int low, int high) { return low + static_cast<int>(below(high - low + 1)); }
  /// From 0 to 1, 1 excluded.
  double fraction() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * fraction(); }
  /// The logarithm is uniform; both bounds are positive.
  double logarithmic(double low, double high) { return low * std::pow(high / low, fraction()); }
  bool chance(double probability) { return fraction() < probability; }
  template <class Value>
  Value oneOf(std::vector<Value> values) {
    return values[below(values.size())];
  }

 private:
  std::uint64_t state_;
};

}  // namespace squeal::fuzz
