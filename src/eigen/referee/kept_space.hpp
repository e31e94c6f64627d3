// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The space V of the proof: free modes, static responses and corrections. KeptSpace also computes
/// the projected matrices and their couplings to C, the orthogonal complement of V in energy.
#include "algebra/linalg/quadratic.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/proof/kept.hpp"
#include "eigen/referee/split_problem.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::referee {

/// Borrows the arguments of the constructor except the modes. All functions with arguments are
/// collective.
class KeptSpace {
 public:
  /// Starts with the modes and the static responses to the forces that the terms
  /// SplitProblem::perturbations() exert on them.
  KeptSpace(const SplitProblem& problem, const ShiftedSystem& shifted, const modes::Modes& modes);
  PetscInt size() const { return basis_.size(); }
  bool isWhole() const { return basis_.size() == shifted_.system.size(); }
  long solves() const { return basis_.solves(); }

  /// Returns the eigenpairs of the problem on V with the wanted eigenvalues.
  std::vector<linalg::DensePair> pairs(const linalg::EigenvalueFilter& wanted) const;
  /// Adds the corrections of these pairs: K0⁻¹ P(s) x and K0⁻¹ P(s)ᴴ y.
  void correct(const std::vector<linalg::DensePair>& pairs);

  /// Returns the problem on V and its couplings to C, for regions up to `top`, rad/s.
  proof::KeptProblem problem(double top);
  /// Returns the bounds on C; call it after problem(). The pencil (K0, M) has `count` eigenvalues
  /// below θ = `below`: those of the first `count` modes. The largest of them is `last`.
  proof::LeftOut leftOut(PetscInt count, double last, double below) const;

 private:
  /// A symmetric or antisymmetric matrix A of the problem, with its power of s.
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
  double leak_ = 0;  // norm of the coupling by M between the modes and all other vectors
  PetscInt modes_ = 0;
};

}  // namespace squeal::referee
