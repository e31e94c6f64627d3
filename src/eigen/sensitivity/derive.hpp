// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sensitivities of the stored complex modes of a point.
#include <functional>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/left.hpp"
#include "eigen/sensitivity/sensitivity.hpp"

namespace squeal::sensitivity {

/// Returns the forms yᴴ (∂P/∂θ)(s) x of one eigenvalue, in the member `value` of each derivative.
using Forms = std::function<std::vector<pencil::Derivative>(const EigenTriple&)>;

/// Collective. Appends to ComplexModes::sensitivities an entry for each shape of the point.
/// `pencil` contains the terms of the point. It first computes left vectors, starting in `start`,
/// with the solver of `system`. The derivatives, if they exist, are the forms divided by −yᴴ P′ x
/// [M.46]. Borrows the arguments only during this call.
void deriveShapes(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                  const StartSpace& start, const factor::AssociatedSystem& system,
                  const Forms& forms);

/// Collective. Does the same for friction, speed and damping, if the coefficients of the terms
/// depend on them.
void deriveParameters(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                      const StartSpace& start, const factor::AssociatedSystem& system);

}  // namespace squeal::sensitivity
