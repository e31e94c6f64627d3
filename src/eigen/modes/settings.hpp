// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the free vibration.

namespace squeal::modes {

/// Options of the free modes.
struct Settings {
  enum class Solver { automatic, blockLanczos, eps };
  int count = 200;                    ///< `-modes_count`
  bool countGiven = false;            ///< the user gives the count: too large a count is an error
  Solver solver = Solver::automatic;  ///< `-modes_solver`; eps if `-modes_eps_type` is given
  int blockSize = 8;                  ///< `-modes_block_size`
  double tolerance = 1e-8;            ///< `-modes_tolerance`: relative error of 1/ω²
  bool sturm = true;                  ///< `-modes_sturm`: confirm the count by the inertia
  /// Not collective. Reads the options.
  static Settings given();
  /// Returns the same settings for another number of modes, treated as given by the user.
  Settings withCount(int other) const;
};

}  // namespace squeal::modes
