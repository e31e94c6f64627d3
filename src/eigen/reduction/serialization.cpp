// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/serialization.hpp"

#include "algebra/linalg/serialization.hpp"

namespace squeal::reduction {

// These list all members: a new one does not compile until it is added here.

void fields(Stream& stream, PairErrors& errors) {
  auto& [backward, right, left, roundOff, dense, isRoundOff] = errors;
  stream(backward, right, left, roundOff, dense, isRoundOff);
}

void fields(Stream& stream, PointSolution& solution) {
  auto& [norms, spectrum, errors, symmetry] = solution;
  auto& [band, guard, improved] = spectrum;
  stream(norms, band, guard, improved, errors, symmetry);
}

}  // namespace squeal::reduction
