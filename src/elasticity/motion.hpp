#pragma once
/// The base motion of a body's matter: V = ω k × (x − x0), or a translation (formulation: section 2
/// of the paper).
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace squeal::elasticity {

struct Motion {
  mesh::Point translation{};  ///< m/s
  double speed = 0;           ///< ω, rad/s
  mesh::Point axis{0, 0, 1};  ///< k, unit vector
  mesh::Point origin{};       ///< x0, m

  /// V(x), m/s.
  mesh::Point velocity(const mesh::Point& x) const;
  bool moves() const;
};

/// Option -motion_convective: the matter of moving bodies carries its displacement along, D u =
/// (V·∇)u.
bool convectiveTerms();
/// Bodies with a `-motion_<body>_*` option.
std::vector<std::string> movingBodies();
/// Which options give a motion, for messages.
inline const char* motionOptions() { return "-motion_<body>_*"; }
/// Motion of each body in turn; none given: at rest. Error: rotation and translation together, both
/// units of the speed, axis of zero length, vectors that have not the components of the mesh's
/// dimension.
std::vector<Motion> readMotions(const std::vector<std::string>& bodies, int dimension);

}  // namespace squeal::elasticity
