// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Derivatives of eigenvalues from left and right vectors [M.46],
///   ds/dθ = −yᴴ (∂P/∂θ)(s) x / yᴴ P′(s) x,   P′ = dP/ds = 2 s M̄ + Z̄.
/// The functions here compute the parts that depend only on the pencil.
#include <string>
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::sensitivity {

/// An eigenvalue with its right and left vector, both borrowed.
struct EigenTriple {
  Complex s;
  const linalg::ComplexVector& x;  ///< right vector in the unknowns
  const linalg::ComplexVector& y;  ///< left vector in the unknowns
};

/// Collective. Returns yᴴ P′(s) x.
Complex slopeForm(const pencil::Pencil& pencil, const sweep::Parameters& at,
                  const EigenTriple& triple);
/// Collective. Returns yᴴ (∂P/∂θ)(s) x for θ = `parameter`, from the derivatives of the
/// coefficients of the terms with respect to θ.
Complex parameterForm(const pencil::Pencil& pencil, const sweep::Parameters& at,
                      const EigenTriple& triple, double sweep::Parameters::*parameter);
/// Collective. Returns the condition number [M.50] for Sensitivity::condition. `slope` is yᴴ P′(s)
/// x, and `mass` is M0.
double condition(const EigenTriple& triple, Complex slope, Mat mass);

}  // namespace squeal::sensitivity
