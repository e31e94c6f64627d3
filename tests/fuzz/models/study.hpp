// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Materials, damping, sweep and methods of a random model.
#include "fuzz/models/model.hpp"
#include "fuzz/random.hpp"

namespace squeal::fuzz {

/// Returns a number not far above that of the unknowns of a model with this mesh.
int unknownsOf(const BoxMesh& mesh);

/// Adds the materials of all bodies, damping, a sweep and the choice of methods at random.
void addStudy(Random& random, Model& model);

}  // namespace squeal::fuzz
