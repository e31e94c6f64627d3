// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Plausibility of the units of a model. Any consistent units are accepted, including those of
/// dimensionless models. Only known mixtures of units are findings.
#include "run/audit/finding.hpp"
#include "run/audit/masses.hpp"
#include "run/audit/subject.hpp"

namespace squeal::audit {

/// The moduli of a material.
struct Moduli {
  double least = 0, largest = 0;  ///< Young's moduli, along the axes if anisotropic, Pa
};
/// Not collective. Returns the moduli, [material group].
std::vector<Moduli> moduliOf(const Subject& model);

/// Not collective. Returns √(E/ρ), [body], m/s; the largest value if the body has several sections.
std::vector<double> waveSpeeds(const Subject& model);

/// Collective. Returns findings on the wave speed √(E/ρ) of each material, the size of the model,
/// its pressures and its gravity.
Findings unitFindings(const Subject& model, const std::vector<BodyMass>& masses);

}  // namespace squeal::audit
