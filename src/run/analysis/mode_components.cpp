// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/mode_components.hpp"

#include <algorithm>

#include "eigen/pencil/participation.hpp"
#include "problem/energies/shares.hpp"

namespace squeal::analysis {

void addParticipations(const factor::AssociatedSystem& system,
                       sweep_solver::ModalSegment& segment) {
  if (segment.modes.angularFrequency.empty()) return;
  for (auto& point : segment.points)
    for (auto& shape : point.shapes)
      shape.participations = pencil::participations(
          segment.modes, system, point.eigenvalues[shape.index].s, shape.unknowns);
}

void addComponents(const energies::Components& components, Mat trial, Mat prestress,
                   sweep_solver::ModalSegment& segment) {
  const auto& frequencies = segment.modes.angularFrequency;
  double top = 0;
  for (const auto& point : segment.points) top = std::max(top, point.bandTop);
  OwnedVec u;
  check(MatCreateVecs(trial, nullptr, u.out()));
  for (std::size_t i = 0; i < frequencies.size() && (top == 0 || frequencies[i] <= top); ++i) {
    Vec d = nullptr;
    check(BVGetColumn(segment.modes.vectors, i, &d));
    check(MatMult(trial, d, u));
    check(BVRestoreColumn(segment.modes.vectors, i, &d));
    segment.components.push_back(energies::sharesOfFreeMode(components, u, prestress));
  }
}

}  // namespace squeal::analysis
