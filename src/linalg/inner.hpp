#pragma once
/// Use of one solver as the preconditioner of another.
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// Collective. Makes `inner` the preconditioner of `solver`, which borrows it: `inner` must outlive
/// the solves of `solver`.
void preconditionBy(KSP solver, KSP inner);

}  // namespace squeal::linalg
