// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/mode_components.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"
#include "problem/energies/shares.hpp"

namespace squeal::analysis {
namespace {

constexpr PetscInt together = 16;  // modes

/// Returns the free modes with the most energy in a mode, which make it up.
std::vector<std::size_t> principalModes(std::vector<pencil::Participation> parts) {
  constexpr std::size_t most = 3;
  constexpr double least = 0.05;
  std::ranges::stable_sort(parts, std::greater{}, &pencil::Participation::energy);
  std::vector<std::size_t> found;
  for (const auto& part : parts)
    if (part.energy >= least && found.size() < most) found.push_back(part.mode);
  return found;
}

}  // namespace

void addParticipations(const factor::AssociatedSystem& system,
                       sweep_solver::ModalSegment& segment) {
  if (segment.modes.angularFrequency.empty()) return;
  std::vector<pencil::ComplexMotion> motions;
  std::vector<pencil::Shape*> shapes;
  for (auto& point : segment.points)
    for (auto& shape : point.shapes) {
      motions.push_back({point.eigenvalues[shape.index].s, &shape.unknowns});
      shapes.push_back(&shape);
    }
  auto found = pencil::participations(segment.modes, system, motions);
  for (std::size_t i = 0; i < shapes.size(); ++i) shapes[i]->participations = std::move(found[i]);
}

void addCorrelations(const energies::BodyMac& mac, Mat trial, sweep_solver::ModalSegment& segment) {
  std::map<std::size_t, PetscInt> columns;  // free mode -> column of the nodal values
  for (auto& point : segment.points)
    for (auto& shape : point.shapes)
      for (const std::size_t mode : principalModes(shape.participations)) {
        columns.emplace(mode, 0);
        shape.correlations.push_back({mode, {}});
      }
  if (columns.empty()) return;
  PetscInt rows = 0, nodalRows = 0;
  check(MatGetLocalSize(trial, &nodalRows, &rows));
  linalg::Block unknowns(rows), nodal(nodalRows);
  const linalg::ReadColumns vectors(segment.modes.vectors);
  for (auto& [mode, column] : columns) {
    column = unknowns.columns();
    unknowns.append(vectors.view().column(mode));
  }
  linalg::appendProduct(trial, unknowns, nodal);
  for (auto& point : segment.points)
    for (auto& shape : point.shapes) {
      std::vector<std::span<const double>> motions;
      for (const auto& one : shape.correlations)
        motions.push_back(nodal.column(columns.at(one.mode)));
      const ReadArray real(shape.real), imaginary(shape.imaginary);
      auto macs = mac.of({real.data(), imaginary.data()}, motions);
      for (std::size_t i = 0; i < macs.size(); ++i) shape.correlations[i].mac = std::move(macs[i]);
    }
}

std::vector<pencil::CriticalMode> describe(const factor::AssociatedSystem& system,
                                           const std::vector<pencil::ComplexMotion>& motions,
                                           const modes::Modes& modes) {
  std::vector<pencil::CriticalMode> found;
  for (auto& parts : pencil::participations(modes, system, motions))
    found.emplace_back().participations = std::move(parts);
  return found;
}

void addComponents(const energies::Components& components, const elasticity::Bodies& bodies,
                   Mat trial, Mat prestress, sweep_solver::ModalSegment& segment) {
  const auto& frequencies = segment.modes.angularFrequency;
  double top = 0;
  for (const auto& point : segment.points) top = std::max(top, point.bandTop);
  const PetscInt count = top == 0
                             ? frequencies.size()
                             : std::ranges::upper_bound(frequencies, top) - frequencies.begin();
  if (count == 0) return;
  PetscInt rows = 0;
  check(MatGetLocalSize(trial, &rows, nullptr));
  const linalg::ReadColumns vectors(segment.modes.vectors);
  const auto all = vectors.view();
  // Products with several columns read a matrix only once.
  for (PetscInt first = 0; first < count; first += together) {
    const PetscInt size = std::min(together, count - first);
    linalg::Block u(rows), elastic(rows), inertia(rows), stressed(rows);
    linalg::appendProduct(trial, all.columnRange(first, first + size), u);
    linalg::appendProduct(bodies.stiffness, u, elastic);
    linalg::appendProduct(bodies.mass, u, inertia);
    if (prestress) linalg::appendProduct(prestress, u, stressed);
    for (PetscInt i = 0; i < size; ++i) {
      std::optional<double> stress;
      if (prestress) {
        const auto x = u.column(i), y = stressed.column(i);
        stress = mpi::sum(commOf(trial), std::inner_product(x.begin(), x.end(), y.begin(), 0.0));
      }
      segment.components.push_back(energies::sharesOfFreeMode(
          components, {u.column(i), inertia.column(i), elastic.column(i)}, stress));
    }
  }
}

}  // namespace squeal::analysis
