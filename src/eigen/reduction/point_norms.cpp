// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/point_norms.hpp"

#include <cmath>

namespace squeal::reduction {

const Norms& PointNorms::compute(const PointProblem& point) {
  const auto& [at, pencil, set] = point;
  known_.emplace_back(at, Norms{pencil.norm(0, at), pencil.norm(1, at), pencil.norm(2, at)});
  return known_.back().second;
}

const Norms& PointNorms::nearby(const PointProblem& point) {
  const std::pair<sweep::Parameters, Norms>* nearest = nullptr;
  const auto distance = [&](const auto* other) {
    return std::abs(other->first.friction - point.at.friction);
  };
  for (const auto& known : known_) {
    sweep::Parameters at = known.first;
    at.friction = point.at.friction;
    if (at == point.at && (!nearest || distance(&known) < distance(nearest))) nearest = &known;
  }
  return nearest ? nearest->second : compute(point);
}

}  // namespace squeal::reduction
