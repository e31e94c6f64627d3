// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Base motion of a body's matter (Moirot and Nguyen 2000, section 2), a rotation or a translation
/// [2.1]:
///   V = ω k × (x − x0)   or   V = const.
/// The sweep multiplies V by a speed factor. Not collective: all ranks have the same options, and
/// therefore the same results and Errors.
#include <map>
#include <string>
#include <vector>

#include "model/elasticity/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// The base motion of one body; `translation` and `speed` are zero for a body at rest.
struct Motion {
  mesh::Point translation{};  ///< m/s
  double speed = 0;           ///< ω, rad/s
  mesh::Point axis{0, 0, 1};  ///< k, unit vector
  mesh::Point origin{};       ///< x0, m

  /// Returns V(x), m/s.
  mesh::Point velocity(const mesh::Point& x) const;
  bool moves() const;
};

/// Returns the motion of each body, [body]; a body without options is at rest. Throws Error for an
/// option of a group that is not a body, for an axis of zero length, and for vectors with a wrong
/// number of components.
std::vector<Motion> motionsOf(const std::vector<std::string>& bodies, int dimension,
                              const std::map<std::string, MotionSettings>& settings);

}  // namespace squeal::elasticity
