// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Options of a model that have no effect.
#include "model/mesh/mesh.hpp"
#include "run/analysis/model_settings.hpp"

namespace squeal::analysis {

/// Collective. Prints a warning for each option that has no effect: frames that no option refers
/// to, origins of rectangular frames, frames of point masses and couplings that do not depend on
/// the axes, -coupling_<name>_pinned without reference nodes in its groups, base motions without
/// contact and convective terms, and -elasticity_plane with a solid mesh.
void warnOfIdleOptions(const mesh::Mesh& mesh, const ModelSettings& settings);

}  // namespace squeal::analysis
