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

/// Returns the columns of V that are no modes.
std::vector<PetscInt> otherColumns(const KnownModes& modes, PetscInt size) {
  std::vector<PetscInt> others;
  for (PetscInt i = 0; i < size; ++i)
    if (i < modes.first || i >= modes.first + modes.count) others.push_back(i);
  return others;
}

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

/// Returns M_CV in coordinates of V, which is zero for the modes. The directions within round-off
/// become the remainder.
proof::Coupling massCoupling(const SetMatrices& set, double most) {
  const auto others = otherColumns(set.modes, set.leftMass.rows());
  proof::Coupling coupling;
  coupling.error[2] = set.modes.error;
  if (others.empty()) return coupling;
  const auto [root, raise] =
      rootOf(linalg::symmetricPart(linalg::principalPart(others, set.leftMass)),
             "the free modes are not complete below the frequency of their count", most * most);
  const double small = 4 * raise;
  PetscInt first = 0;
  while (first < root.columns() && linalg::squaredLength(root.column(first)) <= small) ++first;
  if (first > 0) coupling.error[2] += std::sqrt(small);
  DenseMatrix rows(set.leftMass.rows(), root.columns() - first);
  for (PetscInt k = first; k < root.columns(); ++k)
    for (PetscInt i = 0; i < root.rows(); ++i) rows(others[i], k - first) = root(i, k);
  coupling.coefficients[2] =
      linalg::transposed(linalg::product(linalg::choleskyFactor(set.energy), rows));
  return coupling;
}

}  // namespace

SetBounds setBounds(const SetMatrices& set, double reach) {
  SetBounds bounds{};
  bounds.reach = reach;
  bounds.mass = 1 / set.modes.theta + set.modes.error;
  bounds.toLeftOut = massCoupling(set, bounds.mass);
  bounds.normal = proof::quickBound(linalg::DenseView(set.normal));
  bounds.inertia = proof::quickBound(linalg::DenseView(set.inertia));
  if (set.normal.empty()) return bounds;
  const auto factor = [](const DenseMatrix& left, double kept) {
    return rootOf(linalg::symmetricPart(left), "the normal forces contradict their responses",
                  kept * kept)
        .factor;
  };
  DenseMatrix stiff = factor(set.leftNormal, bounds.normal),
              heavy = factor(set.leftInertia, bounds.inertia);
  bounds.leftNormal = longest(stiff);
  bounds.leftInertia = longest(heavy);
  // For |s| ≤ reach and all t,
  //   (A + s² B)(A + s² B)ᴴ ≤ (1 + t) A Aᵀ + (1 + 1/t) reach⁴ B Bᵀ
  const double square = reach * reach, t = square * bounds.leftInertia / bounds.leftNormal;
  for (double& entry : stiff.entries()) entry *= std::sqrt(1 + t);
  for (double& entry : heavy.entries()) entry *= std::sqrt(1 + 1 / t) * square;
  bounds.forces = linalg::product(stiff, linalg::transposed(stiff));
  linalg::addScaled(bounds.forces, 1, linalg::product(heavy, linalg::transposed(heavy)));
  bounds.forces = rootOf(std::move(bounds.forces), "a sum of squares is negative",
                         bounds.leftNormal * bounds.leftNormal)
                      .factor;
  return bounds;
}

PointBounds pointBounds(const SetBounds& set, PointMatrices point) {
  PointBounds result;
  auto& [kept, leftOut] = result;
  kept.matrices = {std::move(point.problem.stiffness), DenseMatrix(),
                   std::move(point.problem.mass)};
  kept.toLeftOut = {set.toLeftOut};
  kept.fromLeftOut = {proof::transposed(set.toLeftOut)};
  kept.reach = set.reach;
  leftOut.mass = set.mass;
  if (point.slip.empty() || linalg::isZero(point.slip)) return result;
  // The friction in P_VC is (S V)ᵀ (N_0C + s² N_2C).
  kept.fromLeftOut.emplace_back().coefficients[0] =
      linalg::transposedProduct(point.slip, set.forces);
  //   S_C ≠ 0 only by round-off: (S_C)ᵀ N_V in P_CV, and (S_C)ᵀ N_C in P_CC
  auto& error = kept.toLeftOut.front().error;
  error[0] += point.slipError * set.normal;
  error[2] += point.slipError * set.inertia;
  leftOut.rest[0] = point.slipError * set.leftNormal;
  leftOut.rest[2] = point.slipError * set.leftInertia;
  return result;
}

}  // namespace squeal::completeness
