// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/check.hpp"
#include "regime/march/products.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::march {
namespace {

/// The matrices of the model in x = (q, z).
struct WholeModel {
  DenseMatrix mass, damping, stiffness;
  DenseMatrix jumps;  // Jᵀ, with zeros for the rows that do not move
};

/// Returns a matrix of x without its modal block.
DenseMatrix whole(const ReducedModel& model, const DenseMatrix& boundary,
                  const DenseMatrix& coupling) {
  const PetscInt k = model.modes(), m = model.rows();
  DenseMatrix result(k + m, k + m);
  for (PetscInt i = 0; i < m; ++i) {
    for (PetscInt j = 0; j < m; ++j) result(k + i, k + j) = boundary(i, j);
    for (PetscInt j = 0; j < k; ++j) result(k + i, j) = result(j, k + i) = coupling(i, j);
  }
  return result;
}

WholeModel wholeModel(const ReducedModel& model) {
  const PetscInt k = model.modes(), m = model.rows();
  WholeModel result{.mass = whole(model, model.boundaryMass, DenseMatrix(m, k)),
                    .damping = whole(model, model.boundaryDamping, model.couplingDamping),
                    .stiffness = whole(model, model.boundaryStiffness, model.couplingStiffness),
                    .jumps = DenseMatrix(k + m, m)};
  for (PetscInt i = 0; i < k; ++i) {
    result.stiffness(i, i) = model.stiffness[i];
    result.mass(i, i) = 1;
    for (PetscInt j = 0; j < k; ++j) result.damping(i, j) = model.damping(i, j);
  }
  for (PetscInt i = 0; i < m; ++i) {
    if (!model.moves[i]) continue;
    for (PetscInt j = 0; j < k; ++j) result.jumps(j, i) = model.jump(i, j);
    result.jumps(k + i, i) = 1;
  }
  return result;
}

/// Returns θ, [entry of x]: 1/2 with mass, 1 without.
std::vector<double> thetaOf(const ReducedModel& model) {
  std::vector<double> theta(model.modes(), 0.5);
  for (PetscInt i = 0; i < model.rows(); ++i)
    theta.push_back(model.boundaryMass(i, i) > 0 ? 0.5 : 1);
  return theta;
}

/// Returns A⁻¹ with A_ij = M_ij + h max(θ_i, θ_j) C_ij + h² θ_i θ_j K_ij.
DenseMatrix inverseOf(const WholeModel& model, const std::vector<double>& theta, double h) {
  const PetscInt order = std::ssize(theta);
  DenseMatrix a = model.mass, inverse = linalg::identity(order);
  for (PetscInt j = 0; j < order; ++j)
    for (PetscInt i = 0; i < order; ++i)
      a(i, j) += h * std::max(theta[i], theta[j]) * model.damping(i, j) +
                 h * h * theta[i] * theta[j] * model.stiffness(i, j);
  linalg::Lu<double>(std::move(a)).solve(inverse);
  return linalg::symmetricPart(inverse);
}

/// Returns W = h² J A⁻¹ Jᵀ.
DenseMatrix complianceOf(const DenseMatrix& inverse, const DenseMatrix& jumps, double h) {
  DenseMatrix w = linalg::symmetricPart(linalg::congruent(inverse, jumps));
  for (double& entry : w.entries()) entry *= h * h;
  return w;
}

/// Returns a followed by b.
std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The scheme of Moreau and Jean [M.73] in x = (q, z) with M, C, K and the jump J x = j q + z:
///   M (v_{n+1} − v_n) + h C v_θ + h K x_θ = h Jᵀ R*,   x_{n+1} = x_n + h v_θ,
/// with θ = 1/2 for entries with mass and θ = 1 for entries without.
class Moreau : public Scheme {
 public:
  Moreau(const ReducedModel& model, const Start& start, double h)
      : Scheme(model),
        h_(h),
        order_(model.modes() + model.rows()),
        theta_(thetaOf(model)),
        whole_(wholeModel(model)),
        inverse_(inverseOf(whole_, theta_, h)),
        solver_(complianceOf(inverse_, whole_.jumps, h), model.dimension, model.moves),
        x_(joined(start.q, start.z)),
        v_(joined(start.v, start.zRate)) {
    for (PetscInt row = 0; row < model.rows(); row += model.dimension)
      stiffness_.push_back(1 / solver_.w()(row, row));
    state_.jump = jumpOf(x_);
    state_.rate = jumpOf(v_);
    for (PetscInt i = 0; i < model.rows(); ++i) state_.rate[i] += steadyVelocity_[i];
  }

  void step() override {
    updateFriction();
    active_ = activeNodes();
    std::vector<double> v = predict();
    solveContact(v);
    addWork(update(v), v);
    finish(std::move(v));
  }

 private:
  /// Returns the load M v_n − h C (1 − θ) v_n − h K x_θ, with x_θ without v_{n+1}.
  std::vector<double> load() const {
    std::vector<double> ahead(order_), load(order_);  // x_θ
    for (PetscInt i = 0; i < order_; ++i) {
      ahead[i] = x_[i] + h_ * theta_[i] * (1 - theta_[i]) * v_[i];
      if (theta_[i] == 1) ahead[i] = x_[i];
    }
    addProduct(whole_.mass, v_, load);
    addProduct(whole_.stiffness, ahead, load, -h_);
    // A row without mass uses the modes at the end of the step.
    std::vector<double> modal(order_), old(order_);
    for (PetscInt i = 0; i < order_; ++i)
      if (theta_[i] < 1) modal[i] = h_ * 0.5 * 0.5 * v_[i];
    for (PetscInt i = 0; i < order_; ++i) old[i] = (1 - theta_[i]) * v_[i];
    std::vector<double> resisting(order_), further(order_);
    addProduct(whole_.damping, old, resisting, -h_);
    addProduct(whole_.stiffness, modal, further, -h_);
    for (PetscInt i = 0; i < order_; ++i) {
      if (theta_[i] < 1)
        load[i] += resisting[i];
      else
        load[i] += further[i];
    }
    return load;
  }

  /// Returns the nodes that may be in contact, [node]: with mass, nodes whose gap closes.
  std::vector<unsigned char> activeNodes() const {
    std::vector<unsigned char> active(model_.nodes.size(), 1);
    for (std::size_t node = 0; node < active.size(); ++node) {
      const PetscInt row = node * model_.dimension;
      const double gap = steadyGap_[row] + state_.jump[row];
      active[node] = massless(row) || gap + h_ / 2 * state_.rate[row] <= 0;
    }
    return active;
  }

  /// Returns v_{n+1} for the contact forces of the last step, and sets d = b + W R for them.
  std::vector<double> predict() {
    const PetscInt m = model_.rows();
    std::vector<double> force(m);  // R*
    for (PetscInt i = 0; i < m; ++i) {
      if (!active_[i / model_.dimension]) state_.force[i] = 0;
      force[i] = state_.force[i] - steadyForce_[i];
    }
    std::vector<double> all = load(), v(order_);
    addProduct(whole_.jumps, force, all, h_);
    addProduct(inverse_, all, v);
    increments_ = jumpOf(v);
    for (PetscInt i = 0; i < m; ++i) {
      increments_[i] = h_ * (increments_[i] + steadyVelocity_[i]);
      if (isNormal(i) && massless(i)) increments_[i] += steadyGap_[i] + state_.jump[i];
    }
    guess_ = state_.force;
    return v;
  }

  /// Solves for the contact forces, and corrects v_{n+1}.
  void solveContact(std::vector<double>& v) {
    sweeps_ =
        solver_.solve(friction_, active_, tolerance_, state_.force, increments_, stopRequested_);
    std::vector<double> change(model_.rows()), correction(order_);
    for (PetscInt i = 0; i < model_.rows(); ++i) change[i] = state_.force[i] - guess_[i];
    addProduct(whole_.jumps, change, correction, h_);
    addProduct(inverse_, correction, v);
  }

  /// Integrates x, and returns v_θ.
  std::vector<double> update(const std::vector<double>& v) {
    std::vector<double> mean(order_);
    for (PetscInt i = 0; i < order_; ++i) {
      mean[i] = theta_[i] * v[i] + (1 - theta_[i]) * v_[i];
      x_[i] += h_ * mean[i];
    }
    return mean;
  }

  /// Adds the work of the step, and sets the velocities of the contact.
  void addWork(const std::vector<double>& mean, const std::vector<double>& v) {
    std::vector<double> drag(order_);
    addProduct(whole_.damping, mean, drag);
    work_.damping += h_ * dot(mean, drag);
    const std::vector<double> along = jumpOf(mean);
    state_.rate = jumpOf(v);
    for (PetscInt i = 0; i < model_.rows(); ++i) {
      const double power = (state_.force[i] - steadyForce_[i]) * along[i];
      work_.contact += h_ * power;
      work_.moved += h_ * std::abs(power);
      state_.rate[i] += steadyVelocity_[i];
      if (!isNormal(i)) work_.friction -= h_ * state_.force[i] * (along[i] + steadyVelocity_[i]);
    }
  }

  /// Stores the motion at the end of the step.
  void finish(std::vector<double> v) {
    const PetscInt k = model_.modes();
    // A node that was not active has the defect of its gap.
    for (PetscInt i = 0; i < model_.rows(); i += model_.dimension)
      if (!active_[i / model_.dimension])
        increments_[i] = std::max(0.0, steadyGap_[i] + state_.jump[i]);
    v_ = std::move(v);
    state_.jump = jumpOf(x_);
    state_.q.assign(x_.begin(), x_.begin() + k);
    state_.v.assign(v_.begin(), v_.begin() + k);
    std::vector<double> momentum(order_);
    addProduct(whole_.mass, v_, momentum);
    state_.kinetic = dot(momentum, v_) / 2;
    if (!std::isfinite(state_.kinetic))
      throw Error("the motion is not finite: reduce the time step");
    state_.time += h_;
  }

  double energy() const override {
    std::vector<double> force(order_);
    addProduct(whole_.stiffness, x_, force);
    return state_.kinetic + dot(force, x_) / 2;
  }
  std::vector<double> jumpOf(const std::vector<double>& x) const {
    std::vector<double> jump(model_.rows());
    addProduct(whole_.jumps, x, jump, 1, true);
    return jump;
  }
  bool massless(PetscInt row) const { return theta_[model_.modes() + row] == 1; }

  double h_;
  PetscInt order_;
  std::vector<double> theta_;  // [entry of x]
  WholeModel whole_;
  DenseMatrix inverse_;
  StepSolver solver_;
  std::vector<double> x_, v_;
  std::vector<double> guess_;          // R at the start of the solution of a step
  std::vector<unsigned char> active_;  // [node] of the step
};

}  // namespace

std::unique_ptr<Scheme> moreauScheme(const ReducedModel& model, const Start& start, double h) {
  return std::make_unique<Moreau>(model, start, h);
}

}  // namespace squeal::march
