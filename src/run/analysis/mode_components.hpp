// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The composition of the modes of a segment: the shares of the components of the model, and those
/// of the free modes.
#include "algebra/factor/associated_system.hpp"
#include "eigen/pencil/participation.hpp"
#include "eigen/sweep_solver/results.hpp"
#include "problem/energies/components.hpp"

namespace squeal::analysis {

/// Collective. Adds to each stored complex mode of the segment the participation of the free modes,
/// if there are free modes. `system` has the unknowns of the modes.
void addParticipations(const factor::AssociatedSystem& system, sweep_solver::ModalSegment& segment);

/// Collective. Adds to each stored complex mode its MAC, body by body, with the free modes that
/// have the largest shares of its energy: at most three, each at least 0.05. `trial` is T.
void addCorrelations(const energies::BodyMac& mac, Mat trial, sweep_solver::ModalSegment& segment);

/// Collective. Adds the shares of the components to the free modes of the segment, up to the top of
/// its band; to all of them if the band has no top. `trial` is T; `prestress` is K_σ, null: none.
void addComponents(const energies::Components& components, const elasticity::Bodies& bodies,
                   Mat trial, Mat prestress, sweep_solver::ModalSegment& segment);

/// Collective. Returns the modes at critical frictions with the participation of these free modes,
/// [motion].
std::vector<pencil::CriticalMode> describe(const factor::AssociatedSystem& system,
                                           const std::vector<pencil::ComplexMotion>& motions,
                                           const modes::Modes& modes);

}  // namespace squeal::analysis
