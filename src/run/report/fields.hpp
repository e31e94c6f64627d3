// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Fields for ParaView and other programs: steady displacement and pressure, free modes, complex
/// modes and their animation.
#include <filesystem>

#include "run/analysis/analysis.hpp"
#include "run/report/settings.hpp"

namespace squeal::report {

/// Collective. Writes results.h5 into `folder`. Throws Error as Hdf5File does.
void writeHdf5(const analysis::Analysis& analysis, const std::filesystem::path& folder);

/// Collective. Writes the VTK files of a run with a mesh into `folder`/vtk. Throws Error as
/// writeVtu() does.
void writeFields(const analysis::Analysis& analysis, const Settings& settings,
                 const std::filesystem::path& folder);

}  // namespace squeal::report
