// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/newton.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/lu.hpp"
#include "regime/march/products.hpp"

namespace squeal::march {
namespace {

using linalg::DenseMatrix;
constexpr int mostSteps = 30, mostHalvings = 10;

/// The projection of R − κ d at a node.
struct Projection {
  double normal = 0;         // max(0, R_N − κ_N d_N)
  double force[2] = {0, 0};  // R_T − κ_T d_T
  double size = 0;           // |force|
  double limit = 0;          // the radius of the disc
  double factor = 0;         // of `force` in its projection
};

Projection projected(const StepProblem& p, std::size_t node, const std::vector<double>& r,
                     const std::vector<double>& d) {
  const std::size_t row = node * p.dimension;
  Projection result;
  if (!p.active[node]) return result;
  result.normal = std::max(0.0, r[row] - p.normalScale[node] * d[row]);
  if (result.normal == 0) return result;
  for (int c = 1; c < p.dimension; ++c)
    if (p.moves[row + c]) result.force[c - 1] = r[row + c] - p.slipScale[node] * d[row + c];
  result.size = std::hypot(result.force[0], result.force[1]);
  result.limit = p.friction[node] * result.normal;
  result.factor = result.size > result.limit ? result.limit / result.size : 1;
  return result;
}

/// Returns the projections of R − κ d, [row].
std::vector<double> projections(const StepProblem& p, const std::vector<double>& r,
                                const std::vector<double>& d) {
  std::vector<double> result(r.size());
  for (std::size_t node = 0; node < p.active.size(); ++node) {
    const Projection to = projected(p, node, r, d);
    const std::size_t row = node * p.dimension;
    result[row] = to.normal;
    for (int c = 1; c < p.dimension; ++c) result[row + c] = to.factor * to.force[c - 1];
  }
  return result;
}

/// Returns F, [row].
std::vector<double> residual(const StepProblem& p, const std::vector<double>& r,
                             const std::vector<double>& d) {
  std::vector<double> f = projections(p, r, d);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = r[i] - f[i];
  return f;
}

double largestOf(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Subtracts from row i of A the factor times the derivative of R_row − κ d_row.
void subtractRow(DenseMatrix& a, PetscInt i, double factor, const DenseMatrix& w, PetscInt row,
                 double scale) {
  a(i, row) -= factor;
  for (PetscInt j = 0; j < a.columns(); ++j) a(i, j) += factor * scale * w(row, j);
}

/// Returns the derivative of F.
DenseMatrix derivative(const StepProblem& p, const std::vector<double>& r,
                       const std::vector<double>& d) {
  DenseMatrix a = linalg::identity(p.w.rows());
  for (std::size_t node = 0; node < p.active.size(); ++node) {
    const Projection to = projected(p, node, r, d);
    if (to.normal == 0) continue;
    const PetscInt row = node * p.dimension;
    subtractRow(a, row, 1, p.w, row, p.normalScale[node]);
    for (int c = 1; c < p.dimension; ++c) {
      if (!p.moves[row + c]) continue;
      if (to.factor == 1) {
        subtractRow(a, row + c, 1, p.w, row + c, p.slipScale[node]);
        continue;
      }
      const double along = to.force[c - 1] / to.size;
      subtractRow(a, row + c, p.friction[node] * along, p.w, row, p.normalScale[node]);
      for (int k = 1; k < p.dimension; ++k)
        if (p.moves[row + k])
          subtractRow(a, row + c, to.factor * ((k == c) - along * to.force[k - 1] / to.size), p.w,
                      row + k, p.slipScale[node]);
    }
  }
  return a;
}

/// Moves R and d along `change` by the first of 1, 1/2, 1/4, … that reduces the norm of F. Returns
/// the new F; empty if none does.
std::vector<double> searchAlong(const StepProblem& p, const std::vector<double>& change,
                                double norm, std::vector<double>& r, std::vector<double>& d) {
  std::vector<double> slips(d.size());
  addProduct(p.w, change, slips);
  double length = 1;
  for (int halving = 0; halving <= mostHalvings; ++halving, length /= 2) {
    std::vector<double> force = r, jump = d;
    for (std::size_t i = 0; i < r.size(); ++i)
      force[i] += length * change[i], jump[i] += length * slips[i];
    std::vector<double> f = residual(p, force, jump);
    if (!(std::sqrt(dot(f, f)) < (1 - 1e-4 * length) * norm)) continue;
    r = std::move(force), d = std::move(jump);
    return f;
  }
  return {};
}

}  // namespace

bool newton(const StepProblem& problem, double accuracy, std::vector<double>& r,
            std::vector<double>& d, const StopRequested& stopRequested) {
  std::vector<double> force = r, jump = d, f = residual(problem, r, d);
  for (int step = 0; step < mostSteps && !f.empty() && !(largestOf(f) <= accuracy); ++step) {
    if (stopRequested && stopRequested()) throw Interrupted();
    const double norm = std::sqrt(dot(f, f));
    const linalg::Lu<double> lu(derivative(problem, force, jump));
    if (!(lu.pivotRatio() > 0)) return false;
    lu.solve(std::span(f));
    for (double& entry : f) entry = -entry;
    f = searchAlong(problem, f, norm, force, jump);
  }
  if (f.empty() || !(largestOf(f) <= accuracy)) return false;
  // Forces of open nodes are now round-off; the projections are zero there.
  r = projections(problem, force, jump), d = std::move(jump);
  for (std::size_t i = 0; i < r.size(); ++i) force[i] = r[i] - force[i];
  addProduct(problem.w, force, d);
  return true;
}

}  // namespace squeal::march
