// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The division of a sweep into groups of points that share a factorisation and a basis.
#include <vector>

#include "run/analysis/sliding_brake.hpp"

namespace squeal::analysis {

/// The points [first, last) of SteadyStates::solutions.
struct PointGroup {
  std::size_t first = 0, last = 0;
  /// The first point is the last one of the preceding group, whose eigenvalues are continued.
  bool continues = false;
  bool isContinued = false;  ///< the next group continues this one
};

/// Returns true if the eigenvalues of a sweep are tracked from points with this friction.
bool areTracked(const Settings& settings, const Model& model, double friction);

/// Returns true if it is to be examined whether eigenvalues can be tracked from friction 0 to the
/// first point of a line.
bool tracksFromZero(const Settings& settings, const Model& model, const sweep::Sweep& sweep);

/// Collective. Returns the points with a steady solution in groups whose active sets differ in at
/// most MeshSettings::released nodes. Of all such divisions in which the active set changes at most
/// 64 times within a group, it is the one with the least estimated work (groupWork()). If
/// eigenvalues are tracked, a group begins with the last point of the preceding group where the
/// limit permits it. With modal damping and prestress, each point is a group of its own, since
/// prestress changes the free modes. The result does not depend on the number of ranks.
std::vector<PointGroup> groupsOf(const SlidingBrake& brake);

}  // namespace squeal::analysis
