// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the proof of the number of eigenvalues.

namespace squeal::completeness {

struct Settings {
  bool wanted = false;  ///< `-flutter_proof`
  int discs = 400;      ///< `-flutter_proof_discs`: limit of expansions on the boundary per point
  /// Not collective. Reads the options.
  static Settings given();
};

}  // namespace squeal::completeness
