// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the examination of existence and uniqueness. Not collective.

namespace squeal::uniqueness {

struct Settings {
  bool wanted = true;
  int dense = 1000;  ///< largest number of contact nodes for which the condensed matrix A is formed
  int pMatrix = 18;  ///< largest number n of contact nodes for the P-matrix test, with 2^n pivots

  /// Reads the options; reads the limits only if the examination is enabled.
  static Settings given();
};

}  // namespace squeal::uniqueness
