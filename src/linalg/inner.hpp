#pragma once
/// One solver as the preconditioner of another.
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// `solver` is preconditioned by `inner`, which it borrows.
void preconditionBy(KSP solver, KSP inner);

}  // namespace squeal::linalg
