// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the direct method.
#include "eigen/pencil/settings.hpp"

namespace squeal::direct {

/// Options of the direct method.
struct Settings {
  int count = 100;        ///< `-flutter_direct_count`: eigenvalues nearest to zero
  int limit = 2000;       ///< `-flutter_direct_limit`: largest number of eigenvalues for a band
  double low = 0;         ///< lower end of `-flutter_direct_band`, rad/s
  double high = 0;        ///< upper end of the band, rad/s; 0 = no band
  bool confirmed = true;  ///< `-flutter_direct_confirm`: repeat until no new eigenvalue is found
  pencil::Criteria criteria;
  /// Not collective. Reads the options. Throws Error if the band is not two ascending frequencies.
  static Settings given(const pencil::Settings& problem);
};

}  // namespace squeal::direct
