// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The band: the eigenvalues that a run lists, corrects and tracks [M.27].
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "eigen/pencil/settings.hpp"

namespace squeal::pencil {

/// Returns the top of the band, rad/s. `frequencies` are the angular frequencies of the free modes,
/// rad/s, ascending and not empty. The top is `requested` if this is positive; otherwise it lies
/// just above the mode at 55 % of the list. A top above the highest mode is lowered to just below
/// this mode, unless all modes have the same frequency. The reason: corrections begin with the
/// eigenvalues of the reduced problem, which may lack some above the highest mode without notice.
double bandBelow(const std::vector<double>& frequencies, double requested = 0);

/// The band and the guard zone around it [M.43], whose eigenvalues are tracked too.
struct WatchedBand {
  double top = 1e300;    ///< largest |s| in the band, rad/s
  double guard = 1.3;    ///< eigenvalues are watched up to this multiple of `top` and of `damping`
  double damping = 0.5;  ///< largest damping ratio in the band
  double origin = 0.1;   ///< eigenvalues up to this multiple of `top` are watched even if strongly
                         ///< damped, as a real one may pass through zero
  /// Returns true if s, with Im s ≥ 0, is in the band.
  bool contains(Complex s) const { return std::abs(s) <= top && lasts(s); }
  /// Returns true if s, with Im s ≥ 0, is in the band or in the guard zone.
  bool watches(Complex s) const {
    return std::abs(s) <= guard * top &&
           (-s.real() <= guard * damping * std::abs(s) || std::abs(s) <= origin * top);
  }
  /// Returns true if the damping ratio of s is at most `damping`.
  bool lasts(Complex s) const { return -s.real() <= damping * std::abs(s); }
};

/// Returns the band with the top from bandBelow() for these frequencies of the free modes, and with
/// `limits.damping`.
WatchedBand bandFor(const std::vector<double>& frequencies, const BandLimits& limits);

}  // namespace squeal::pencil
