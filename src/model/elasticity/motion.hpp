#pragma once
/// This file gives the base motion of a body's matter (paper, section 2), a rotation or a
/// translation [2.1]:
///   V = ω k × (x − x0)   or   V = const.
/// No function is collective; all ranks have the same options, and so the same results and Errors.
#include <optional>
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// The base motion of one body; both velocities are zero for a body at rest.
struct Motion {
  mesh::Point translation{};  ///< m/s
  double speed = 0;           ///< ω, rad/s
  mesh::Point axis{0, 0, 1};  ///< k, unit vector
  mesh::Point origin{};       ///< x0, m

  /// Returns V(x), m/s.
  mesh::Point velocity(const mesh::Point& x) const;
  bool moves() const;
};

/// Returns the option -motion_convective: the matter of moving bodies then carries its displacement
/// along,
///   D u = (V·∇)u.
bool convectiveTerms();
/// Returns the bodies with a `-motion_<body>_*` option.
std::vector<std::string> movingBodies();
/// Returns the options that give a motion, for messages.
inline const char* motionOptions() { return "-motion_<body>_*"; }
/// Returns the motion of each body, [body]; a body without options is at rest. Throws Error if
/// rotation and translation, or both units of the speed, are given together, for an option of a
/// group that is no body, for an axis of zero length, and for vectors whose number of components
/// does not suit the dimension.
std::vector<Motion> readMotions(const std::vector<std::string>& bodies, int dimension);

}  // namespace squeal::elasticity
