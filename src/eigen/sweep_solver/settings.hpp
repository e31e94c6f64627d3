// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of all parts of the program that solve a sweep.
#include <optional>
#include <vector>

#include "eigen/completeness/settings.hpp"
#include "eigen/direct/settings.hpp"
#include "eigen/modes/settings.hpp"
#include "eigen/reduction/settings.hpp"
#include "eigen/sensitivity/settings.hpp"
#include "eigen/stability/settings.hpp"

namespace squeal::sweep_solver {

/// Options of a sweep. Either `reduction` or `direct` has a value.
struct Settings {
  std::optional<modes::Settings> modes;  ///< none if no free modes are needed
  std::optional<reduction::Settings> reduction;
  std::optional<direct::Settings> direct;
  std::vector<double> modalDamping{0};  ///< damping ratios of the free modes
  stability::Settings stability;
  completeness::Settings proof;  ///< completeness proof, only with the reduced method
  sensitivity::Settings sensitivity;
  /// Not collective. Reads the options; those of a method only if it is selected.
  static Settings given(const pencil::Settings& problem);
};

}  // namespace squeal::sweep_solver
