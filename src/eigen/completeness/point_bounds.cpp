// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/point_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "eigen/proof/norm_bound.hpp"

namespace squeal::completeness {
namespace {

using linalg::DenseMatrix;

constexpr double roundOff = 1e-15;      // of the entries of products of matrices, relative
constexpr double contradiction = 1e-6;  // relative; a matrix of squares violates it by no round-off

/// A factor Γ^½ of Γ ≥ A, with orthogonal columns by ascending length.
struct Root {
  DenseMatrix factor;
  double raise;  ///< Γ = A + raise within the eigenvalues of A that are not negative
};

/// Returns the root for a symmetric A that is positive semi-definite within round-off: its
/// eigenvalues are raised by twice the most negative one. Throws Error with this message if A is
/// indefinite.
Root rootOf(DenseMatrix a, const char* indefinite, double size) {
  const auto values = linalg::symmetricEigen(a);
  if (values.front() < -contradiction * size) throw Error(indefinite);
  const double raise = 2 * std::max(-values.front(), 0.0) + roundOff * size;
  for (PetscInt k = 0; k < a.columns(); ++k)
    for (double& entry : a.column(k)) entry *= std::sqrt(std::max(values[k], 0.0) + raise);
  return {std::move(a), raise};
}

/// Returns the largest length of the columns.
double longest(const DenseMatrix& a) {
  double squares = 0;
  for (PetscInt k = 0; k < a.columns(); ++k)
    squares = std::max(squares, linalg::squaredLength(a.column(k)));
  return std::sqrt(squares);
}

/// Returns A Aᵀ.
DenseMatrix timesTransposed(const DenseMatrix& a) {
  return linalg::product(a, linalg::transposed(a));
}

/// Returns a bound of ‖S x‖ for x in the space that V leaves out, with energy 1, from S on V and
/// S K0⁻¹ Sᵀ.
double slipLeft(const DenseMatrix& rows, PetscInt boundary, const DenseMatrix& flexibility) {
  double trace = 0;
  for (PetscInt i = 0; i < flexibility.rows(); ++i) trace += flexibility(i, i);
  const auto values = linalg::symmetricEigenvalues(leftOf(flexibility, rows, boundary));
  return std::sqrt(std::max(values.empty() ? 0 : values.back(), 0.0) + roundOff * trace);
}

/// Returns M_CV for V W, which is zero for the modes. The directions within round-off become the
/// remainder.
proof::Coupling massCoupling(const SetBounds& set, const DenseMatrix& w, const DenseMatrix& mass) {
  const PetscInt boundary = set.modes.first, end = boundary + set.modes.count, size = w.columns();
  proof::Coupling coupling;
  coupling.error[2] = set.modes.error;
  std::vector<PetscInt> others;
  for (PetscInt i = 0; i < size; ++i)
    if (i < boundary || i >= end) others.push_back(i);
  if (others.empty()) return coupling;
  DenseMatrix columns(w.rows());
  for (const PetscInt i : others) columns.append(w.column(i));
  const auto left =
      leftOf(linalg::congruent(set.massProduct, columns), linalg::rowsOf(others, mass), boundary);
  const auto [root, raise] =
      rootOf(left, "the free modes are not complete below the frequency of their count",
             set.massOnC * set.massOnC);
  const double small = 4 * raise;
  PetscInt first = 0;
  while (first < root.columns() && linalg::squaredLength(root.column(first)) <= small) ++first;
  if (first > 0) coupling.error[2] += std::sqrt(small);
  auto& rows = coupling.coefficients[2] = DenseMatrix(root.columns() - first, size);
  for (PetscInt k = first; k < root.columns(); ++k)
    for (PetscInt i = 0; i < root.rows(); ++i) rows(k - first, others[i]) = root(i, k);
  return coupling;
}

/// Returns the rows of all matrices, one below the other.
DenseMatrix stacked(const std::vector<DenseMatrix>& matrices) {
  DenseMatrix columns;
  for (const auto& matrix : matrices) columns.append(linalg::transposed(matrix));
  return linalg::transposed(columns);
}

}  // namespace

SetBounds setBounds(const SetMatrices& set, double reach) {
  SetBounds bounds{.modes = set.modes,
                   .span = KeptSpan(set.modes, set.energy, stacked(set.slip)),
                   .reach = reach,
                   .massOnC = 1 / set.modes.theta + set.modes.error,
                   .mass = {},
                   .massProduct = {},
                   .slip = {},
                   .slipOnC = {},
                   .forces = {},
                   .normal = 0,
                   .inertia = 0,
                   .normalOnC = 0,
                   .inertiaOnC = 0};
  const DenseMatrix& turn = bounds.span.turn();
  bounds.mass = linalg::congruent(set.mass, turn);
  bounds.massProduct = linalg::congruent(set.massProduct, turn);
  // Responses that are orthogonal to the modes, where M0 ≤ μ: M0 K0⁻¹ M0 ≤ μ M0 + ε², as the modes
  // are coupled to them by at most ε.
  for (PetscInt j = set.solved; j < turn.columns(); ++j) {
    for (PetscInt i = set.solved; i < turn.columns(); ++i)
      bounds.massProduct(i, j) = bounds.massOnC * bounds.mass(i, j);
    bounds.massProduct(j, j) += set.modes.error * set.modes.error;
  }
  if (set.normal.empty()) return bounds;
  for (std::size_t a = 0; a < set.slip.size(); ++a) {
    bounds.slip.push_back(linalg::product(set.slip[a], turn));
    bounds.slipOnC.push_back(bounds.span.forcesLeft() +
                             slipLeft(bounds.slip[a], set.modes.first, set.slipFlexibility[a]));
  }
  const DenseMatrix w = linalg::product(turn, bounds.span.vectors());
  const auto factor = [&](const DenseMatrix& rows, const DenseMatrix& flexibility, double kept) {
    return rootOf(leftOf(flexibility, linalg::product(rows, w), set.modes.first),
                  "the normal forces contradict their responses", kept * kept)
        .factor;
  };
  bounds.normal = proof::quickBound(linalg::DenseView(linalg::product(set.normal, turn)));
  bounds.inertia = proof::quickBound(linalg::DenseView(linalg::product(set.inertia, turn)));
  DenseMatrix stiff = factor(set.normal, set.normalFlexibility, bounds.normal),
              heavy = factor(set.inertia, set.inertiaFlexibility, bounds.inertia);
  bounds.normalOnC = longest(stiff);
  bounds.inertiaOnC = longest(heavy);
  // For |s| ≤ reach and all t > 0,
  //   (A + s² B)(A + s² B)ᴴ ≤ (1 + t) A Aᵀ + (1 + 1/t) reach⁴ B Bᵀ
  // A or B may be zero: under a soft layer, inertia causes no normal forces.
  const double square = reach * reach, a = bounds.normalOnC, b = square * bounds.inertiaOnC,
               t = b > 0 ? std::clamp(b / a, 1e-12, 1e12) : 1e-12;
  for (double& entry : stiff.entries()) entry *= std::sqrt(1 + t);
  for (double& entry : heavy.entries()) entry *= std::sqrt(1 + 1 / t) * square;
  bounds.forces = timesTransposed(stiff);
  linalg::addScaled(bounds.forces, 1, timesTransposed(heavy));
  bounds.forces =
      rootOf(std::move(bounds.forces), "a sum of squares is negative", (a + b) * (a + b)).factor;
  return bounds;
}

PointBounds pointBounds(const SetBounds& set, const PointMatrices& point, const DenseMatrix& w) {
  PointBounds result;
  auto& [kept, leftOut] = result;
  const DenseMatrix ofV = linalg::product(set.span.turn(), w);
  kept.matrices = {linalg::congruent(point.problem.stiffness, ofV), DenseMatrix(),
                   linalg::congruent(point.problem.mass, ofV)};
  kept.toLeftOut = {massCoupling(set, w, linalg::congruent(set.mass, w))};
  kept.fromLeftOut = {proof::transposed(kept.toLeftOut.front())};
  kept.reach = set.reach;
  leftOut.mass = set.massOnC;
  DenseMatrix slip;  // S V W
  double slipOnC = 0;
  for (std::size_t a = 0; a < set.slip.size(); ++a) {
    const double factor = point.slipFactors[a];
    linalg::addScaled(slip, factor, linalg::product(set.slip[a], w));
    slipOnC += std::abs(factor) * set.slipOnC[a];
  }
  if (slip.empty() || linalg::isZero(slip)) return result;
  // The friction in P_VC is (S V)ᵀ (N_0C + s² N_2C).
  kept.fromLeftOut.emplace_back().coefficients[0] = linalg::transposedProduct(slip, set.forces);
  //   S_C ≠ 0 only by round-off: (S_C)ᵀ N_V in P_CV, and (S_C)ᵀ N_C in P_CC
  auto& error = kept.toLeftOut.front().error;
  error[0] += slipOnC * set.normal;
  error[2] += slipOnC * set.inertia;
  leftOut.rest[0] = slipOnC * set.normalOnC;
  leftOut.rest[2] = slipOnC * set.inertiaOnC;
  return result;
}

}  // namespace squeal::completeness
