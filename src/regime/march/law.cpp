// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"

namespace squeal::march {
namespace {

/// Returns the largest eigenvalue of Lᵀ A⁻¹ L with A = a K_z + C_z in the given rows and the
/// diagonal matrix L of `roots`, [row].
double largestEigenvalue(const ReducedModel& model, double a, const std::vector<PetscInt>& rows,
                         const std::vector<double>& roots) {
  if (std::ranges::none_of(roots, [](double x) { return x > 0; })) return 0;
  const PetscInt n = std::ssize(rows);
  DenseMatrix resistance(n, n), scaled(n, n);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i)
      resistance(i, j) =
          a * model.boundaryStiffness(rows[i], rows[j]) + model.boundaryDamping(rows[i], rows[j]);
  for (PetscInt i = 0; i < n; ++i) scaled(i, i) = roots[i];
  const linalg::Lu<double> lu(std::move(resistance));
  if (!(lu.pivotRatio() > 1e-15)) return std::numeric_limits<double>::infinity();
  lu.solve(scaled);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i) scaled(i, j) *= roots[i];
  return linalg::symmetricEigenvalues(linalg::symmetricPart(scaled)).back();
}

}  // namespace

double lawGain(const ReducedModel& model, double h, const std::vector<double>& slopes) {
  std::vector<PetscInt> rows;
  std::vector<double> falling, rising;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    for (int c = 0; c < model.dimension; ++c) {
      const PetscInt row = i * model.dimension + c;
      if (!model.moves[row] || (node.pressed() && (c == 0 || node.sticks()))) continue;
      const double b = c == 1 ? node.normalForce * slopes[i] : 0;
      rows.push_back(row);
      falling.push_back(std::sqrt(std::max(0.0, -b)));
      rising.push_back(std::sqrt(std::max(0.0, b)));
    }
  }
  const double fall = largestEigenvalue(model, h, rows, falling);
  return h > 0 ? std::max(fall, largestEigenvalue(model, h / 2, rows, rising)) : fall;
}

std::vector<double> steadySlopes(const ReducedModel& model) {
  std::vector<double> slopes;
  for (const Node& node : model.nodes) slopes.push_back(node.frictionSlope);
  return slopes;
}

std::vector<double> steepestSlopes(const ReducedModel& model, bool lowest) {
  constexpr int intervals = 256;
  std::vector<double> slopes;
  for (const Node& node : model.nodes) {
    slopes.push_back(0);
    if (!model.law || node.lawCoefficient == 0) continue;
    const double width = 2 * std::hypot(node.velocity[0], node.velocity[1]) / intervals;
    if (width == 0) continue;
    for (int k = 0; k < intervals; ++k) {
      const double slope =
          node.lawCoefficient * (model.law((k + 1) * width) - model.law(k * width)) / width;
      slopes.back() = lowest ? std::min(slopes.back(), slope) : std::max(slopes.back(), slope);
    }
  }
  return slopes;
}

}  // namespace squeal::march
