// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The mesh that gmsh reads or makes. This folder is compiled only into the program `squeal_gmsh`,
/// the only one that calls gmsh. Not collective.
#include "base/system/child_limits.hpp"
#include "model/meshfile/contents.hpp"
#include "model/meshfile/job.hpp"

namespace squeal::gmshreader {

/// Reads or meshes the file. Throws Error if gmsh fails, for a mesh that is not sound, for
/// parameters that the geometry does not have, and for values outside the range of a parameter.
/// gmsh must be initialised.
meshfile::Contents read(const meshfile::Job& job, const Warn& warn);

}  // namespace squeal::gmshreader
