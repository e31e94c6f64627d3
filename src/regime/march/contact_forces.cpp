// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/contact_forces.hpp"

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"
#include "regime/march/newton.hpp"

namespace squeal::march {
namespace {

constexpr int mostSweeps = 100'000;
// Newton's method is tried after `firstTrial` sweeps, and each time their number has doubled.
constexpr int firstTrial = 200;

/// Adds the columns [first, first + count) of W times `change` to d.
void addColumns(const DenseMatrix& w, PetscInt first, int count, const double* change,
                std::vector<double>& d) {
  const PetscBLASInt rows = w.rows(), columns = count, one = 1;
  const double unit = 1;
  BLASgemv_("N", &rows, &columns, &unit, w.column(first).data(), &rows, change, &one, &unit,
            d.data(), &one);
}

}  // namespace

StepSolver::StepSolver(DenseMatrix w, int dimension, std::vector<unsigned char> moves)
    : w_(std::move(w)), dimension_(dimension), moves_(std::move(moves)) {
  for (PetscInt row = 0; row < w_.rows(); row += dimension_) {
    normalStep_.push_back(w_(row, row) > 0 ? 1 / w_(row, row) : 0);
    const double a = dimension_ > 1 && moves_[row + 1] ? w_(row + 1, row + 1) : 0,
                 b = dimension_ > 2 && moves_[row + 2] ? w_(row + 2, row + 2) : 0,
                 c = a > 0 && b > 0 ? w_(row + 1, row + 2) : 0,
                 largest = (a + b) / 2 + std::hypot((a - b) / 2, c);
    slipStep_.push_back(largest > 0 ? 1 / largest : 0);
  }
}

/// Returns the largest change of a force.
double StepSolver::sweep(const std::vector<double>& friction,
                         const std::vector<unsigned char>& active, double negligible,
                         std::vector<double>& r, std::vector<double>& d) const {
  double largest = 0;
  for (std::size_t node = 0; node < active.size(); ++node) {
    if (!active[node]) continue;
    const PetscInt row = node * dimension_;
    const double normal = std::max(0.0, r[row] - normalStep_[node] * d[row]);
    double change[3] = {normal - r[row], 0, 0};
    if (slipStep_[node] > 0) {
      double force[2] = {0, 0};
      for (int c = 1; c < dimension_; ++c)
        if (moves_[row + c])
          force[c - 1] = r[row + c] - slipStep_[node] * (d[row + c] + w_(row + c, row) * change[0]);
      const double squares = force[0] * force[0] + force[1] * force[1],
                   limit = friction[node] * normal;
      // An infinite coefficient times a zero normal force is not a number.
      const double factor = normal == 0               ? 0
                            : squares > limit * limit ? limit / std::sqrt(squares)
                                                      : 1;
      for (int c = 1; c < dimension_; ++c)
        if (moves_[row + c]) change[c] = factor * force[c - 1] - r[row + c];
    }
    const double most = std::max({std::abs(change[0]), std::abs(change[1]), std::abs(change[2])});
    largest = std::max(largest, most);
    // Small changes are not worth loading W into the cache, except where the node opens.
    if (most <= negligible && (normal > 0 || r[row] == 0)) continue;
    for (int c = 0; c < dimension_; ++c) r[row + c] += change[c];
    addColumns(w_, row, dimension_, change, d);
  }
  return largest;
}

int StepSolver::solve(const std::vector<double>& friction, const std::vector<unsigned char>& active,
                      double tolerance, std::vector<double>& r, std::vector<double>& d,
                      const StopRequested& stopRequested) const {
  const StepProblem problem{.w = w_,
                            .dimension = dimension_,
                            .moves = moves_,
                            .normalScale = normalStep_,
                            .slipScale = slipStep_,
                            .friction = friction,
                            .active = active};
  int trial = firstTrial;
  for (int count = 1; count <= mostSweeps; ++count) {
    if (stopRequested && stopRequested()) throw Interrupted();
    // The tolerance of forces far above those of steady sliding is their round-off.
    double largest = 0;
    for (const double force : r) largest = std::max(largest, std::abs(force));
    const double accuracy = std::max(tolerance, 1e-10 * largest);
    if (sweep(friction, active, accuracy / 10, r, d) <= accuracy) return count;
    // The next sweep verifies the forces that Newton's method finds.
    if (count != trial) continue;
    newton(problem, accuracy / 10, r, d, stopRequested);
    trial *= 2;
  }
  throw Error("the contact forces of a time step do not converge");
}

double defect(int dimension, const std::vector<unsigned char>& moves,
              const std::vector<double>& friction, const std::vector<double>& r,
              const std::vector<double>& d, const std::vector<double>& stiffness) {
  double worst = 0;
  for (std::size_t node = 0; node < friction.size(); ++node) {
    const PetscInt row = node * dimension;
    const double normal = r[row], gap = d[row] * stiffness[node];
    // min(R_N, gap) is zero where both are complementary.
    worst = std::max(worst, std::abs(std::min(normal, gap)));
    double force[2] = {0, 0}, slip[2] = {0, 0};
    for (int c = 1; c < dimension; ++c)
      if (moves[row + c]) force[c - 1] = r[row + c], slip[c - 1] = d[row + c] * stiffness[node];
    // R_T is the point of the disc of radius f R_N next to R_T − slip.
    const double to[2] = {force[0] - slip[0], force[1] - slip[1]};
    const double size = std::hypot(to[0], to[1]), limit = normal > 0 ? friction[node] * normal : 0;
    const double factor = size > limit ? limit / size : 1;
    worst = std::max(worst, std::hypot(force[0] - factor * to[0], force[1] - factor * to[1]));
  }
  return worst;
}

}  // namespace squeal::march
