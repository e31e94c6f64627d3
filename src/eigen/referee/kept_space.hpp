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

/// The problem on V and the products of its couplings, the same on all ranks.
struct ProjectedProblem {
  /// A symmetric or antisymmetric matrix of the problem.
  struct Part {
    int power;  ///< of s
    bool skew;
  };
  proof::Coefficients matrices;  ///< of P_VV
  std::vector<Part> parts;
  /// A_CVᵀ A'_CV of all parts A and A', parts · N × parts · N; empty if V is the whole space.
  linalg::DenseMatrix gram;
  double shift = 0;  ///< σ, rad²/s²
  bool damped = false;

  /// Not collective. Returns the problem with its couplings for regions up to `top`, rad/s.
  proof::KeptProblem kept(double top) const;

 private:
  linalg::DenseMatrix couplingGram(bool transposed) const;
};

/// Borrows the arguments of the constructor except the modes. All functions with arguments are
/// collective.
class KeptSpace {
 public:
  /// Starts with the modes, the static responses to the forces that the terms
  /// SplitProblem::perturbations() exert on them, and `more`, columns with this rank's rows.
  KeptSpace(const SplitProblem& problem, const ShiftedSystem& shifted, const modes::Modes& modes,
            const linalg::DenseView& more);
  PetscInt size() const { return basis_.size(); }
  bool isWhole() const { return basis_.size() == shifted_.system.size(); }
  long solves() const { return basis_.solves(); }

  /// Returns the eigenpairs of the problem on V with the wanted eigenvalues.
  std::vector<linalg::DensePair> pairs(const linalg::EigenvalueFilter& wanted) const;
  /// Adds the corrections K0⁻¹ P(s) x and K0⁻¹ P(s)ᴴ y of these pairs, except those that are much
  /// smaller than others.
  void correct(const std::vector<linalg::DensePair>& pairs);

  /// Returns the problem on V and its couplings to C. Releases the products, so that pairs() and
  /// correct() must not be called afterwards.
  ProjectedProblem problem();
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
  void appendLarge(const linalg::Block& parts, linalg::Block& residuals) const;
  linalg::DenseMatrix sum(int power) const;

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
