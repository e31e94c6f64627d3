// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/error_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "eigen/reduction/condition.hpp"

namespace squeal::reduction {

using subspace::Sketch;
using subspace::SquaredNorms;

namespace {

/// Errors of an eigenvalue smaller than this fraction of the lowest free mode are relative to that
/// fraction: round-off moves a double zero by about as much.
constexpr double leastSize = 1e-8;
/// A residual is round-off below this multiple of ε √(xᵀ diag(K0) x), in the norm of diag(K0)⁻¹.
/// The backward error does not tell: its scale is the norm of K, which a stiff joint may determine.
/// Residuals that are corrected to the end remain between 6 and 20 times ε √(xᵀ diag(K0) x).
constexpr double leastResidual = 100 * PETSC_MACHINE_EPSILON;

std::vector<const linalg::DensePair*> pointers(const std::vector<linalg::DensePair>& pairs) {
  std::vector<const linalg::DensePair*> list;
  for (const auto& pair : pairs) list.push_back(&pair);
  return list;
}

pencil::Symmetry symmetryOf(const linalg::DenseProblem& problem) {
  // The factors of all damping terms may be zero.
  return linalg::conservative(problem)     ? pencil::Symmetry::conservative
         : linalg::isZero(problem.damping) ? pencil::Symmetry::even
                                           : pencil::Symmetry::none;
}

double sum(const std::vector<double>& squares) {
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

}  // namespace

ErrorEstimator::ErrorEstimator(ProjectedBasis& basis, const std::vector<double>& frequencies,
                               const Settings& settings)
    : basis_(basis),
      settings_(settings),
      lowestMode_(frequencies.front()),
      highestMode_(frequencies.back()) {}

void ErrorEstimator::recordCorrection() {
  rightRatio_ = std::max(measuredRatio_, basis_.basis().lastEnergyRatio());
}

/// In a problem in s², an error δ of s² moves s by |δ|/(2 |s|), but at most by √|δ|.
double ErrorEstimator::absoluteError(const PointSolution& solution, std::size_t pair) const {
  const Complex s = solution.spectrum.band[pair].s;
  const double unit = std::max(std::abs(s), leastSize * lowestMode_),
               relative = basisError(solution, pair) + solution.errors[pair].dense;
  if (solution.symmetry == pencil::Symmetry::none) return unit * relative;
  const double ofRoot = unit * std::sqrt(2 * relative);
  return std::abs(s) < unit ? ofRoot : std::min(unit * relative, ofRoot);
}

bool ErrorEstimator::isExactEnough(const PointSolution& solution,
                                   const pencil::Eigenvalue& e) const {
  if (!e.mayBeZero()) return e.errorEstimate() <= settings_.tolerance;
  const double ratio = e.error / lowestMode_;
  return (solution.symmetry == pencil::Symmetry::none ? ratio : ratio * ratio) <=
         settings_.tolerance;
}

/// Returns the contribution of the basis to the estimate of |δs|/|s|.
double ErrorEstimator::basisError(const PointSolution& solution, std::size_t pair) const {
  const PairErrors& errors = solution.errors[pair];
  return rightRatio_ * errors.right * std::min(1.0, leftRatio_ * errors.left);
}

double ErrorEstimator::errorRatio(const PointSolution& solution, std::size_t pair) const {
  const PairErrors& errors = solution.errors[pair];
  if (acceptsAll_ || errors.isRoundOff) return 0;
  // The basis may take what the dense solve leaves of the tolerance, if it leaves some.
  const double tolerance = settings_.tolerance, rest = tolerance - errors.dense;
  const double allowed = rest > 0 ? std::max(rest, 0.1 * tolerance) : tolerance;
  return std::max(errors.backward / settings_.criteria.accuracy,
                  basisError(solution, pair) / allowed);
}

bool ErrorEstimator::isAccurate(const PointSolution& solution) const {
  for (std::size_t j = 0; j < solution.spectrum.band.size(); ++j)
    if (errorRatio(solution, j) > 1) return false;
  return true;
}

void ErrorEstimator::estimate(PointState& state, const linalg::DenseProblem& problem) const {
  PointSolution& solution = state.solution;
  const auto& pairs = solution.spectrum.band;
  const PointPairs all = state.pairs(pointers(pairs), state.damped);
  const auto& coordinates = all.pairs;
  const auto norms = [&](pencil::Side side) {  // raised by the error of a sketch
    SquaredNorms squares = subspace::squaredNorms(basis_.residualSketch(state, all, side));
    for (auto* list : {&squares.euclidean, &squares.weighted}) {
      *list = coordinates.perPair(*list);
      for (auto& square : *list) square *= Sketch::safety * Sketch::safety;
    }
    return squares;
  };
  const auto right = norms(pencil::Side::right), left = norms(pencil::Side::left);
  const auto lengthsBy = [&](const linalg::DenseMatrix& sketch, const linalg::DenseMatrix& q) {
    return coordinates.perPair(subspace::squaredLengths(linalg::product(sketch, q)));
  };
  const Basis& basis = basis_.basis();
  const auto x = coordinates.times(pencil::Side::right, 0, 1),
             y = coordinates.times(pencil::Side::left, 0, 1);
  const auto lengths = lengthsBy(basis.sketched(), x),
             rightRigidity = lengthsBy(basis.sketchedRigidity(), x),
             leftRigidity = lengthsBy(basis.sketchedRigidity(), y);
  const auto conditions = conditionNumbers(problem, pairs, leastSize * lowestMode_);
  solution.symmetry = symmetryOf(problem);
  solution.errors.clear();
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto& [k, z, m] = solution.norms;
    const double size = std::abs(pairs[j].s), scale = k + size * z + size * size * m;
    PairErrors& errors = solution.errors.emplace_back();
    // If s and K̄ are zero, P(s) is zero and has no residual.
    errors.backward = scale > 0 ? std::sqrt(right.euclidean[j] / lengths[j]) / scale : 0;
    // Backward errors ε of the dense matrices, in norm: VᵀK̄V is of the order of 1, VᵀM̄V of the
    // lowest 1/ω²; and round-off of the entries of K, which cancel if a stiff body moves nearly
    // rigidly.
    errors.roundOff = PETSC_MACHINE_EPSILON * (1 + std::pow(size / lowestMode_, 2) +
                                               std::sqrt(rightRigidity[j] * leftRigidity[j]));
    // LAPACK's backward errors grow with the order, for most matrices as its root (Higham, Accuracy
    // and Stability of Numerical Algorithms, SIAM 2002, section 2.8).
    errors.dense = conditions[j] * std::sqrt(1.0 * problem.order()) * errors.roundOff;
    errors.right = conditions[j] * std::sqrt(right.weighted[j]);
    errors.isRoundOff = right.weighted[j] <= leastResidual * leastResidual * rightRigidity[j];
    errors.left = size < highestMode_
                      ? std::sqrt(left.weighted[j]) / (1 - std::pow(size / highestMode_, 2))
                      : INFINITY;
  }
}

/// Collective. Returns the ratio of a residual computed from the matrices, `columns`, to the one
/// from the products of the basis, in the norm of diag(K0)⁻¹, and at least 1.
double ErrorEstimator::residualRatio(const PointState& state, const linalg::DensePair& pair,
                                     const linalg::Block& columns, pencil::Side side) const {
  const PointPairs single = state.pairs({&pair}, state.damped);
  const auto sketch = basis_.residualSketch(state, single, side);
  const double known = sum(subspace::squaredNorms(sketch).weighted),
               exact = sum(subspace::squaredNorms(basis_.basis().sketch().of(columns)).weighted);
  return known > 0 ? std::max(1.0, std::sqrt(exact / known)) : 1.0;
}

/// Collective. Computes the ratios of norms for the residuals of a pair.
void ErrorEstimator::measureRatios(PointState& state, std::size_t pair) {
  Basis& basis = basis_.basis();
  state.ownTerms.extend();  // the basis may have grown since
  linalg::DensePair& known = state.solution.spectrum.band[pair];
  const PointSpace& space = state.set->space;
  for (auto* vector : {&known.q, &known.left}) vector->resize(space.size(basis.size()));
  const auto vectors = basis.expand({space.lifted(known.q), space.lifted(known.left)});
  const linalg::Block right = basis_.residualColumns(state, known, vectors[0], pencil::Side::right),
                      left = basis_.residualColumns(state, known, vectors[1], pencil::Side::left);
  const auto ratios = basis.energyRatios({right, left});
  measuredRatio_ =
      std::max(measuredRatio_, ratios[0] * residualRatio(state, known, right, pencil::Side::right));
  rightRatio_ = std::max(rightRatio_, measuredRatio_);
  leftRatio_ =
      std::max(leftRatio_, ratios[1] * residualRatio(state, known, left, pencil::Side::left));
}

std::vector<PointState*> ErrorEstimator::unconfirmed(std::vector<PointState>& states) {
  std::vector<PointState*> open;
  PointState* worst = nullptr;
  std::size_t worstPair = 0;
  double largest = std::max(
      confirmed_, 1e-3 * settings_.tolerance);  // smaller estimates are negligible or round-off
  for (auto& state : states)
    for (std::size_t j = 0; j < state.solution.spectrum.band.size(); ++j) {
      const double error = basisError(state.solution, j);
      if (!std::isfinite(error) || !(error > largest)) continue;
      worst = &state;
      worstPair = j;
      largest = error;
    }
  if (!worst) return open;
  confirmed_ = largest;
  measureRatios(*worst, worstPair);
  for (auto& state : states)
    if (!isAccurate(state.solution)) open.push_back(&state);
  return open;
}

void ErrorEstimator::serialise(checkpoint::Archive& archive) {
  archive.common(lowestMode_, highestMode_, rightRatio_, leftRatio_, measuredRatio_, confirmed_);
}

}  // namespace squeal::reduction
