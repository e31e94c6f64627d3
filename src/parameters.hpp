#pragma once
/// What a sweep varies.

namespace squeal {

/// One point of a sweep.
struct Parameters {
  double friction = 0;  ///< f, coefficient of friction
  double speed = 1;     ///< v, a factor on the base motions of all bodies and obstacles
};

}  // namespace squeal
