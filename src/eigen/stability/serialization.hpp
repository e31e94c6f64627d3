// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Followed eigenvalues on their way to and from a checkpoint.
#include "algebra/linalg/serialization.hpp"
#include "base/checkpoint/archive.hpp"
#include "eigen/stability/followed.hpp"

namespace squeal::stability {

/// Not collective. Writes what was followed on a line, which all ranks know, or sets it.
void fields(Stream& stream, Followed& followed);

}  // namespace squeal::stability
