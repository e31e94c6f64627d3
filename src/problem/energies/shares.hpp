// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The shares of the components in the energies of a mode, and in its growth.
#include <optional>
#include <string>
#include <vector>

#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "problem/energies/components.hpp"
#include "problem/terms/friction_work.hpp"

namespace squeal::energies {

/// Collective. Returns the components with their shares in the energies of a free mode u. The
/// strain energy includes that of the steady stress, uᵀ K_σ u = `prestress`, if there is one.
std::vector<pencil::Component> sharesOfFreeMode(const Components& components,
                                                const NodalProducts& mode,
                                                std::optional<double> prestress);

/// Collective. Returns the name of a motion u, nodal displacements, as of pencil::modeName().
std::string nameOfMotion(const Components& components, const elasticity::Bodies& bodies,
                         const linalg::ComplexVector& u);

/// A complex mode at a point of a sweep, all members borrowed.
struct ComplexMode {
  const terms::Motion& motion;
  const terms::MotionForces& force;
  /// What friction adds to the growth rate, [owned contact node], 1/s.
  const std::vector<pencil::GrowthParts>& friction;
  /// What modal damping takes from the growth rate, 1/s, ≤ 0; 0 without.
  double modalDamping = 0;
};

/// Collective. Returns the components with their shares in the energies of a complex mode, and in
/// its growth [M.87]. Rows of the whole model follow where they apply: prestress, rotation (K^R and
/// gyroscopic forces) and modal damping.
std::vector<pencil::Component> sharesOfComplexMode(const Components& components,
                                                   const elasticity::Bodies& bodies,
                                                   const contact::Contact& contact,
                                                   const ComplexMode& mode);

/// Collective. Returns what modal damping C_m adds to the growth rate of a motion of the energy E,
///   −|s|² c xᴴ C_m x / E,   1/s,
/// from the damping terms of the pencil that C of the bodies leaves.
double modalGrowth(const pencil::Pencil& pencil, const linalg::ComplexVector& unknowns,
                   const elasticity::Bodies& bodies, const terms::Motion& motion, double energy);

}  // namespace squeal::energies
