// SPDX-License-Identifier: BSD-2-Clause
#include "model/frame/frame.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "base/system/text.hpp"

namespace squeal::frame {
namespace {

using mesh::cross;
using mesh::length;
using mesh::unit;

/// Two directions are parallel if the sine of their angle is below this.
constexpr double parallel = 1e-6;
/// A point lies on an axis if its distance is below this, relative to the size of the mesh, or
/// below the round-off of its coordinates, relative to them.
constexpr double onAxis = 1e-9, positionRounding = 1e-12;

Point unitOf(const VectorValue& direction, const std::string& option, int dimension) {
  const Point given = direction.in(dimension);
  if (length(given) == 0)
    throw Error("option " + option + ": the direction of an axis must not be zero");
  return unit(given);
}

/// Returns the axes after the turn, by rows, in components along those before it.
Matrix3 turnOf(const FrameSettings& settings, int dimension) {
  Matrix3 turn = mesh::identity3;
  if (settings.turn == 0) return turn;
  if (dimension == 2 && settings.turnAxis != 2)
    throw Error("option " + settings.turnAxisOption + ": in plane problems must be z");
  const std::size_t next = (settings.turnAxis + 1) % 3, last = (settings.turnAxis + 2) % 3;
  const double c = std::cos(settings.turn), s = std::sin(settings.turn);
  turn[next][next] = turn[last][last] = c;
  turn[next][last] = s, turn[last][next] = -s;
  return turn;
}

}  // namespace

Frame::Frame(const FrameSettings& settings, int dimension)
    : name_(settings.name),
      cylindrical_(settings.cylindrical),
      origin_(settings.origin.in(dimension)),
      turn_(turnOf(settings, dimension)) {
  // An axis in the plane has two components, that of a cylindrical frame three.
  const Point first =
      unitOf(settings.first, settings.firstOption, settings.cylindrical ? 3 : dimension);
  if (cylindrical_) {
    if (dimension == 2 && std::abs(first[2]) != 1)
      throw Error("option " + settings.firstOption +
                  ": in plane problems the axis of a cylindrical frame must be along z");
    axes_[2] = first, axes_[0] = mesh::across(first), axes_[1] = cross(first, axes_[0]);
    return;
  }
  const Point second = unitOf(settings.second, settings.secondOption, dimension),
              normal = cross(first, second);
  if (length(normal) < parallel)
    throw Error("option " + settings.secondOption + ": is parallel to " + settings.firstOption +
                "; give another direction in the plane of x and y");
  if (dimension == 2 && (first[2] != 0 || second[2] != 0))
    throw Error("option " + settings.firstOption +
                ": in plane problems the axes have no component z");
  axes_[0] = first, axes_[2] = unit(normal), axes_[1] = cross(axes_[2], first);
  if (dimension == 2 && axes_[2][2] < 0)
    axes_[2] = {0, 0, 1}, axes_[1] = mesh::scaled(axes_[1], -1);
}

Frame::Frame(const FrameSettings& settings, const std::string& option, const mesh::Mesh& mesh)
    : Frame(settings, mesh.dimension) {
  option_ = option, diagonal_ = mesh.diagonal;
}

Matrix3 Frame::axesAt(const Point& x) const {
  if (!cylindrical_) return mesh::product(turn_, axes_);
  const Point r = mesh::minus(x, origin_), radial = mesh::tangential(r, axes_[2]);
  const double rounding =
      std::max(onAxis * diagonal_, positionRounding * std::max(length(x), length(origin_)));
  if (length(radial) <= std::max(parallel * length(r), rounding))
    throw Error((option_.empty() ? "" : "option " + option_ + " " + name_ + ": ") +
                formatted("the point (%g, %g, %g) m lies on the axis of the cylindrical frame "
                          "'%s', where the radial direction is not defined",
                          x[0], x[1], x[2], name_.c_str()));
  const Point e = unit(radial);
  return mesh::product(turn_, {e, cross(axes_[2], e), axes_[2]});
}

Frame named(const std::map<std::string, FrameSettings>& frames, const std::string& name,
            const std::string& option, const mesh::Mesh& mesh) {
  if (name.empty()) return {};
  if (const auto found = frames.find(name); found != frames.end())
    return Frame(found->second, option, mesh);
  std::vector<std::string> names;
  for (const auto& [known, settings] : frames) names.push_back(known);
  throw Error("option " + option + " " + name + ": no frame has this name; " +
              (names.empty() ? "-frame_" + name + "_x or -frame_" + name + "_axis makes one"
                             : "the frames are: " + joined(names)));
}

}  // namespace squeal::frame
