// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Plausibility of the units of a model. Any consistent units pass, those of dimensionless models
/// included: only known mixtures of units are findings.
#include "run/audit/finding.hpp"
#include "run/audit/masses.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// The moduli of a body.
struct Moduli {
  double least = 0,
         largest = 0;  ///< Young's moduli; along its axes, if the body is anisotropic, Pa
};
/// Not collective. Returns the moduli, [body].
std::vector<Moduli> moduliOf(const Subject& model);

/// Collective. Judges the wave speed √(E/ρ) of each body, the size of the model, its
/// pressures and its gravity.
Findings unitFindings(const Subject& model, const std::vector<BodyMass>& masses);

}  // namespace squeal::audit
