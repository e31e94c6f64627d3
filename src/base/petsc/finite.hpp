// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Rejects inf and nan: an overflow must not reach a result.
#include <petscmat.h>

#include <string>

namespace squeal {

/// Collective. Throws Error if (factor · norm)² is not finite, for example because an entry is inf
/// or nan. The norm is the Frobenius norm of the matrix or the 2-norm of the vector. The message
/// begins with `what`. A null matrix or vector passes.
void requireFinite(Mat matrix, const std::string& what, double factor = 1);
void requireFinite(Vec vector, const std::string& what, double factor = 1);

}  // namespace squeal
