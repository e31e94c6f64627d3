// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/mode_components.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"
#include "problem/energies/shares.hpp"

namespace squeal::analysis {
namespace {

constexpr PetscInt together = 16;  // modes

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
