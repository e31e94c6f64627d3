#pragma once
/// Complex vectors of a real build.
#include <complex>

#include "petsc/owned.hpp"

namespace squeal::linalg {

struct ComplexVector {
  OwnedVec real, imaginary;

  /// Collective. Laid out like `vector`, zero.
  static ComplexVector like(Vec vector);
  /// Collective.
  static ComplexVector copied(Vec real, Vec imaginary);
};

/// Collective. uᴴ v.
std::complex<double> dot(const ComplexVector& u, const ComplexVector& v);
/// Collective. v += a u.
void add(ComplexVector& v, std::complex<double> a, const ComplexVector& u);
/// Collective. A u; `transposed`: Aᵀ u.
ComplexVector product(Mat a, const ComplexVector& u, bool transposed = false);
/// Collective.
double length(const ComplexVector& u);

}  // namespace squeal::linalg
