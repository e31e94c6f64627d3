#pragma once
/// Left eigenvectors of the full-order problem, yᴴ P(s) = 0, for eigenvalues that are known.
#include <complex>
#include <vector>

#include "linalg/complexvector.hpp"
#include "linalg/dense.hpp"
#include "pencil/pencil.hpp"
#include "sweep/parameters.hpp"

namespace squeal::sensitivity {

/// An eigenvalue and its right vector, in the unknowns.
struct RightPair {
  std::complex<double> s;
  const linalg::ComplexVector* vector;  ///< borrowed
};

struct LeftVector {
  linalg::ComplexVector y;  ///< in the unknowns, 2-norm 1
  double backwardError = 0;  ///< ‖P(s)ᴴ y‖ / ((|s|² ‖M̄‖ + |s| ‖Z̄‖ + ‖K̄‖) ‖y‖)
};

/// Where the search begins.
struct StartSpace {
  OwnedBV columns;      ///< V: the free modes, or the basis of the reduced problem
  Mat inner = nullptr;  ///< the matrix in which V is (all but) orthonormal: M0 or K0; borrowed
  linalg::DenseProblem projected;  ///< Vᵀ P V at the point, if at hand: it saves products of the
                                   ///< size of V; otherwise m = 0
};

/// Collective. Rayleigh–Ritz on V, the right vectors, and K0⁻¹ (Re l, Im l) of the left residuals l
/// = P(s)ᴴ y of all pairs, solved for together by `solver` (of K0): about a decade a round, until
/// the backward error is below 1e-10 or corrections bring nothing new. The caller judges the error
/// that is left.
std::vector<LeftVector> leftVectors(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                    const StartSpace& start, KSP solver,
                                    const std::vector<RightPair>& pairs);

}  // namespace squeal::sensitivity
