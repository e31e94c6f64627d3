#pragma once
/// The scheme of the massless boundary [M.72]: the leapfrog rule for q, the backward Euler rule for
/// z. Its step is a map of what one step hands on to the next, and the derivative of this map is
/// known: periodic motions and their stability follow from it.
#include <vector>

#include "regime/march/contact_forces.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::march {

/// A step hands these on to the next one: q_n, v_{n−1/2} and z_{n−1}.
struct Handed {
  std::vector<double> q, v, z;
};
/// Returns what a step of length h finds at the start of a march.
Handed handedAt(const Start& start, double h);

/// Columns of variations of Handed.
struct Variations {
  DenseMatrix q, v, z;  ///< modes × columns, modes × columns, rows × columns
};

/// In step n,
///   K_z z_n + C_z (z_n − z_{n−1})/h + K_zq q_n + C_zq v_{n−1/2} = R*_n,   y_n = j q_n + z_n,
/// with contact and friction for y_n and y_n − y_{n−1};
/// then, with v̄_n = (v_{n−1/2} + v_{n+1/2})/2,
///   v_{n+1/2} = v_{n−1/2} + h (jᵀR*_n − Λ q_n − C v̄_n − K_zqᵀ z_n − C_zqᵀ ż_n),
///   q_{n+1} = q_n + h v_{n+1/2}.
class Massless : public Scheme {
 public:
  /// The model is borrowed; h is the step, s.
  Massless(const ReducedModel& model, const Handed& handed, double h);
  void step() override;
  double energy() const override;

  /// Returns what the last step hands on.
  Handed handed() const { return {q_, v_, z_}; }
  /// Lets the contact forces of a step hold to this part of the mean steady force.
  void setAccuracy(double relative);
  /// Returns the slips that stuck in the last step, [row].
  std::vector<unsigned char> stuck() const;
  /// Replaces variations of what went into the last step by those of what it hands on, with each
  /// node open, sticking or sliding as it was. The coefficients of friction stay.
  void propagate(Variations& x) const;

 private:
  bool isNormal(PetscInt row) const { return row % model_.dimension == 0; }
  bool sticks(std::size_t node) const;
  DenseMatrix forceVariations(const DenseMatrix& increments) const;

  double h_;
  StepSolver solver_;
  DenseMatrix modalInverse_;  // (1 + h C/2)⁻¹
  std::vector<unsigned char> active_;
  std::vector<double> q_, v_;     // q_n and v_{n−1/2} of the next step
  std::vector<double> z_, jump_;  // z and y of the last step
  std::vector<double> damped_;    // C_z z
  std::vector<double> before_;    // R of the step before the last
};

}  // namespace squeal::march
