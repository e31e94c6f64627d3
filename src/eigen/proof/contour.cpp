// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/contour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace squeal::proof {

using std::numbers::pi;

Piece Piece::arc(Complex start, double angle) {
  Piece piece;
  piece.start_ = start;
  piece.direction_ = angle < 0 ? -1 : 1;
  piece.length_ = std::abs(angle);
  return piece;
}

Piece Piece::line(Complex start) {
  Piece piece;
  piece.start_ = start;
  piece.length_ = start.imag();
  return piece;
}

Complex Piece::at(double t) const {
  return direction_ == 0 ? start_ - Complex(0, t) : start_ * std::polar(1.0, direction_ * t);
}

double Piece::parameter(double distance) const {
  if (direction_ == 0) return distance;
  return 2 * std::asin(std::min(1.0, distance / (2 * std::abs(start_))));
}

double Piece::distance(Complex from) const {
  double t = start_.imag() - from.imag();  // of the nearest point
  if (direction_ != 0) {
    t = direction_ * std::arg(from / start_);
    // A point outside the angles of the arc is nearest to the closer one of its ends.
    if (t < 0 && t + 2 * pi - length_ < -t) t += 2 * pi;
  }
  return std::abs(from - at(std::clamp(t, 0.0, length_)));
}

Contour::Contour(double radius, double left, bool squared)
    : radius_(radius), left_(squared ? std::numeric_limits<double>::infinity() : left) {
  if (squared) {
    pieces_.push_back(Piece::arc(-radius, -pi));
    return;
  }
  const Complex top(0, radius);
  pieces_.push_back(Piece::arc(top, -pi / 2));
  if (left >= radius) {
    pieces_.push_back(Piece::arc(top, pi / 2));
    return;
  }
  ensure(left > 0, "the left edge of a region is left of the imaginary axis");
  const double angle = std::asin(left / radius);
  pieces_.push_back(Piece::arc(top, angle));
  pieces_.push_back(Piece::line(top * std::polar(1.0, angle)));
}

double Contour::distance(Complex from) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& piece : pieces_) nearest = std::min(nearest, piece.distance(from));
  return nearest;
}

bool Contour::encloses(Complex point) const {
  return std::abs(point) < radius_ && point.real() > -left_;
}

namespace {

/// Returns the middle of the widest gap of the values between low and high.
double widestGap(double low, double high, std::vector<double> values) {
  std::erase_if(values, [=](double value) { return !(value > low && value < high); });
  values.insert(values.end(), {low, high});
  std::ranges::sort(values);
  std::size_t widest = 1;
  for (std::size_t i = 2; i < values.size(); ++i)
    if (values[i] - values[i - 1] > values[widest] - values[widest - 1]) widest = i;
  return (values[widest - 1] + values[widest]) / 2;
}

}  // namespace

double placedTop(std::span<const Complex> eigenvalues, double wanted, double within) {
  std::vector<double> sizes;
  for (const auto s : eigenvalues) sizes.push_back(std::abs(s));
  return widestGap((1 - within) * wanted, (1 + within) * wanted, std::move(sizes));
}

double placedLeft(std::span<const Complex> eigenvalues, double top, double wanted, double within) {
  std::vector<double> decays;
  for (const auto s : eigenvalues)
    if (std::abs(s) < 1.1 * top) decays.push_back(-s.real());
  return widestGap((1 - within) * wanted, (1 + within) * wanted, std::move(decays));
}

}  // namespace squeal::proof
