#pragma once
/// What a run that continues another one must have in common with it.
#include "analysis/analysis.hpp"

namespace squeal::analysis {

/// Collective. Returns the checksums of the mesh as it is after all nodes have been moved, or of
/// the files with the matrices.
checkpoint::Identity identityOfInput(const Analysis& analysis);

}  // namespace squeal::analysis
