// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The complementarity problem of steady sliding at one friction, condensed to the gaps g and the
/// normal forces F of the contact nodes: F = S g + q >= 0, g >= 0, F g = 0.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "model/contact/coupled.hpp"
#include "model/elasticity/elasticity.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::test {

using Rows = std::vector<std::vector<double>>;  // [row][column]

/// A⁻¹ B by Gaussian elimination with row pivoting.
inline Rows solved(Rows a, Rows b) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]), std::swap(b[k], b[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      for (std::size_t j = 0; j < b[i].size(); ++j) b[i][j] -= factor * b[k][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    for (double& entry : b[i]) entry /= a[i][i];
  return b;
}

/// The entries in these rows and columns.
inline Rows part(const Rows& a, const std::vector<std::size_t>& rows,
                 const std::vector<std::size_t>& columns) {
  Rows result;
  for (auto i : rows) {
    result.emplace_back();
    for (auto j : columns) result.back().push_back(a[i][j]);
  }
  return result;
}

/// F = S g + q.
struct Condensed {
  Rows s;
  std::vector<double> q;
};

/// On one rank. From the program's own matrices, by other algebra than its solver's.
inline Condensed condensed(const analysis::Analysis& analysis, double friction) {
  const std::vector<unsigned char> all(analysis.model.contact.interfaces.nodes.size(), 1);
  const auto transformation =
      analysis.model.contact.transformation(contact::ActiveSet::open(all.size()));
  const auto stiffness =
      contact::project(analysis.model.contact, transformation, analysis.model.bodies.stiffness);
  const OwnedMat rows = analysis.model.contact.slipRowsAt(
      transformation, analysis.model.contact.slip(1, nullptr), all, friction);
  const OwnedMat jacobian = stiffness.tested(rows);
  const OwnedVec residual = elasticity::nodalVector(*analysis.model.mesh),
                 reactions = elasticity::nodalVector(*analysis.model.mesh);
  OwnedVec constant, slope;
  check(MatCreateVecs(jacobian, constant.out(), slope.out()));
  check(
      MatMult(analysis.model.bodies.stiffness, analysis.model.contact.kinematics.offset, residual));
  check(VecAXPY(residual, -1, analysis.model.bodies.load));
  check(MatMultTranspose(transformation.trial, residual, constant));
  check(MatMult(analysis.model.contact.sliding.reaction, residual, reactions));
  check(MatMultTranspose(rows, reactions, slope));
  check(VecAXPY(constant, 1, slope));

  // One more column for the constant: the Schur complement of both at once.
  const auto n = static_cast<std::size_t>(transformation.columns);
  Rows full(n, std::vector<double>(n + 1));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto row = static_cast<PetscInt>(i), column = static_cast<PetscInt>(j);
      check(MatGetValues(jacobian, 1, &row, 1, &column, &full[i][j]));
    }
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(constant, &values));
  for (std::size_t i = 0; i < n; ++i) full[i][n] = values[i];
  check(VecRestoreArrayRead(constant, &values));
  std::vector<std::size_t> gaps(transformation.gapColumn.begin(), transformation.gapColumn.end()),
      inner, right = gaps;
  for (std::size_t i = 0; i < n; ++i)
    if (std::find(gaps.begin(), gaps.end(), i) == gaps.end()) inner.push_back(i);
  right.push_back(n);
  const Rows response = solved(part(full, inner, inner), part(full, inner, right)),
             coupling = part(full, gaps, inner);
  Rows outer = part(full, gaps, right);
  for (std::size_t i = 0; i < outer.size(); ++i)
    for (std::size_t j = 0; j < outer[i].size(); ++j)
      for (std::size_t k = 0; k < inner.size(); ++k) outer[i][j] -= coupling[i][k] * response[k][j];
  Condensed result;
  for (auto& row : outer) {
    result.q.push_back(row.back());
    row.pop_back();
    result.s.push_back(row);
  }
  return result;
}

/// Gaps and forces of a solution.
struct Sliding {
  std::vector<double> gap, force;
};

/// Every solution, found by trying all sets of open nodes.
inline std::vector<Sliding> allSolutions(const Condensed& problem) {
  const std::size_t n = problem.q.size();
  std::vector<Sliding> solutions;
  for (unsigned set = 0; set < 1U << n; ++set) {
    std::vector<std::size_t> open;
    Rows right;
    for (std::size_t i = 0; i < n; ++i)
      if (set >> i & 1U) open.push_back(i), right.push_back({-problem.q[i]});
    const Rows gaps = solved(part(problem.s, open, open), right);
    Sliding sliding{std::vector<double>(n, 0.0), problem.q};
    for (std::size_t k = 0; k < open.size(); ++k) sliding.gap[open[k]] = gaps[k][0];
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) sliding.force[i] += problem.s[i][j] * sliding.gap[j];
    for (auto i : open) sliding.force[i] = 0;
    const auto admissible = [](double x) { return x >= 0; };  // NaN, of a singular set, is not
    if (std::all_of(sliding.gap.begin(), sliding.gap.end(), admissible) &&
        std::all_of(sliding.force.begin(), sliding.force.end(), admissible))
      solutions.push_back(sliding);
  }
  return solutions;
}

}  // namespace squeal::test
