// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The steadily sliding brake. Vibrations are computed about its steady states.
#include "run/analysis/steady_sweep.hpp"

namespace squeal::analysis {

/// Borrows its members.
struct SlidingBrake {
  const Settings& settings;
  const sweep::Sweep& sweep;
  const Model& model;
  const SteadyStates& states;

  MPI_Comm comm() const { return model.mesh->comm; }
  /// Returns the settings of the mesh problem.
  const MeshSettings& mesh() const { return *settings.mesh; }
};

}  // namespace squeal::analysis
