// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/complexvector.hpp"

#include <cmath>

namespace squeal::linalg {

ComplexVector ComplexVector::like(Vec vector) {
  ComplexVector result;
  for (OwnedVec* part : {&result.real, &result.imaginary}) {
    check(VecDuplicate(vector, part->out()));
    check(VecZeroEntries(*part));
  }
  return result;
}

ComplexVector ComplexVector::copied(Vec real, Vec imaginary) {
  ComplexVector result = like(real);
  check(VecCopy(real, result.real));
  check(VecCopy(imaginary, result.imaginary));
  return result;
}

Complex dot(const ComplexVector& u, const ComplexVector& v) {
  PetscScalar rr = 0, ii = 0, ri = 0, ir = 0;
  check(VecDot(u.real, v.real, &rr));
  check(VecDot(u.imaginary, v.imaginary, &ii));
  check(VecDot(u.real, v.imaginary, &ri));
  check(VecDot(u.imaginary, v.real, &ir));
  return {rr + ii, ri - ir};
}

void add(ComplexVector& v, Complex a, const ComplexVector& u) {
  check(VecAXPY(v.real, a.real(), u.real));
  check(VecAXPY(v.real, -a.imag(), u.imaginary));
  check(VecAXPY(v.imaginary, a.real(), u.imaginary));
  check(VecAXPY(v.imaginary, a.imag(), u.real));
}

ComplexVector product(Mat a, const ComplexVector& u, bool transposed) {
  ComplexVector result;
  const auto multiply = transposed ? MatMultTranspose : MatMult;
  check(MatCreateVecs(a, transposed ? result.real.out() : nullptr,
                      transposed ? nullptr : result.real.out()));
  check(VecDuplicate(result.real, result.imaginary.out()));
  check(multiply(a, u.real, result.real));
  check(multiply(a, u.imaginary, result.imaginary));
  return result;
}

double length(const ComplexVector& u) { return std::sqrt(dot(u, u).real()); }

}  // namespace squeal::linalg
