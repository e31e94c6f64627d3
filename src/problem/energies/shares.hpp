// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The shares of the components in the energies and in the growth rate of a mode.
#include <optional>
#include <string>
#include <vector>

#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "problem/energies/components.hpp"
#include "problem/terms/friction_work.hpp"

namespace squeal::energies {

/// Collective. Returns the components with their shares in the energies of a free mode u.
/// `prestress` is uᵀ K_σ u, twice the contribution of a steady stress to the strain energy; none
/// without such a stress. It is included in the strain energy and appended as a component.
std::vector<pencil::Component> sharesOfFreeMode(const Components& components,
                                                const NodalProducts& mode,
                                                std::optional<double> prestress);

/// Collective. Returns the name of a motion as pencil::modeName() does. u are its nodal
/// displacements.
std::string nameOfMotion(const Components& components, const elasticity::Bodies& bodies,
                         const linalg::ComplexVector& u);

/// A complex mode at a point of a sweep. Its references are borrowed.
struct ComplexMode {
  const terms::Motion& motion;
  const terms::MotionForces& force;
  /// Contribution of friction to the growth rate, [contact node], 1/s.
  const std::vector<pencil::GrowthParts>& friction;
  /// Contribution of modal damping to the growth rate, 1/s, ≤ 0; 0 without modal damping.
  double modalDamping = 0;
};

/// Collective. Returns the components with their shares in the energies of a complex mode, and with
/// their contributions to its growth rate [M.87]. Entries for the whole model follow, if they
/// exist: prestress, rotation (K^R and gyroscopic forces) and modal damping.
std::vector<pencil::Component> sharesOfComplexMode(const Components& components,
                                                   const elasticity::Bodies& bodies,
                                                   const contact::Contact& contact,
                                                   const ComplexMode& mode);

/// Collective. Returns the contribution of modal damping C_m to the growth rate of a motion x with
/// the energy E,
///   −|s|² c xᴴ C_m x / E,   1/s,
/// computed from the damping terms of the pencil minus the damping matrix C of the bodies.
double modalGrowth(const pencil::Pencil& pencil, const linalg::ComplexVector& unknowns,
                   const elasticity::Bodies& bodies, const terms::Motion& motion, double energy);

}  // namespace squeal::energies
