// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The scheme of the massless boundary [M.72]: the leapfrog rule for q, the backward Euler rule for
/// z. A step maps its initial state to that of the next step. Periodic motions and their stability
/// are computed from the derivative of this map.
#include <vector>

#include "base/checkpoint/archive.hpp"
#include "regime/march/contact_forces.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::march {

/// The state from which step n starts: q_n, v_{n−1/2} and z_{n−1}.
struct InitialState {
  std::vector<double> q, v, z;
};
/// Writes or reads the state.
void fields(Stream& stream, InitialState& state);
/// Returns the initial state of the first step, of length h.
InitialState initialStateAt(const Start& start, double h);

/// Variations of an InitialState, one per column.
struct Variations {
  DenseMatrix q, v, z;  ///< modes × columns, modes × columns, rows × columns
};

/// In step n,
///   K_z z_n + C_z (z_n − z_{n−1})/h + K_zq q_n + C_zq v_{n−1/2} = R*_n,   y_n = j q_n + z_n,
/// where contact and friction impose conditions on y_n and y_n − y_{n−1}. Then
///   v̄_n = (v_{n−1/2} + v_{n+1/2})/2,
///   v_{n+1/2} = v_{n−1/2} + h (jᵀR*_n − Λ q_n − C v̄_n − K_zqᵀ z_n − C_zqᵀ ż_n),
///   q_{n+1} = q_n + h v_{n+1/2}.
class Massless : public Scheme {
 public:
  /// Borrows the model. h is the time step, s. The swept coefficient of friction is that of the
  /// model plus `sweptChange`.
  Massless(const ReducedModel& model, const InitialState& initial, double h,
           double sweptChange = 0);
  void step() override;
  double energy() const override;

  /// Returns the initial state of the next step.
  InitialState next() const { return {q_, v_, z_}; }
  /// Sets the accuracy of the contact forces of a step, relative to the mean normal force of steady
  /// sliding.
  void setAccuracy(double relative);
  /// Returns 1 for each slip that stuck in the last step, otherwise 0, [row].
  std::vector<unsigned char> stuck() const;
  /// Maps variations of the initial state of the last step to the resulting variations of the
  /// initial state of the next one. The variations are assumed to change neither the state of a
  /// node (open, sticking or sliding) nor its coefficient of friction.
  void propagate(Variations& x) const;

 private:
  struct StepArrays;
  StepArrays predict();
  void solveContact(StepArrays& step);
  void update(StepArrays& step);
  void addWork(const StepArrays& step);
  void finish(StepArrays step);
  double known(PetscInt i) const;
  bool sticks(std::size_t node) const;
  std::vector<PetscInt> loadedRows() const;
  void setSlidingRow(PetscInt i, const std::vector<PetscInt>& rows, const DenseMatrix& b,
                     DenseMatrix& a, DenseMatrix& right) const;
  DenseMatrix forceVariations(const DenseMatrix& increments) const;

  double h_;
  StepSolver solver_;
  DenseMatrix modalInverse_;  // (1 + h C/2)⁻¹
  std::vector<unsigned char> active_;
  std::vector<double> q_, v_;     // q_n and v_{n−1/2}, with n the next step
  std::vector<double> z_, jump_;  // z and y of the last step
  std::vector<double> damped_;    // C_z z
  std::vector<double> before_;    // R of the step before the last one
};

}  // namespace squeal::march
