#pragma once
/// These functions reject inf and nan: products that overflow must not reach a result.
#include <petscmat.h>

#include <string>

namespace squeal {

/// Collective. Throws Error if the Frobenius norm of the matrix (the 2-norm of the vector) times
/// `factor`, or its square, is not a finite number, as where an entry is inf or nan. `what` begins
/// the message. A null matrix or vector passes.
void requireFinite(Mat matrix, const std::string& what, double factor = 1);
void requireFinite(Vec vector, const std::string& what, double factor = 1);

}  // namespace squeal
