// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The call of gmsh. Not collective.
#include "base/system/child_limits.hpp"
#include "model/meshfile/contents.hpp"
#include "model/meshfile/job.hpp"

namespace squeal::meshfile {

/// Reads or meshes a file with gmsh in a child process, within limits. Throws Error if it cannot.
using Reader = Contents (*)(Job job, const ChildLimits& limits);

/// The Reader that starts the program `squeal_gmsh`.
Contents readInProgram(Job job, const ChildLimits& limits);

}  // namespace squeal::meshfile
