// SPDX-License-Identifier: BSD-2-Clause
#include "steady/condensed/loads.hpp"

namespace squeal::condensed {
namespace {

/// Returns the factors of the three states at a point: loads are p times the pressures and held
/// displacements, v² times the centrifugal forces, and the gaps without load.
std::array<double, 3> factorsAt(const sweep::Parameters& at) {
  return {1, at.pressure, at.speed * at.speed};
}

}  // namespace

Loads::Loads(const steady::Problem& open, const impedance::Impedance& impedance) : open_(open) {
  const std::vector<sweep::Parameters> points{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  std::vector<OwnedVec> residuals;
  std::vector<std::vector<double>> normal;
  std::vector<Vec> wanted, x;
  for (const auto& point : points) {
    states_.push_back({rightVector(open.transformation().trial), {}});
    residuals.push_back(rightVector(open.transformation().trial));
    const OwnedVec forces = open.forces(point, open.displacement(point, states_.back().x));
    check(MatMultTranspose(open.transformation().trial, forces, residuals.back()));
    normal.push_back(open.normalForces(forces));
    wanted.push_back(residuals.back());
    x.push_back(states_.back().x);
  }
  for (std::size_t k = 1; k < points.size(); ++k) {
    check(VecAXPY(residuals[k], -1, residuals[0]));
    for (std::size_t i = 0; i < normal[k].size(); ++i) normal[k][i] -= normal[0][i];
  }
  const auto effects = impedance.relax(wanted, x);
  for (std::size_t k = 0; k < points.size(); ++k) {
    states_[k].given.assign(effects.column(k).begin(), effects.column(k).end());
    for (std::size_t i = 0; i < normal[k].size(); ++i) states_[k].given[i] += normal[k][i];
  }
}

impedance::ContactVector Loads::forces(const sweep::Parameters& at) const {
  const auto factors = factorsAt(at);
  impedance::ContactVector sum(states_.front().given.size(), 0.0);
  for (std::size_t k = 0; k < factors.size(); ++k)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factors[k] * states_[k].given[i];
  return sum;
}

OwnedVec Loads::unknowns(const sweep::Parameters& at) const {
  const auto factors = factorsAt(at);
  OwnedVec x = rightVector(open_.transformation().trial);
  for (std::size_t k = 0; k < factors.size(); ++k) check(VecAXPY(x, factors[k], states_[k].x));
  return x;
}

}  // namespace squeal::condensed
