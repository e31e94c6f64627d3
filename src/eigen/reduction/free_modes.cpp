// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/free_modes.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/columns.hpp"

namespace squeal::reduction {
namespace {

/// Returns the vectors of the band, which are real, as columns of all unknowns, by this rank's
/// rows.
linalg::Block shapesOf(const Basis& basis, const PointState& state) {
  const auto& band = state.solution.spectrum.band;
  linalg::DenseMatrix coordinates(basis.size(), std::ssize(band));
  for (PetscInt j = 0; j < coordinates.columns(); ++j) {
    const auto lifted = state.set->space.lifted(band[j].q);
    for (std::size_t i = 0; i < lifted.size(); ++i) coordinates(i, j) = lifted[i].real();
  }
  return linalg::product(basis.columns(), coordinates);
}

}  // namespace

modes::Modes freeModes(const Basis& basis, const PointState& state,
                       const pencil::Pencil& associated) {
  linalg::Block shapes = shapesOf(basis, state);
  linalg::Block stiffness(shapes.rows()), inertia(shapes.rows());
  for (const auto& term : associated.terms())
    linalg::appendProduct(term.matrix, shapes, term.power == 0 ? stiffness : inertia);
  const linalg::DenseMatrix masses = linalg::transposedProduct(basis.comm(), shapes, inertia);
  for (PetscInt j = 0; j < shapes.columns(); ++j)
    for (auto* columns : {&shapes, &stiffness, &inertia})
      for (double& entry : columns->column(j)) entry /= std::sqrt(masses(j, j));
  for (auto* columns : {&stiffness, &inertia}) basis.clearBoundary(*columns);
  modes::Modes modes;
  for (PetscInt j = 0; j < shapes.columns(); ++j) {
    const double omega = state.solution.spectrum.band[j].s.imag(), lambda = omega * omega;
    modes.angularFrequency.push_back(omega);
    modes.lambda.push_back(lambda);
    const double size = linalg::length(basis.comm(), inertia.column(j));
    auto rest = stiffness.column(j);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= lambda * inertia(i, j);
    modes.relativeResidual.push_back(linalg::length(basis.comm(), rest) / (lambda * size));
  }
  modes.vectors = linalg::copiedColumns(basis.stiffness(), shapes);
  return modes;
}

void confirmCount(MPI_Comm comm, const subspace::ModeCount& count, const CountRange& range,
                  modes::Modes& modes) {
  constexpr PetscInt mostGaps = 10;
  const auto& [top, values, boundary] = range;
  const PetscInt inBand = std::ssize(modes.lambda);
  for (PetscInt i = inBand; i < std::min<PetscInt>(inBand + mostGaps, std::ssize(values)); ++i) {
    const double low = i == inBand ? top * top : values[i - 1];
    modes.inertiaShift = 0.5 * (low + values[i]);
    const auto below = count.below(modes.inertiaShift, boundary);
    modes.countConfirmed = below && *below == i;
    modes.inertiaCount = i;
    if (modes.countConfirmed) break;
  }
  mpi::broadcast(comm, modes.countConfirmed);
  mpi::broadcast(comm, modes.inertiaCount);
  mpi::broadcast(comm, modes.inertiaShift);
}

}  // namespace squeal::reduction
