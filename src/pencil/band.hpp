#pragma once
/// The band: the eigenvalues that a run lists, corrects and follows.
#include <complex>
#include <vector>

namespace squeal::pencil {

/// `-flutter_band`, rad/s; 0: not given.
double bandAsked();
/// Its end for free modes of these angular frequencies, ascending: by itself a little more than
/// half up the list. It ends below the last mode (unless all are the same): nothing would tell of
/// an eigenvalue above that is missing, as corrections are those of eigenvalues found.
double bandBelow(const std::vector<double>& frequencies);
/// `-flutter_band_damping`: largest damping ratio.
double bandDamping();

/// The eigenvalues that a run is about, and those watched beside them.
struct WatchedBand {
  double top = 1e300;    ///< rad/s, of |s|
  double guard = 1.3;    ///< eigenvalues are watched up to this multiple of `top` and of `damping`
  double damping = 0.5;  ///< largest damping ratio
  double origin = 0.1;   ///< all are watched up to this multiple of `top`: a real eigenvalue may
                         ///< pass through zero
  bool contains(std::complex<double> s) const { return std::abs(s) <= top && lasts(s); }
  bool watches(std::complex<double> s) const {
    return std::abs(s) <= guard * top &&
           (-s.real() <= guard * damping * std::abs(s) || std::abs(s) <= origin * top);
  }
  /// Does not die away at once.
  bool lasts(std::complex<double> s) const { return -s.real() <= damping * std::abs(s); }
};

}  // namespace squeal::pencil
