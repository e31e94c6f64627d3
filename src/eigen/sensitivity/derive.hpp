// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions compute the sensitivities of the complex modes that are kept at a point.
#include <functional>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/left.hpp"
#include "eigen/sensitivity/sensitivity.hpp"

namespace squeal::sensitivity {

/// Returns the forms yᴴ (∂P/∂θ)(s) x of one eigenvalue, in the field `value` of each derivative.
using Forms = std::function<std::vector<pencil::Derivative>(const EigenTriple&)>;

/// Collective. Appends to ComplexModes::sensitivities an entry for each shape of the point, whose
/// terms the pencil holds. Left vectors are computed first, beginning in `start`, with the solver
/// of `system`. Where the eigenvalue has derivatives, they are the forms divided by −yᴴ P′ x
/// [M.46]. The arguments are borrowed during this call.
void deriveShapes(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                  const StartSpace& start, const factor::AssociatedSystem& system,
                  const Forms& forms);

/// Collective. Does the same for friction, speed and damping, as far as the coefficients of the
/// terms depend on them.
void deriveParameters(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                      const StartSpace& start, const factor::AssociatedSystem& system);

}  // namespace squeal::sensitivity
