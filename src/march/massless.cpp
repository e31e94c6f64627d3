#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/lu.hpp"
#include "linalg/symmetric.hpp"
#include "march/products.hpp"
#include "march/scheme.hpp"
#include "petsc/check.hpp"

namespace squeal::march {
namespace {

/// Returns (K_z + C_z / h)⁻¹, with zeros in the rows and columns of what does not move.
DenseMatrix boundaryCompliance(const ReducedModel& model, double h) {
  const PetscInt m = model.rows();
  DenseMatrix a = model.boundaryStiffness, inverse(m, m);
  linalg::addScaled(a, 1 / h, model.boundaryDamping);
  for (PetscInt i = 0; i < m; ++i) inverse(i, i) = 1;
  linalg::Lu<double>(std::move(a)).solve(inverse);
  inverse = linalg::symmetricPart(inverse);
  for (PetscInt i = 0; i < m; ++i)
    for (PetscInt j = 0; j < m; ++j)
      if (!model.moves[i] || !model.moves[j]) inverse(i, j) = 0;
  return inverse;
}

/// The leapfrog rule for q with the backward Euler rule for z [M.72]. In step n,
///   K_z z_n + C_z (z_n − z_{n−1})/h + K_zq q_n + C_zq v_{n−1/2} = R*_n,   y_n = j q_n + z_n,
/// with contact and friction for y_n and y_n − y_{n−1}; then
///   v_{n+1/2} = v_{n−1/2} + h (jᵀR*_n − Λ q_n − C v_{n−1/2} − K_zqᵀ z_n − C_zqᵀ ż_n).
class Massless : public Scheme {
 public:
  Massless(const ReducedModel& model, const Start& start, double h)
      : Scheme(model),
        h_(h),
        solver_(boundaryCompliance(model, h), model.dimension, model.moves),
        active_(model.nodes.size(), 1),
        q_(start.q),
        v_(start.v),
        z_(start.z),
        before_(steadyForce_) {
    const PetscInt m = model.rows();
    for (PetscInt i = 0; i < m; ++i) z_[i] -= h * start.zRate[i];
    damped_.assign(m, 0);
    addProduct(model.boundaryDamping, z_, damped_);
    jump_ = z_;
    std::vector<double> q = q_;
    for (std::size_t i = 0; i < start.acceleration.size(); ++i)
      v_[i] -= h / 2 * start.acceleration[i];
    for (std::size_t i = 0; i < q.size(); ++i) q[i] -= h * v_[i];
    addProduct(model.jump, q, jump_);
    for (PetscInt row = 0; row < m; row += model.dimension)
      stiffness_.push_back(1 / solver_.w()(row, row));
    state_.time = -h;
  }

  void step() override {
    const PetscInt k = model_.modes(), m = model_.rows();
    updateFriction();
    // What acts on the boundary beside the contact forces, and these as the last two steps
    // continue.
    std::vector<double> guess(m), load(m);
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
    std::vector<double> carried(m), jump(m);
    addProduct(model_.jump, q_, carried);
    addProduct(solver_.w(), load, jump);
    increments_.resize(m);
    for (PetscInt i = 0; i < m; ++i) {
      jump[i] += carried[i];
      increments_[i] = jump[i] + (isNormal(i) ? steadyGap_[i] : h_ * steadyVelocity_[i] - jump_[i]);
    }
    before_ = std::exchange(state_.force, std::move(guess));
    sweeps_ = solver_.solve(friction_, active_, tolerance_, state_.force, increments_);
    std::vector<double> change(m), rate(m), z(m);  // R*, ż
    for (PetscInt i = 0; i < m; ++i) {
      jump[i] = increments_[i] - (isNormal(i) ? steadyGap_[i] : h_ * steadyVelocity_[i] - jump_[i]);
      z[i] = jump[i] - carried[i];
      rate[i] = (z[i] - z_[i]) / h_;
      change[i] = state_.force[i] - steadyForce_[i];
    }
    std::vector<double> damped(m), force(k), mean(k);
    addProduct(model_.boundaryDamping, z, damped);
    addProduct(model_.damping, v_, force, -1);
    addProduct(model_.couplingDamping, rate, force, -1, true);
    std::vector<double> resisting = force;  // of damping
    for (PetscInt i = 0; i < k; ++i) force[i] -= model_.stiffness[i] * q_[i];
    addProduct(model_.couplingStiffness, z, force, -1, true);
    addProduct(model_.jump, change, force, 1, true);
    state_.q = q_;
    double kinetic = 0;
    for (PetscInt i = 0; i < k; ++i) {
      mean[i] = v_[i] + h_ / 2 * force[i];
      kinetic += mean[i] * mean[i] / 2;
      v_[i] += h_ * force[i];
      q_[i] += h_ * v_[i];
    }
    if (!std::isfinite(kinetic))
      throw Error("the motion is no finite number: the time step is too long");
    // Damping works on q and z; what it does to z is C_z ż + C_zq v.
    std::vector<double> onBoundary(m);
    addProduct(model_.couplingDamping, v_, onBoundary);
    for (PetscInt i = 0; i < m; ++i) onBoundary[i] += (damped[i] - damped_[i]) / h_;
    work_.damping += h_ * (dot(rate, onBoundary) - dot(mean, resisting));
    std::vector<double> along(m);  // j v̄ + ż
    addProduct(model_.jump, mean, along);
    for (PetscInt i = 0; i < m; ++i) {
      const double power = change[i] * (along[i] + rate[i]);
      work_.contact += h_ * power;
      work_.moved += h_ * std::abs(power);
      state_.rate.resize(m);
      state_.rate[i] = steadyVelocity_[i] + (jump[i] - jump_[i]) / h_;
      if (!isNormal(i)) work_.friction -= h_ * state_.force[i] * state_.rate[i];
    }
    state_.v = std::move(mean);
    state_.jump = jump;
    state_.kinetic = kinetic;
    state_.time += h_;
    jump_ = std::move(jump), z_ = std::move(z), damped_ = std::move(damped);
  }

 private:
  bool isNormal(PetscInt row) const { return row % model_.dimension == 0; }
  double energy() const override {
    std::vector<double> force(model_.rows());
    addProduct(model_.boundaryStiffness, z_, force, 0.5);
    addProduct(model_.couplingStiffness, state_.q, force);
    double sum = state_.kinetic + dot(force, z_);
    for (PetscInt i = 0; i < model_.modes(); ++i)
      sum += model_.stiffness[i] * state_.q[i] * state_.q[i] / 2;
    return sum;
  }

  double h_;
  StepSolver solver_;
  std::vector<unsigned char> active_;
  std::vector<double> q_, v_;     // q_n and v_{n−1/2} of the next step
  std::vector<double> z_, jump_;  // z and y of the last step
  std::vector<double> damped_;    // C_z z
  std::vector<double> before_;    // R of the step before the last
};

}  // namespace

std::unique_ptr<Scheme> masslessScheme(const ReducedModel& model, const Start& start, double h) {
  return std::make_unique<Massless>(model, start, h);
}

}  // namespace squeal::march
