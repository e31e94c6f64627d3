// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sensitivities of the stored complex modes of a point.
#include <functional>
#include <vector>

#include "algebra/factor/associated_system.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sensitivity/null_vectors.hpp"
#include "eigen/sensitivity/sensitivity.hpp"

namespace squeal::sensitivity {

/// Returns the forms yᴴ (∂P/∂θ)(s) x of one eigenvalue, in the member `value` of each derivative.
using Forms = std::function<std::vector<pencil::Derivative>(const EigenTriple&)>;

/// Collective. Appends to ComplexModes::sensitivities an entry for each shape of the point.
/// `pencil` contains the terms of the point. Left vectors are computed first, from the space
/// `start`, with the solver of `system`. The derivatives, where they exist, are the forms divided
/// by −yᴴ P′ x [M.46]. The second derivatives [M.90] take only the nearest eigenvalue into account.
/// Borrows the arguments only during this call.
void deriveShapes(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                  const StartSpace& start, const factor::AssociatedSystem& system,
                  const Forms& forms);

/// A point at a critical friction, where i ω with ω = `angularFrequency` is an eigenvalue.
struct CriticalPoint {
  sweep::Parameters at;
  double angularFrequency = 0;  ///< rad/s
  bool isCrossing = true;  ///< one eigenvalue crosses the imaginary axis; otherwise two meet there,
                           ///< or one is zero
};

/// Collective. Adds to the mode at a critical friction the derivatives of this friction [M.89] with
/// respect to all parameters except the friction itself. Adds none if a right or left vector is not
/// found, or if the growth does not depend on the friction. `forms` must include the form of the
/// parameter "friction". The other arguments are those of deriveShapes().
void deriveCritical(const CriticalPoint& point, const pencil::Pencil& pencil,
                    const StartSpace& start, const factor::AssociatedSystem& system,
                    const Forms& forms, pencil::CriticalMode& mode);

/// Collective. Returns the forms of friction, speed and damping; the form of a parameter on which
/// no coefficient of a term depends is zero. Borrows the pencil.
Forms parameterForms(const pencil::Pencil& pencil, const sweep::Parameters& at);

/// Collective. Does the same as deriveShapes() for the parameters friction, speed and damping, with
/// parameterForms().
void deriveParameters(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                      const StartSpace& start, const factor::AssociatedSystem& system);

}  // namespace squeal::sensitivity
