#pragma once
/// Numbers that are none: products that overflow must not reach a result.
#include <petscmat.h>

#include <string>

namespace squeal::linalg {

/// Collective. Error if an entry times `factor` is inf or nan, or so large that its square is;
/// `what` begins the message. A null matrix or vector passes.
void requireFinite(Mat matrix, const std::string& what, double factor = 1);
void requireFinite(Vec vector, const std::string& what, double factor = 1);

}  // namespace squeal::linalg
