// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the eigenvalue problem: its method, its band, its criteria and modal damping.
#include <vector>

namespace squeal::pencil {

/// How the eigenvalue problem is solved: reduced to a basis, or in all unknowns.
enum class Method { reduced, direct };

/// Criteria of the verdict on an eigenvalue, and of the choice of stored complex modes.
struct Criteria {
  double accuracy =
      1e-9;             ///< `-flutter_accuracy`: largest backward error of a certified eigenvalue
  double unstable = 0;  ///< `-flutter_unstable_tolerance`: ζ of [M.24]
  int shapes = 3;       ///< `-flutter_shapes`: largest number of complex modes stored per point
  bool stableShapes = false;   ///< `-flutter_shapes_stable`: stable complex modes are stored too
  double shapesBelow = 1e300;  ///< `-flutter_shapes_below`: upper bound of the frequencies of
                               ///< stored complex modes, rad/s
};

/// Limits of the band.
struct BandLimits {
  double top = 0;        ///< `-flutter_band` in rad/s; 0 = automatic
  double damping = 0.5;  ///< `-flutter_band_damping`: largest damping ratio in the band
};

/// Options of the eigenvalue problem.
struct Settings {
  Method method = Method::reduced;  ///< `-flutter_method`
  Criteria criteria;
  BandLimits band;  ///< read only for the reduced method
  /// `-flutter_modal_damping`: damping ratios of the free modes; the last one applies to all
  /// further modes.
  std::vector<double> modalDamping{0};

  /// Returns true if a modal damping ratio is positive.
  bool isModallyDamped() const;
  /// Not collective. Reads the options.
  static Settings given();
};

}  // namespace squeal::pencil
