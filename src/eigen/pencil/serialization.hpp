// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of complex modes, critical modes and proofs for checkpoints and messages.
#include "base/checkpoint/archive.hpp"
#include "eigen/pencil/complex_modes.hpp"

namespace squeal::pencil {

/// Collective. Writes or reads the results of a point.
void serialise(checkpoint::Archive& archive, ComplexModes& point);
/// Writes or reads the mode at a critical friction.
void fields(Stream& stream, CriticalMode& found);
/// Writes or reads the result of the proof for a list.
void fields(Stream& stream, Completeness& found);
/// Collective. Writes or reads what a proof sets: the eigenvalues with their radii, and what is
/// proved about the list.
void serialiseProof(checkpoint::Archive& archive, ComplexModes& point);

}  // namespace squeal::pencil
