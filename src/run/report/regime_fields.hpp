// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Fields of the motion after flutter: means at the contact nodes, and the animation of the latest
/// cycles.
#include <filesystem>

#include "run/analysis/analysis.hpp"
#include "run/fieldfile/hdf5.hpp"
#include "run/report/nodal_fields.hpp"

namespace squeal::report {

/// Collective. Writes the VTK files of each time integration into the folder `vtk`, each field in
/// at most `pieces` pieces.
void writeRegimeFields(const analysis::Analysis& analysis, const Ghosts& ghosts,
                       const std::filesystem::path& vtk, int pieces);

/// Collective. Writes the means at the contact nodes to /regime/friction_POINT/start_START.
void writeRegimeFields(const analysis::Analysis& analysis, fieldfile::Hdf5File& file);

}  // namespace squeal::report
