// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The matrices of the bodies with their roles in the eigenvalue problem.
#include <vector>

#include "model/contact/coupled.hpp"

namespace squeal::terms {

/// A matrix X of the bodies, projected, with the exponents of s, of the speed and of the damping
/// factor. Borrows the projection.
struct BodyMatrix {
  const contact::Projection& projection;
  int power = 0, speedExponent = 0, dampingExponent = 0;
};

/// Returns K, M, C, G and K^R; some may be empty.
std::vector<BodyMatrix> bodyMatrices(const contact::CoupledSystem& system);

}  // namespace squeal::terms
