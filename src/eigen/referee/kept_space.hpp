// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The space V of the proof: free modes, static responses and corrections, with the matrices on it
/// and the Gram matrices of their couplings to the rest.
#include "algebra/linalg/quadratic.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/proof/kept.hpp"
#include "eigen/referee/split_problem.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::referee {

/// Borrows the arguments of the constructor. The methods are collective.
class KeptSpace {
 public:
  /// Starts with the modes and the responses to the other terms on them.
  KeptSpace(const SplitProblem& problem, const ShiftedSystem& shifted, const modes::Modes& modes);
  PetscInt size() const { return basis_.size(); }
  bool isWhole() const { return basis_.size() == shifted_.system.size(); }
  long solves() const { return basis_.solves(); }

  /// Returns the eigenpairs of the problem on V with the wanted eigenvalues.
  std::vector<linalg::DensePair> pairs(const linalg::EigenvalueFilter& wanted) const;
  /// Adds the corrections of these pairs: K0⁻¹ P(s) x and K0⁻¹ P(s)ᴴ y.
  void correct(const std::vector<linalg::DensePair>& pairs);

  /// Returns the problem on V and its couplings, for regions up to `top`, rad/s.
  proof::KeptProblem problem(double top);
  /// Returns the bounds on the rest, after problem(): the first `count` modes, with eigenvalues up
  /// to `last`, are all below θ = `below`.
  proof::LeftOut leftOut(PetscInt count, double last, double below) const;

 private:
  /// A matrix A = c_0 + s c_1 + s² c_2 of parts, transposed with the sign of its symmetry.
  struct Part {
    Mat matrix;
    int power;
    bool skew;
    linalg::Block products;   // A V
    linalg::DenseMatrix onV;  // Vᵀ A V
  };
  void measure();
  linalg::DenseMatrix sum(int power) const;
  linalg::DenseMatrix couplingGram(const linalg::DenseMatrix& gram, bool transposed) const;

  const SplitProblem& problem_;
  const ShiftedSystem& shifted_;
  subspace::Basis basis_;
  linalg::Block v_;       // V, orthonormal in energy
  linalg::Block forces_;  // K0 V
  std::vector<Part> parts_;
  double leak_ = 0;  // ‖M_CY‖ and ‖M_QY‖ of the modes Y
  PetscInt modes_ = 0;
};

}  // namespace squeal::referee
