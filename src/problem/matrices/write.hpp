// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Export of the matrices of a pencil to the folder of `-report_matrices`, from which another run
/// can read them.
#include <cstddef>
#include <filesystem>

#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/sweep.hpp"
#include "problem/matrices/settings.hpp"

namespace squeal::matrices {

/// Collective. Call it before the computation begins. Throws Error if the folder of
/// `-report_matrices` is the results folder or cannot be written, or if a file in it prevents the
/// export.
void requireExportFolder(MPI_Comm comm, const ExportSettings& settings,
                         const std::filesystem::path& results);

/// Collective. Writes the matrices of the pencil to the folder of `-report_matrices`, with an
/// options file, options.txt, that solves the same problem from them. Terms that depend on the
/// steady state of a point are written with their values at this point. `steadyPoints` is the
/// number of steady points of the sweep to which the pencil applies. Throws Error if these are not
/// all steady points, if the pencil has terms of one point and there are several points, and if the
/// folder or a file cannot be written.
void exportPencil(const pencil::Pencil& pencil, const ExportSettings& settings,
                  const sweep::Sweep& sweep, std::size_t steadyPoints);

}  // namespace squeal::matrices
