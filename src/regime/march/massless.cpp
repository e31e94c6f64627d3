// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/massless.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/check.hpp"
#include "regime/march/products.hpp"

namespace squeal::march {
namespace {

/// Returns (K_z + C_z / h)⁻¹, with zeros in the rows and columns that do not move.
DenseMatrix boundaryCompliance(const ReducedModel& model, double h) {
  const PetscInt m = model.rows();
  DenseMatrix a = model.boundaryStiffness, inverse = linalg::identity(m);
  linalg::addScaled(a, 1 / h, model.boundaryDamping);
  linalg::Lu<double>(std::move(a)).solve(inverse);
  inverse = linalg::symmetricPart(inverse);
  for (PetscInt i = 0; i < m; ++i)
    for (PetscInt j = 0; j < m; ++j)
      if (!model.moves[i] || !model.moves[j]) inverse(i, j) = 0;
  return inverse;
}

/// Returns (1 + h C/2)⁻¹.
DenseMatrix modalInverse(const ReducedModel& model, double h) {
  DenseMatrix a = linalg::identity(model.modes()), inverse = a;
  linalg::addScaled(a, h / 2, model.damping);
  linalg::Lu<double>(std::move(a)).solve(inverse);
  return inverse;
}

}  // namespace

// This lists all members: a new one does not compile until it is added here.
void fields(Stream& stream, InitialState& state) {
  auto& [q, v, z] = state;
  stream(q, v, z);
}

InitialState initialStateAt(const Start& start, double h) {
  InitialState state{start.q, start.v, start.z};
  for (std::size_t i = 0; i < start.acceleration.size(); ++i)
    state.v[i] -= h / 2 * start.acceleration[i];
  for (std::size_t i = 0; i < start.zRate.size(); ++i) state.z[i] -= h * start.zRate[i];
  return state;
}

Massless::Massless(const ReducedModel& model, const InitialState& initial, double h,
                   double sweptChange)
    : Scheme(model, sweptChange),
      h_(h),
      solver_(boundaryCompliance(model, h), model.dimension, model.moves),
      modalInverse_(modalInverse(model, h)),
      active_(model.nodes.size(), 1),
      q_(initial.q),
      v_(initial.v),
      z_(initial.z),
      jump_(initial.z),
      damped_(model.rows()),
      before_(steadyForce_) {
  addProduct(model.boundaryDamping, z_, damped_);
  std::vector<double> q = q_;  // of the preceding step
  for (std::size_t i = 0; i < q.size(); ++i) q[i] -= h * v_[i];
  addProduct(model.jump, q, jump_);
  for (PetscInt row = 0; row < model.rows(); row += model.dimension)
    stiffness_.push_back(1 / solver_.w()(row, row));
  state_.time = -h;
}

void Massless::setAccuracy(double relative) { tolerance_ *= relative / accuracy; }

struct Massless::StepArrays {
  std::vector<double> carried;  // j q
  std::vector<double> jump;     // y
  std::vector<double> z, rate;  // z and ż
  std::vector<double> change;   // R*
  std::vector<double> damped;   // C_z z
  std::vector<double> mean;     // v̄
};

void Massless::step() {
  updateFriction();
  StepArrays step = predict();
  solveContact(step);
  update(step);
  addWork(step);
  finish(std::move(step));
}

/// Returns the part of d that is independent of the forces and of z of this step.
double Massless::known(PetscInt i) const {
  return isNormal(i) ? steadyGap_[i] : h_ * steadyVelocity_[i] - jump_[i];
}

/// Extrapolates the contact forces of the last two steps, and sets d = b + W R for them [M.72].
Massless::StepArrays Massless::predict() {
  const PetscInt m = model_.rows();
  std::vector<double> guess(m), load(m);  // R, and the total load on the boundary
  for (PetscInt i = 0; i < m; ++i) {
    guess[i] = 2 * state_.force[i] - before_[i];
    load[i] = damped_[i] / h_ - steadyForce_[i];
  }
  for (PetscInt row = 0; row < m; row += model_.dimension)
    if (guess[row] <= 0)
      for (int c = 0; c < model_.dimension; ++c) guess[row + c] = 0;
  addProduct(model_.couplingStiffness, q_, load, -1);
  addProduct(model_.couplingDamping, v_, load, -1);
  for (PetscInt i = 0; i < m; ++i) load[i] += guess[i];
  StepArrays step;
  step.carried.resize(m), step.jump.resize(m);
  addProduct(model_.jump, q_, step.carried);
  addProduct(solver_.w(), load, step.jump);
  increments_.resize(m);
  for (PetscInt i = 0; i < m; ++i) {
    step.jump[i] += step.carried[i];
    increments_[i] = step.jump[i] + known(i);
  }
  before_ = std::exchange(state_.force, std::move(guess));
  return step;
}

/// Solves for the contact forces, and sets y, z, ż, R* and C_z z.
void Massless::solveContact(StepArrays& step) {
  const PetscInt m = model_.rows();
  sweeps_ =
      solver_.solve(friction_, active_, tolerance_, state_.force, increments_, stopRequested_);
  step.z.resize(m), step.rate.resize(m), step.change.resize(m), step.damped.resize(m);
  for (PetscInt i = 0; i < m; ++i) {
    step.jump[i] = increments_[i] - known(i);
    step.z[i] = step.jump[i] - step.carried[i];
    step.rate[i] = (step.z[i] - z_[i]) / h_;
    step.change[i] = state_.force[i] - steadyForce_[i];
  }
  addProduct(model_.boundaryDamping, step.z, step.damped);
}

/// Integrates q and v over the step.
void Massless::update(StepArrays& step) {
  const PetscInt k = model_.modes();
  std::vector<double> force(k), acceleration(k);
  addProduct(model_.damping, v_, force, -1);
  addProduct(model_.couplingDamping, step.rate, force, -1, true);
  for (PetscInt i = 0; i < k; ++i) force[i] -= model_.stiffness[i] * q_[i];
  addProduct(model_.couplingStiffness, step.z, force, -1, true);
  addProduct(model_.jump, step.change, force, 1, true);
  // C acts on the mean of the velocities before and after the step.
  addProduct(modalInverse_, force, acceleration);
  state_.q = q_;
  state_.kinetic = 0;
  step.mean.resize(k);
  for (PetscInt i = 0; i < k; ++i) {
    step.mean[i] = v_[i] + h_ / 2 * acceleration[i];
    state_.kinetic += step.mean[i] * step.mean[i] / 2;
    v_[i] += h_ * acceleration[i];
    q_[i] += h_ * v_[i];
  }
  if (!std::isfinite(state_.kinetic)) throw Error("the motion is not finite: reduce the time step");
}

/// Adds the work of the step, and sets the velocities of the contact.
void Massless::addWork(const StepArrays& step) {
  const PetscInt k = model_.modes(), m = model_.rows();
  // Damping works on q and z: the force on z is C_z ż + C_zq v.
  std::vector<double> resisting(k), onBoundary(m), along(m);
  addProduct(model_.damping, step.mean, resisting, -1);
  addProduct(model_.couplingDamping, step.rate, resisting, -1, true);
  addProduct(model_.couplingDamping, v_, onBoundary);
  for (PetscInt i = 0; i < m; ++i) onBoundary[i] += (step.damped[i] - damped_[i]) / h_;
  work_.damping += h_ * (dot(step.rate, onBoundary) - dot(step.mean, resisting));
  addProduct(model_.jump, step.mean, along);  // j v̄
  state_.rate.resize(m);
  for (PetscInt i = 0; i < m; ++i) {
    const double power = step.change[i] * (along[i] + step.rate[i]);
    work_.contact += h_ * power;
    work_.moved += h_ * std::abs(power);
    state_.rate[i] = steadyVelocity_[i] + (step.jump[i] - jump_[i]) / h_;
    if (!isNormal(i)) work_.friction -= h_ * state_.force[i] * state_.rate[i];
  }
}

/// Stores the arrays of the step as those of the last one.
void Massless::finish(StepArrays step) {
  state_.v = std::move(step.mean);
  state_.jump = step.jump;
  state_.time += h_;
  jump_ = std::move(step.jump), z_ = std::move(step.z), damped_ = std::move(step.damped);
}

double Massless::energy() const {
  std::vector<double> force(model_.rows());
  addProduct(model_.boundaryStiffness, z_, force, 0.5);
  addProduct(model_.couplingStiffness, state_.q, force);
  double sum = state_.kinetic + dot(force, z_);
  for (PetscInt i = 0; i < model_.modes(); ++i)
    sum += model_.stiffness[i] * state_.q[i] * state_.q[i] / 2;
  return sum;
}

/// Returns true if both slips of a node in contact stuck in the last step.
bool Massless::sticks(std::size_t node) const {
  const PetscInt row = node * model_.dimension;
  double to[2] = {0, 0};
  for (int c = 1; c < model_.dimension; ++c)
    if (model_.moves[row + c])
      to[c - 1] = state_.force[row + c] - stiffness_[node] * increments_[row + c];
  // The projection onto the cone does not change a force within the cone.
  return std::hypot(to[0], to[1]) < friction_[node] * state_.force[row];
}

std::vector<unsigned char> Massless::stuck() const {
  std::vector<unsigned char> result(model_.rows());
  for (std::size_t node = 0; node < model_.nodes.size(); ++node)
    for (int c = 1; c < model_.dimension; ++c) {
      const PetscInt row = node * model_.dimension;
      result[row + c] = model_.moves[row + c] && state_.force[row] > 0 && sticks(node);
    }
  return result;
}

/// Returns the rows with a force in the last step.
std::vector<PetscInt> Massless::loadedRows() const {
  std::vector<PetscInt> rows;
  for (std::size_t node = 0; node < model_.nodes.size(); ++node)
    for (int c = 0; c < model_.dimension; ++c)
      if (const PetscInt normal = node * model_.dimension, row = normal + c;
          state_.force[normal] > 0 && (c == 0 || model_.moves[row]) && solver_.w()(row, row) > 0)
        rows.push_back(row);
  return rows;
}

/// Sets row i of a δR = right, for the slip of a sliding node, divided by the magnitude of its
/// diagonal entry: with e = d_T/|d_T|,
///   δR_T = −f e δR_N − (f R_N/|d_T|) (1 − e eᵀ) δd_T.
void Massless::setSlidingRow(PetscInt i, const std::vector<PetscInt>& rows, const DenseMatrix& b,
                             DenseMatrix& a, DenseMatrix& right) const {
  const DenseMatrix& w = solver_.w();
  const int dimension = model_.dimension;
  const PetscInt row = rows[i], normal = row - row % dimension;
  double d[2] = {0, 0};
  for (int c = 1; c < dimension; ++c)
    if (model_.moves[normal + c]) d[c - 1] = increments_[normal + c];
  const double length = std::hypot(d[0], d[1]), f = friction_[row / dimension];
  const double across = f * state_.force[normal] / length;
  const double scale = 1 / (1 + across * w(row, row));
  const int own = row - normal - 1;
  for (PetscInt j = 0; j < a.columns(); ++j) {
    double sum = rows[j] == row ? 1 : rows[j] == normal ? f * d[own] / length : 0;
    for (int c = 0; c + 1 < dimension; ++c)
      if (model_.moves[normal + 1 + c])
        sum += across * ((c == own) - d[own] * d[c] / length / length) * w(normal + 1 + c, rows[j]);
    a(i, j) = scale * sum;
  }
  for (PetscInt j = 0; j < right.columns(); ++j)
    for (int c = 0; c + 1 < dimension; ++c)
      if (model_.moves[normal + 1 + c])
        right(i, j) -=
            scale * across * ((c == own) - d[own] * d[c] / length / length) * b(normal + 1 + c, j);
}

/// Returns the variations δR for variations of b in d = b + W R. A node in contact has δd_N = 0
/// and, if it sticks, δd_T = 0.
DenseMatrix Massless::forceVariations(const DenseMatrix& b) const {
  const DenseMatrix& w = solver_.w();
  const auto rows = loadedRows();
  const PetscInt n = std::ssize(rows), columns = b.columns();
  DenseMatrix result(model_.rows(), columns);
  if (n == 0) return result;
  DenseMatrix a(n, n), right(n, columns);
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt row = rows[i];
    if (!isNormal(row) && !sticks(row / model_.dimension)) {
      setSlidingRow(i, rows, b, a, right);
      continue;
    }
    for (PetscInt j = 0; j < n; ++j) a(i, j) = w(row, rows[j]) / w(row, row);
    for (PetscInt j = 0; j < columns; ++j) right(i, j) = -b(row, j) / w(row, row);
  }
  linalg::Lu<double>(std::move(a)).solve(right);
  for (PetscInt j = 0; j < columns; ++j)
    for (PetscInt i = 0; i < n; ++i) result(rows[i], j) = right(i, j);
  return result;
}

void Massless::propagate(Variations& x) const {
  using linalg::addScaled, linalg::multiplyAdd, linalg::product, linalg::transposedProduct;
  const DenseMatrix& w = solver_.w();
  DenseMatrix load(model_.rows(), x.q.columns());
  multiplyAdd(model_.boundaryDamping, x.z, load, 1 / h_);
  multiplyAdd(model_.couplingStiffness, x.q, load, -1);
  multiplyAdd(model_.couplingDamping, x.v, load, -1);
  // d without the forces: of a gap j q + W L, of a slip W L − z_{n−1} + h j v.
  DenseMatrix increments = product(w, load);
  const DenseMatrix gaps = product(model_.jump, x.q), slips = product(model_.jump, x.v);
  for (PetscInt j = 0; j < increments.columns(); ++j)
    for (PetscInt i = 0; i < increments.rows(); ++i)
      increments(i, j) += isNormal(i) ? gaps(i, j) : h_ * slips(i, j) - x.z(i, j);
  const DenseMatrix force = forceVariations(increments);
  addScaled(load, 1, force);
  DenseMatrix z = product(w, load), rate = z;  // h ż
  addScaled(rate, -1, x.z);
  DenseMatrix modal = transposedProduct(model_.jump, force);
  addScaled(modal, -1, transposedProduct(model_.couplingStiffness, z));
  addScaled(modal, -1 / h_, transposedProduct(model_.couplingDamping, rate));
  multiplyAdd(model_.damping, x.v, modal, -1);
  for (PetscInt j = 0; j < modal.columns(); ++j)
    for (PetscInt i = 0; i < modal.rows(); ++i) modal(i, j) -= model_.stiffness[i] * x.q(i, j);
  multiplyAdd(modalInverse_, modal, x.v, h_);
  addScaled(x.q, h_, x.v);
  x.z = std::move(z);
}

std::unique_ptr<Scheme> masslessScheme(const ReducedModel& model, const Start& start, double h) {
  return std::make_unique<Massless>(model, initialStateAt(start, h), h);
}

}  // namespace squeal::march
