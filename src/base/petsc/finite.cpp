// SPDX-License-Identifier: BSD-2-Clause
#include "base/petsc/finite.hpp"

#include <cmath>

#include "base/petsc/check.hpp"

namespace squeal {
namespace {

void requireFiniteNorm(PetscReal norm, const std::string& what) {
  if (!std::isfinite(norm * norm))
    throw Error(what +
                ": an entry is not finite, or its square overflows; check units and magnitudes");
}

}  // namespace

void requireFinite(Mat matrix, const std::string& what, double factor) {
  PetscReal norm = 0;
  if (matrix) check(MatNorm(matrix, NORM_FROBENIUS, &norm));
  requireFiniteNorm(factor * norm, what);
}

void requireFinite(Vec vector, const std::string& what, double factor) {
  PetscReal norm = 0;
  if (vector) check(VecNorm(vector, NORM_2, &norm));
  requireFiniteNorm(factor * norm, what);
}

}  // namespace squeal
