// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Options of a model that have no effect.
#include "model/mesh/mesh.hpp"
#include "run/analysis/model_settings.hpp"

namespace squeal::analysis {

/// Collective. Warns, naming them, of frames that nothing refers to, of the origin of rectangular
/// frames, of the frames of options without a direction, and of -coupling_<name>_pinned without
/// reference nodes in its groups.
void warnOfIdleOptions(const mesh::Mesh& mesh, const ModelSettings& settings);

}  // namespace squeal::analysis
