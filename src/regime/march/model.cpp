// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/model.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/check.hpp"

namespace squeal::march {
namespace {

using linalg::ComplexMatrix;
using linalg::Lu;

/// The linearised model in the free unknowns of steady sliding: q, and z of the free rows. In held
/// rows y = 0, hence z = −j q.
class Linearised {
 public:
  explicit Linearised(const ReducedModel& model) : model_(model) {
    for (PetscInt i = 0; i < std::ssize(model.nodes); ++i)
      for (int c = 0; c < model.dimension; ++c) {
        const Node& node = model.nodes[i];
        const PetscInt row = i * model.dimension + c;
        const bool held = node.pressed() && (c == 0 || (node.sticks() && node.hasFriction()));
        if (held || !model.moves[row])
          held_.push_back(row);
        else
          free_.push_back(row);
      }
  }

  /// Returns A(s), whose null vector contains q and z of the free rows.
  ComplexMatrix matrix(Complex s) const {
    const PetscInt k = model_.modes(), n = k + std::ssize(free_);
    // W = H(s) T by rows: first those of q, then those of z.
    ComplexMatrix h(k + model_.rows(), n);
    for (PetscInt j = 0; j < n; ++j) {
      std::vector<Complex> q(k), z(model_.rows());
      unknowns(j, q, z);
      forces(s, q, z, h.column(j));
    }
    ComplexMatrix a(n, n);
    for (PetscInt j = 0; j < n; ++j) {
      for (PetscInt i = 0; i < k; ++i) a(i, j) = h(i, j);
      for (std::size_t i = 0; i < free_.size(); ++i) a(k + i, j) = h(k + free_[i], j);
      // δy of held rows is zero: δz = −j δq there.
      for (const PetscInt row : held_)
        for (PetscInt i = 0; i < k; ++i) a(i, j) -= model_.jump(row, i) * h(k + row, j);
    }
    for (PetscInt node = 0; node < std::ssize(model_.nodes); ++node) addFriction(node, s, h, a);
    return a;
  }

  /// Sets q and z of a vector of the unknowns.
  void expand(const std::vector<Complex>& x, LinearMode& mode) const {
    const PetscInt k = model_.modes();
    mode.q.assign(x.begin(), x.begin() + k);
    mode.z.assign(model_.rows(), 0);
    for (std::size_t i = 0; i < free_.size(); ++i) mode.z[free_[i]] = x[k + i];
    for (const PetscInt row : held_)
      for (PetscInt i = 0; i < k; ++i) mode.z[row] -= model_.jump(row, i) * mode.q[i];
    mode.jump = mode.z;
    for (PetscInt i = 0; i < k; ++i)
      for (PetscInt row = 0; row < model_.rows(); ++row)
        mode.jump[row] += model_.jump(row, i) * mode.q[i];
    std::vector<Complex> all(k + model_.rows());
    forces(mode.s, mode.q, mode.z, all);
    mode.force.assign(all.begin() + k, all.end());
  }

 private:
  void unknowns(PetscInt j, std::vector<Complex>& q, std::vector<Complex>& z) const {
    if (j >= model_.modes()) {
      z[free_[j - model_.modes()]] = 1;
      return;
    }
    q[j] = 1;
    for (const PetscInt row : held_) z[row] = -model_.jump(row, j);
  }

  /// Sets the forces of a motion (q, z) e^{st}, with those of q first.
  void forces(Complex s, const std::vector<Complex>& q, const std::vector<Complex>& z,
              std::span<Complex> result) const {
    const PetscInt k = model_.modes(), m = model_.rows();
    std::ranges::fill(result, Complex(0));
    for (PetscInt i = 0; i < k; ++i) {
      if (q[i] != 0.0) {
        result[i] += (s * s + model_.stiffness[i]) * q[i];
        for (PetscInt l = 0; l < k; ++l) result[l] += s * model_.damping(l, i) * q[i];
        for (PetscInt row = 0; row < m; ++row)
          result[k + row] +=
              (model_.couplingStiffness(row, i) + s * model_.couplingDamping(row, i)) * q[i];
      }
      for (PetscInt row = 0; row < m; ++row)
        if (z[row] != 0.0)
          result[i] +=
              (model_.couplingStiffness(row, i) + s * model_.couplingDamping(row, i)) * z[row];
    }
    for (PetscInt column = 0; column < m; ++column)
      if (z[column] != 0.0)
        for (PetscInt row = 0; row < m; ++row)
          result[k + row] +=
              (model_.boundaryStiffness(row, column) + s * model_.boundaryDamping(row, column)) *
              z[column];
  }

  /// Adds the friction of a sliding node,
  ///   R_T* = −f R_N* t_1 − s R_N (df/d|w| y_∥ t_1 + f/|w| y_⊥ t_2),
  /// to its virtual work.
  void addFriction(PetscInt i, Complex s, const ComplexMatrix& h, ComplexMatrix& a) const {
    const Node& node = model_.nodes[i];
    if (!node.pressed() || node.sticks() || !node.hasFriction()) return;
    const PetscInt normal = i * model_.dimension, along = normal + 1, across = normal + 2;
    const PetscInt k = model_.modes();
    const double speed = std::hypot(node.velocity[0], node.velocity[1]);
    addDamping(along, s * node.frictionSlope * node.normalForce, a);
    for (PetscInt j = 0; j < a.columns(); ++j) {
      const Complex normalForce = h(k + normal, j);
      addVirtual(along, node.friction * normalForce, a.column(j));
    }
    if (model_.dimension == 3) addDamping(across, s * node.friction * node.normalForce / speed, a);
  }
  /// Adds the virtual work δy_row b y_row of a free row.
  void addDamping(PetscInt row, Complex b, ComplexMatrix& a) const {
    if (!model_.moves[row]) return;
    const PetscInt k = model_.modes();
    for (PetscInt j = 0; j < k; ++j) addVirtual(row, b * model_.jump(row, j), a.column(j));
    addVirtual(row, b, a.column(k + place(row)));
  }
  /// Adds the virtual work δy_row · value to a column.
  void addVirtual(PetscInt row, Complex value, std::span<Complex> column) const {
    if (!model_.moves[row]) return;
    for (PetscInt l = 0; l < model_.modes(); ++l) column[l] += model_.jump(row, l) * value;
    column[model_.modes() + place(row)] += value;
  }
  PetscInt place(PetscInt row) const {
    return std::ranges::lower_bound(free_, row) - free_.begin();
  }

  const ReducedModel& model_;
  std::vector<PetscInt> held_, free_;
};

Complex dot(const std::vector<Complex>& x, const std::vector<Complex>& y) {
  Complex sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::conj(x[i]) * y[i];
  return sum;
}

std::vector<Complex> product(const ComplexMatrix& a, const std::vector<Complex>& x) {
  std::vector<Complex> y(a.rows());
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i < a.rows(); ++i) y[i] += a(i, j) * x[j];
  return y;
}

void normalise(std::vector<Complex>& x) {
  const double length = std::sqrt(dot(x, x).real());
  for (auto& entry : x) entry /= length;
}

}  // namespace

double coefficient(const ReducedModel& model, const Node& node, double speed, double sweptChange) {
  if (model.law && node.lawCoefficient != 0) return node.lawCoefficient * model.law(speed);
  return sweptChange == 0 ? node.friction : node.friction + node.sweptFriction * sweptChange;
}

LinearMode nearestMode(const ReducedModel& model, Complex s, const StopRequested& stopRequested) {
  const Linearised linearised(model);
  // A(s) is quadratic in s, so three values define it. They are taken at the magnitude of s to
  // avoid cancellation.
  const double scale0 = std::abs(s);
  const ComplexMatrix constant = linearised.matrix(0), ahead = linearised.matrix(scale0),
                      behind = linearised.matrix(-scale0);
  const PetscInt n = constant.rows();
  std::vector<Complex> right(n, 1), left(n, 1);
  for (int step = 0; step < 30; ++step) {
    if (stopRequested && stopRequested()) throw Interrupted();
    const Complex ratio = s / scale0;
    ComplexMatrix a(n, n), slope(n, n);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Complex linear = 0.5 * (ahead.data()[i] - behind.data()[i]),
                    square = 0.5 * (ahead.data()[i] + behind.data()[i]) - constant.data()[i];
      a.data()[i] = constant.data()[i] + ratio * (linear + ratio * square);
      slope.data()[i] = (linear + 2.0 * ratio * square) / scale0;
    }
    Lu<Complex> lu{ComplexMatrix(a)};
    lu.raiseZeroPivots();
    for (int i = 0; i < (step == 0 ? 3 : 1); ++i) {
      lu.solve(std::span(right)), normalise(right);
      lu.solve(std::span(left), true), normalise(left);
    }
    const Complex change = dot(left, product(a, right)) / dot(left, product(slope, right));
    s -= change;
    if (!std::isfinite(std::abs(s))) break;
    if (std::abs(change) < 1e-13 * std::abs(s)) {
      LinearMode mode{s, {}, {}, {}, {}};
      linearised.expand(right, mode);
      return mode;
    }
  }
  throw Error("Newton's method does not converge to this eigenvalue of the reduced model");
}

double stableStep(const ReducedModel& model) {
  // With all nodes held, z = −j q: the stiffness is projected on [I; −j].
  const PetscInt k = model.modes();
  DenseMatrix stiffness(k, k);
  for (PetscInt i = 0; i < k; ++i) stiffness(i, i) = model.stiffness[i];
  const DenseMatrix coupled = linalg::transposedProduct(model.jump, model.couplingStiffness);
  for (PetscInt j = 0; j < k; ++j)
    for (PetscInt i = 0; i < k; ++i) stiffness(i, j) -= coupled(i, j) + coupled(j, i);
  linalg::addScaled(stiffness, 1, linalg::congruent(model.boundaryStiffness, model.jump));
  return 2 / std::sqrt(linalg::symmetricEigenvalues(std::move(stiffness)).back());
}

double longestStep(const ReducedModel& model) {
  // Without contact forces, z = −K_z⁻¹ K_zq q.
  DenseMatrix response = model.couplingStiffness;
  linalg::Lu<double>(DenseMatrix(model.boundaryStiffness)).solve(response);
  DenseMatrix stiffness = linalg::transposedProduct(model.couplingStiffness, response);
  for (double& entry : stiffness.entries()) entry = -entry;
  for (PetscInt i = 0; i < model.modes(); ++i) stiffness(i, i) += model.stiffness[i];
  stiffness = linalg::symmetricPart(stiffness);
  return 2 / std::sqrt(linalg::symmetricEigenvalues(std::move(stiffness)).back());
}

}  // namespace squeal::march
