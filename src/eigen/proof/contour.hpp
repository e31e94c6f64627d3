// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The region of a count, and the upper half of its boundary. The lower half is its mirror image,
/// on which a real problem has the same bounds.
#include <limits>
#include <span>
#include <vector>

#include "algebra/linalg/complex.hpp"

namespace squeal::proof {

/// The region |s| < top and Re s > −left.
struct Region {
  double top = 0;  ///< rad/s
  /// 1/s; from `top` on, the region is the whole disc.
  double left = std::numeric_limits<double>::infinity();
};

/// A part of the boundary: an arc about 0, or a line parallel to the imaginary axis.
class Piece {
 public:
  /// An arc that begins at start and turns by `angle`, positive counter-clockwise.
  static Piece arc(Complex start, double angle);
  /// The line from start to the real axis.
  static Piece line(Complex start);
  double length() const { return length_; }  ///< angle or length
  Complex at(double t) const;                ///< 0 ≤ t ≤ length()
  /// Returns the difference in t of two points at this distance from each other.
  double parameter(double distance) const;
  double distance(Complex from) const;

 private:
  Complex start_;
  double direction_ = 0;  // of an arc, ±1; 0 for a line
  double length_ = 0;
};

/// The upper half of the boundary, from the imaginary axis in both directions: eigenvalues are most
/// likely near the axis, and a proof that fails does so soon. In the plane of s² the disc begins at
/// the negative real axis.
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

/// Returns the middle of the widest gap of |s| between (1 − within) and (1 + within) times the
/// wanted top, for eigenvalues s in any order. The ends of this range bound gaps too. Of equal gaps
/// it takes the lowest.
double placedTop(std::span<const Complex> eigenvalues, double wanted, double within = 0.08);

/// Returns the middle of the widest gap of −Re s around the wanted left edge, in the same way,
/// for the eigenvalues with |s| up to 10 % above the top.
double placedLeft(std::span<const Complex> eigenvalues, double top, double wanted,
                  double within = 0.5);

}  // namespace squeal::proof
