// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Local axes, named once and used by supports, couplings, loads, springs and materials. Not
/// collective.
#include <map>
#include <string>

#include "model/frame/settings.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::frame {

using mesh::Matrix3;
using mesh::Point;

/// A frame gives three orthonormal, right-handed axes at each point. The axes of a rectangular
/// frame are the same everywhere; those of a cylindrical frame are radial, tangential and axial.
/// The axes may in addition be turned about one of them.
class Frame {
 public:
  /// Makes the axes x, y, z.
  Frame() = default;
  /// Throws Error for directions that are zero or parallel and, if `dimension` is 2, for axes that
  /// are not in the plane x, y or are turned out of it.
  Frame(const FrameSettings& settings, int dimension);
  /// Makes the same axes for a mesh. Messages name `option`, which selects the frame.
  Frame(const FrameSettings& settings, const std::string& option, const mesh::Mesh& mesh);
  /// Returns the axes at a point, by rows. Throws Error, naming the option and the frame, if the
  /// frame is cylindrical and the point lies on its axis, up to round-off in coordinates of the
  /// size of the mesh.
  Matrix3 axesAt(const Point& x) const;
  bool isGlobal() const { return name_.empty(); }
  bool isCylindrical() const { return cylindrical_; }
  /// Return the origin, m, and the unit vector of the axis of a cylindrical frame.
  const Point& origin() const { return origin_; }
  const Point& axis() const { return axes_[2]; }
  /// Returns the turned axes, by rows, as components along the axes before the turn.
  const Matrix3& turn() const { return turn_; }

 private:
  std::string name_, option_;
  double diagonal_ = 0;  // of the mesh
  bool cylindrical_ = false;
  Point origin_{};
  Matrix3 axes_ = mesh::identity3;  // before the turn
  Matrix3 turn_ = mesh::identity3;
};

/// Returns the frame that an option names, or the global frame if the name is empty. Throws Error,
/// naming the option and the frames, if no frame has this name.
Frame named(const std::map<std::string, FrameSettings>& frames, const std::string& name,
            const std::string& option, const mesh::Mesh& mesh);

}  // namespace squeal::frame
