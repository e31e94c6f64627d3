#pragma once
/// The sensitivities of the complex modes kept at a point.
#include <functional>
#include <vector>

#include "modes/associated.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sensitivity/left.hpp"
#include "sensitivity/sensitivity.hpp"

namespace squeal::sensitivity {

/// The forms yᴴ (∂P/∂θ)(s) x of one eigenvalue, in place of derivatives.
using Forms = std::function<std::vector<pencil::Derivative>(const EigenTriple&)>;

/// Collective. Fills FrictionPoint::sensitivities for all shapes of the point, whose terms the
/// pencil holds: left vectors, and the forms divided by −yᴴP′x where the eigenvalue has
/// derivatives.
void deriveShapes(pencil::FrictionPoint& point, const pencil::Pencil& pencil,
                  const StartSpace& start, const modes::AssociatedSystem& system,
                  const Forms& forms);

/// Collective. The same for the parameters in the coefficients of the terms alone: friction, speed
/// and damping.
void deriveParameters(pencil::FrictionPoint& point, const pencil::Pencil& pencil,
                      const StartSpace& start, const modes::AssociatedSystem& system);

}  // namespace squeal::sensitivity
