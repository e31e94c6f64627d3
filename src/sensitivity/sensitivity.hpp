#pragma once
/// Derivatives of eigenvalues by left and right vectors, on the pencil alone: ds/dθ = −yᴴ
/// (∂P/∂θ)(s) x / yᴴ P′(s) x, with P′ = dP/ds = 2 s M̄ + Z̄.
#include <complex>
#include <string>
#include <vector>

#include "linalg/complexvector.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sweep/parameters.hpp"

namespace squeal::sensitivity {

struct EigenTriple {
  std::complex<double> s;
  const linalg::ComplexVector& x;  ///< right vector, in the unknowns
  const linalg::ComplexVector& y;  ///< left vector
};

/// `-flutter_sensitivities`.
bool sensitivitiesWanted();

/// Collective. yᴴ P′(s) x.
std::complex<double> slopeForm(const pencil::Pencil& pencil, const sweep::Parameters& at,
                               const EigenTriple& triple);
/// Collective. yᴴ (∂P/∂θ)(s) x as far as the coefficients of the terms hold θ.
std::complex<double> parameterForm(const pencil::Pencil& pencil, const sweep::Parameters& at,
                                   const EigenTriple& triple, double sweep::Parameters::*parameter);
/// Collective. Sensitivity::condition for the given yᴴ P′(s) x, in the norm of the mass M0.
double condition(const EigenTriple& triple, std::complex<double> slope, Mat mass);

}  // namespace squeal::sensitivity
