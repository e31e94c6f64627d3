// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the reduced problem.
#include "eigen/pencil/settings.hpp"

namespace squeal::reduction {

/// Options of the reduced problem.
struct Settings {
  bool corrected = true;    ///< `-flutter_basis` is not modal
  bool compressed = false;  ///< `-flutter_basis` is pod
  double tolerance = 1e-8;  ///< `-flutter_tolerance`: target of the estimate of |δs|/|s|
  int rounds = 15;          ///< `-flutter_rounds`: largest number of correction rounds per batch
  /// `-flutter_growth`: no round starts once a batch has added this many vectors.
  int growth = 1000;
  pencil::Criteria criteria;
  pencil::BandLimits band;
  /// Not collective. Reads the options.
  static Settings given(const pencil::Settings& problem);
};

}  // namespace squeal::reduction
