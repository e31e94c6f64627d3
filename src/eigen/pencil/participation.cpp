// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/participation.hpp"

#include <algorithm>

namespace squeal::pencil {

std::vector<Participation> participations(const modes::Modes& modes,
                                          const factor::AssociatedSystem& system, Complex s,
                                          const linalg::ComplexVector& x) {
  const std::size_t count = modes.angularFrequency.size();
  const linalg::ComplexVector inertia = product(system.m0(), x);
  const double mass = dot(x, inertia).real(), stiffness = dot(x, product(system.k0(), x)).real();
  std::vector<double> real(count), imaginary(count);
  if (count > 0) {
    check(BVDotVec(modes.vectors, inertia.real, real.data()));
    check(BVDotVec(modes.vectors, inertia.imaginary, imaginary.data()));
  }
  std::vector<Participation> found;
  Complex largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Complex q{real[i], imaginary[i]};
    if (std::abs(q) > std::abs(largest)) largest = q;
    found.push_back({.mode = i,
                     .amplitude = q,
                     .energy = (std::norm(s) + modes.lambda[i]) * std::norm(q) /
                               (std::norm(s) * mass + stiffness),
                     .mac = std::norm(q) / mass});
  }
  const double size = std::abs(largest);
  if (size > 0)
    for (auto& one : found) one.amplitude *= std::conj(largest) / size / std::sqrt(mass);
  return found;
}

}  // namespace squeal::pencil
