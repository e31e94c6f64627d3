#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/check.hpp"
#include "regime/march/products.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::march {
namespace {

/// The scheme of Moreau and Jean [M.73] in x = (q, z) with M, C, K and the jump J x = j q + z:
///   M (v_{n+1} − v_n) + h C v_θ + h K x_θ = h Jᵀ R*,   x_{n+1} = x_n + h v_θ,
/// with θ = 1/2 for what has mass and θ = 1 for what has none.
class Moreau : public Scheme {
 public:
  Moreau(const ReducedModel& model, const Start& start, double h)
      : Scheme(model), h_(h), order_(model.modes() + model.rows()), x_(start.q), v_(start.v) {
    x_.insert(x_.end(), start.z.begin(), start.z.end());
    v_.insert(v_.end(), start.zRate.begin(), start.zRate.end());
    const PetscInt k = model.modes(), m = model.rows();
    for (PetscInt i = 0; i < k; ++i) theta_.push_back(0.5);
    for (PetscInt i = 0; i < m; ++i) theta_.push_back(model.boundaryMass(i, i) > 0 ? 0.5 : 1);
    stiff_ = whole(model.boundaryStiffness, model.couplingStiffness);
    damping_ = whole(model.boundaryDamping, model.couplingDamping);
    mass_ = DenseMatrix(order_, order_);
    for (PetscInt i = 0; i < k; ++i) {
      stiff_(i, i) = model.stiffness[i];
      mass_(i, i) = 1;
      for (PetscInt j = 0; j < k; ++j) damping_(i, j) = model.damping(i, j);
    }
    for (PetscInt i = 0; i < m; ++i)
      for (PetscInt j = 0; j < m; ++j) mass_(k + i, k + j) = model.boundaryMass(i, j);
    DenseMatrix a = mass_;
    for (PetscInt j = 0; j < order_; ++j)
      for (PetscInt i = 0; i < order_; ++i)
        a(i, j) += h * std::max(theta_[i], theta_[j]) * damping_(i, j) +
                   h * h * theta_[i] * theta_[j] * stiff_(i, j);
    inverse_ = DenseMatrix(order_, order_);
    for (PetscInt i = 0; i < order_; ++i) inverse_(i, i) = 1;
    linalg::Lu<double>(std::move(a)).solve(inverse_);
    inverse_ = linalg::symmetricPart(inverse_);
    // h² J A⁻¹ Jᵀ.
    DenseMatrix jumps(order_, m);  // Jᵀ
    for (PetscInt i = 0; i < m; ++i) {
      if (!model.moves[i]) continue;
      for (PetscInt j = 0; j < k; ++j) jumps(j, i) = model.jump(i, j);
      jumps(k + i, i) = 1;
    }
    DenseMatrix w = linalg::symmetricPart(linalg::congruent(inverse_, jumps));
    for (double& entry : w.entries()) entry *= h * h;
    jumps_ = std::move(jumps);
    solver_.emplace(std::move(w), model.dimension, model.moves);
    for (PetscInt row = 0; row < m; row += model.dimension)
      stiffness_.push_back(1 / solver_->w()(row, row));
    state_.jump = jumpOf(x_);
    state_.rate = jumpOf(v_);
    for (PetscInt i = 0; i < m; ++i) state_.rate[i] += steadyVelocity_[i];
  }

  void step() override {
    const PetscInt k = model_.modes(), m = model_.rows(), dimension = model_.dimension;
    updateFriction();
    std::vector<double> ahead(order_), load(order_);  // x_θ and v_θ without v_{n+1}
    for (PetscInt i = 0; i < order_; ++i) {
      ahead[i] = x_[i] + h_ * theta_[i] * (1 - theta_[i]) * v_[i];
      if (theta_[i] == 1) ahead[i] = x_[i];
    }
    addProduct(mass_, v_, load);
    addProduct(stiff_, ahead, load, -h_);
    // A row without mass meets the modes at the end of the step.
    std::vector<double> modal(order_), old(order_);
    for (PetscInt i = 0; i < order_; ++i)
      if (theta_[i] < 1) modal[i] = h_ * 0.5 * 0.5 * v_[i];
    for (PetscInt i = 0; i < order_; ++i) old[i] = (1 - theta_[i]) * v_[i];
    std::vector<double> resisting(order_), further(order_);
    addProduct(damping_, old, resisting, -h_);
    addProduct(stiff_, modal, further, -h_);
    for (PetscInt i = 0; i < order_; ++i) {
      if (theta_[i] < 1)
        load[i] += resisting[i];
      else
        load[i] += further[i];
    }
    std::vector<double> force(m), guess(m);
    std::vector<unsigned char> active(model_.nodes.size(), 1);
    for (std::size_t node = 0; node < active.size(); ++node) {
      const PetscInt row = node * dimension;
      const double gap = steadyGap_[row] + state_.jump[row];
      active[node] = theta_[k + row] == 1 || gap + h_ / 2 * state_.rate[row] <= 0;
      if (!active[node]) continue;
      for (int c = 0; c < dimension; ++c) guess[row + c] = state_.force[row + c];
    }
    for (PetscInt i = 0; i < m; ++i) force[i] = guess[i] - steadyForce_[i];
    addProduct(jumps_, force, load, h_);
    std::vector<double> v(order_);
    addProduct(inverse_, load, v);
    increments_ = jumpOf(v);
    for (PetscInt i = 0; i < m; ++i) {
      increments_[i] = h_ * (increments_[i] + steadyVelocity_[i]);
      if (i % dimension == 0 && theta_[k + i] == 1)
        increments_[i] += steadyGap_[i] + state_.jump[i];
    }
    state_.force = guess;
    sweeps_ = solver_->solve(friction_, active, tolerance_, state_.force, increments_, stopAsked_);
    for (PetscInt i = 0; i < m; ++i) force[i] = state_.force[i] - guess[i];
    std::vector<double> correction(order_);
    addProduct(jumps_, force, correction, h_);
    addProduct(inverse_, correction, v);
    std::vector<double> mean(order_), drag(order_);
    for (PetscInt i = 0; i < order_; ++i) {
      mean[i] = theta_[i] * v[i] + (1 - theta_[i]) * v_[i];
      x_[i] += h_ * mean[i];
    }
    addProduct(damping_, mean, drag);
    work_.damping += h_ * dot(mean, drag);
    const std::vector<double> along = jumpOf(mean);
    state_.rate = jumpOf(v);
    for (PetscInt i = 0; i < m; ++i) {
      const double power = (state_.force[i] - steadyForce_[i]) * along[i];
      work_.contact += h_ * power;
      work_.moved += h_ * std::abs(power);
      state_.rate[i] += steadyVelocity_[i];
      if (i % dimension > 0)
        work_.friction -= h_ * state_.force[i] * (along[i] + steadyVelocity_[i]);
      // The defect knows which gaps were open.
      if (i % dimension == 0 && !active[i / dimension])
        increments_[i] = std::max(0.0, steadyGap_[i] + state_.jump[i]);
    }
    v_ = std::move(v);
    state_.jump = jumpOf(x_);
    state_.q.assign(x_.begin(), x_.begin() + k);
    state_.v.assign(v_.begin(), v_.begin() + k);
    std::vector<double> momentum(order_);
    addProduct(mass_, v_, momentum);
    state_.kinetic = dot(momentum, v_) / 2;
    if (!std::isfinite(state_.kinetic))
      throw Error("the motion is not finite: the time step is too long");
    state_.time += h_;
  }

 private:
  double energy() const override {
    std::vector<double> force(order_);
    addProduct(stiff_, x_, force);
    return state_.kinetic + dot(force, x_) / 2;
  }
  DenseMatrix whole(const DenseMatrix& boundary, const DenseMatrix& coupling) const {
    const PetscInt k = model_.modes(), m = model_.rows();
    DenseMatrix result(order_, order_);
    for (PetscInt i = 0; i < m; ++i) {
      for (PetscInt j = 0; j < m; ++j) result(k + i, k + j) = boundary(i, j);
      for (PetscInt j = 0; j < k; ++j) result(k + i, j) = result(j, k + i) = coupling(i, j);
    }
    return result;
  }
  std::vector<double> jumpOf(const std::vector<double>& x) const {
    std::vector<double> jump(model_.rows());
    addProduct(jumps_, x, jump, 1, true);
    return jump;
  }

  double h_;
  PetscInt order_;
  std::vector<double> theta_;  // [entry of x]
  DenseMatrix mass_, damping_, stiff_, inverse_, jumps_;
  std::optional<StepSolver> solver_;
  std::vector<double> x_, v_;
};

}  // namespace

std::unique_ptr<Scheme> moreauScheme(const ReducedModel& model, const Start& start, double h) {
  return std::make_unique<Moreau>(model, start, h);
}

}  // namespace squeal::march
