// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/corrector.hpp"

#include <algorithm>
#include <cmath>

#include "eigen/reduction/responses.hpp"

namespace squeal::reduction {

using subspace::Sketch;

namespace {

/// Fraction of the residuals that the directions may leave unresolved. A round gains about a
/// decade, so smaller components need no solve.
constexpr double resolution = 0.03;

/// Returns for each pair of an undamped problem, [pair], whether it is −s̄ with the conjugate
/// vectors of the preceding pair. The errors of the two are the same.
std::vector<bool> mirrorImages(const std::vector<linalg::DensePair>& pairs, bool damped) {
  std::vector<bool> mirrored(pairs.size(), false);
  for (std::size_t j = 1; j < pairs.size() && !damped; ++j)
    mirrored[j] =
        !mirrored[j - 1] && pairs[j].s.real() != 0 && pairs[j].s == -std::conj(pairs[j - 1].s);
  return mirrored;
}

/// Sketches of residuals, and the factor that scales each column to its weight.
struct ScaledSketches {
  linalg::DenseMatrix sketches;
  std::vector<double> factors;  // [column]
};

ScaledSketches scaledSketches(const ProjectedBasis& basis,
                              const std::vector<CorrectionRequest>& requests) {
  ScaledSketches all;
  for (const auto& request : requests) {
    const auto& pairs = request.pairs.pairs;
    const linalg::DenseMatrix sketch =
        basis.residualSketch(*request.state, request.pairs, pencil::Side::right);
    all.sketches.append(sketch);
    const auto squares = pairs.perPair(subspace::squaredNorms(sketch).euclidean);
    for (std::size_t j = 0; j < squares.size(); ++j)
      all.factors.insert(all.factors.end(), pairs.firstColumn[j + 1] - pairs.firstColumn[j],
                         squares[j] > 0 ? request.weights[j] / std::sqrt(squares[j]) : 0);
  }
  return all;
}

}  // namespace

void Corrector::start(const PointProblem& point, const std::vector<double>& frequencies) {
  basis_.basis().add(
      forcesOnModes(basis_.basis(), point.pencil, point.at, frequencies, resolution));
  estimator_.recordCorrection();
}

CorrectionRequest Corrector::requestOf(const PointState& state) const {
  const auto& band = state.solution.spectrum.band;
  const auto mirrored = mirrorImages(band, state.damped);
  std::vector<const linalg::DensePair*> open;
  std::vector<double> weights;
  for (std::size_t j = 0; j < band.size(); ++j)
    if (const double ratio = estimator_.errorRatio(state.solution, j); ratio > 1 && !mirrored[j]) {
      open.push_back(&band[j]);
      weights.push_back(std::min(1.0, std::sqrt(2) * resolution * ratio));
    }
  return {&state, state.pairs(open, state.damped), weights};
}

PetscInt Corrector::correct(const std::vector<CorrectionRequest>& requests) {
  using enum ProjectedBasis::Residual;
  const PetscInt added = basis_.basis().add(directions(requests, outside));
  return added > 0 ? added : basis_.basis().add(directions(requests, whole));
}

/// Collective. Returns directions that span the residuals of all these pairs, of this kind, except
/// for components of length `resolution`. Each pair is scaled so that its whole residual has the
/// length of its weight.
linalg::Block Corrector::directions(const std::vector<CorrectionRequest>& requests,
                                    ProjectedBasis::Residual kind) const {
  const MPI_Comm comm = basis_.basis().comm();
  const auto [sketches, factors] = scaledSketches(basis_, requests);
  std::vector<ProjectedBasis::PairsOfPoint> points;
  for (const auto& request : requests) points.push_back({request.state, &request.pairs});
  // Fewer columns than residuals: residuals of neighbouring points are similar.
  if (const auto leading = subspace::leadingCombinations(sketches, factors, 0.8 * resolution))
    return linalg::principal(comm, basis_.residuals(points, *leading, kind), resolution);
  // The sketch does not resolve this many: take random combinations until they span the residuals.
  constexpr PetscInt atOnce = 3 * Sketch::size;
  const PetscInt all = factors.size();
  linalg::Block columns(basis_.basis().localRows());
  for (PetscInt count = 0;;) {
    const PetscInt more = all - count <= atOnce + atOnce / 2 ? all - count : atOnce;
    columns.append(
        basis_.residuals(points, subspace::randomCombinations(factors, count, count + more), kind));
    count += more;
    // A sum of `all` columns with random signs, divided by √count: lengths are preserved.
    linalg::Block leading = linalg::principal(comm, columns, resolution * std::sqrt(count));
    if (count == all || 5 * leading.columns() < 4 * count) return leading;
  }
}

}  // namespace squeal::reduction
