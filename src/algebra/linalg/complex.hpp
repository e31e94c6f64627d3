// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The complex type of the whole program, since PETSc is built with real scalars.
#include <cmath>
#include <complex>
#include <span>

#include "base/petsc/check.hpp"

namespace squeal {

using Complex = std::complex<double>;

/// Returns xᴴ y, summed over the entries of x; y may be longer. It multiplies real and imaginary
/// parts explicitly, because the product in the standard library tests each factor for infinities
/// and is slower.
inline Complex innerProduct(std::span<const Complex> x, std::span<const Complex> y) {
  ensure(x.size() <= y.size(), "the second vector is as long as the first");
  double real = 0, imaginary = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    real += x[i].real() * y[i].real() + x[i].imag() * y[i].imag();
    imaginary += x[i].real() * y[i].imag() - x[i].imag() * y[i].real();
  }
  return {real, imaginary};
}

/// Returns the 2-norm.
inline double length(std::span<const Complex> x) { return std::sqrt(innerProduct(x, x).real()); }

}  // namespace squeal
