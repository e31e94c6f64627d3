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

/// A frame gives three orthonormal, right-handed axes at each point: the same everywhere if it is
/// rectangular; radial, tangential and axial if it is cylindrical. They may be turned about one of
/// themselves.
class Frame {
 public:
  /// Makes the axes x, y, z.
  Frame() = default;
  /// Throws Error for directions that are zero or parallel and, if `dimension` is 2, for axes out
  /// of the plane or turned out of it.
  Frame(const FrameSettings& settings, int dimension);
  /// The same for an option, which messages name, on a mesh.
  Frame(const FrameSettings& settings, const std::string& option, const mesh::Mesh& mesh);
  /// Returns the axes at a point, by rows. Throws Error, naming the option and the frame, at a
  /// point on the axis of a cylindrical one, up to round-off of the size of the mesh.
  Matrix3 axesAt(const Point& x) const;
  bool isGlobal() const { return name_.empty(); }
  bool isCylindrical() const { return cylindrical_; }
  /// Return the origin, m, and the axis of a cylindrical frame, a unit vector.
  const Point& origin() const { return origin_; }
  const Point& axis() const { return axes_[2]; }
  /// Returns the axes, by rows, in components along those before the turn.
  const Matrix3& turn() const { return turn_; }

 private:
  std::string name_, option_;
  double diagonal_ = 0;  // of the mesh
  bool cylindrical_ = false;
  Point origin_{};
  Matrix3 axes_ = mesh::identity3;  // before the turn
  Matrix3 turn_ = mesh::identity3;
};

/// Returns the frame that an option names, the global one for an empty name. Throws Error, naming
/// the option and the frames, if there is none of this name.
Frame named(const std::map<std::string, FrameSettings>& frames, const std::string& name,
            const std::string& option, const mesh::Mesh& mesh);

}  // namespace squeal::frame
