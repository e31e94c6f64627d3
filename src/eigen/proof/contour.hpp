// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The region in which eigenvalues are counted, and the upper half of its boundary. The lower half
/// is its mirror image, on which a real problem has the same bounds.
#include <limits>
#include <span>
#include <vector>

#include "algebra/linalg/complex.hpp"

namespace squeal::proof {

/// The region |s| < top and Re s > −left.
struct Region {
  double top = 0;  ///< rad/s
  /// 1/s; if it is at least `top`, the region is the whole disc.
  double left = std::numeric_limits<double>::infinity();
};

/// A part of the boundary: an arc about 0, or a line parallel to the imaginary axis.
class Piece {
 public:
  /// Returns an arc that begins at `start` and turns by `angle`, positive counter-clockwise.
  static Piece arc(Complex start, double angle);
  /// Returns the line from `start` to the real axis.
  static Piece line(Complex start);
  double length() const { return length_; }  ///< angle of an arc, or length of a line
  Complex at(double t) const;                ///< 0 ≤ t ≤ length()
  /// Returns the difference in t between two points of the piece at this distance from each other.
  double parameter(double distance) const;
  double distance(Complex from) const;

 private:
  Complex start_;
  double direction_ = 0;  // of an arc, ±1; 0 for a line
  double length_ = 0;
};

/// The upper half of the boundary. Its pieces begin at the imaginary axis and run in both
/// directions: eigenvalues are most likely near this axis, so a proof that fails does so early. In
/// the plane of s² the arc begins at the negative real axis.
class Contour {
 public:
  Contour(double radius, double left, bool squared);
  std::span<const Piece> pieces() const { return pieces_; }
  double distance(Complex from) const;
  bool encloses(Complex point) const;
  double reach() const { return radius_; }  ///< largest distance from 0

 private:
  double radius_, left_;
  std::vector<Piece> pieces_;
};

/// Returns the middle of the widest gap between the |s| of the eigenvalues in the range from
/// (1 − within) to (1 + within) times the wanted top. The eigenvalues may be in any order. The ends
/// of the range also bound gaps. Of equally wide gaps, the lowest is taken.
double placedTop(std::span<const Complex> eigenvalues, double wanted, double within = 0.08);

/// Does the same as placedTop() for the values −Re s and the wanted left edge. Considers only
/// eigenvalues with |s| up to 10 % above the top.
double placedLeft(std::span<const Complex> eigenvalues, double top, double wanted,
                  double within = 0.5);

}  // namespace squeal::proof
