// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The lines that a run prints about the eigenvalues of a point. Not collective.
#include <string>

#include "eigen/pencil/complex_modes.hpp"

namespace squeal::sweep_solver {

/// Returns one line: the parameters of the point, the number of eigenvalues by verdict, the band
/// and the errors.
std::string pointText(const pencil::ComplexModes& point);

/// Returns one line: the result of the completeness proof for the list of the point.
std::string completenessText(const pencil::ComplexModes& point);

/// Throws Error if an eigenvalue is not finite: overflow in the eigenvalue problems must not reach
/// the results.
void requireFiniteEigenvalues(const pencil::ComplexModes& point);

}  // namespace squeal::sweep_solver
