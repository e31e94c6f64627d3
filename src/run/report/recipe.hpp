// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The options of a run as an options file that repeats it.
#include <mpi.h>

#include <filesystem>

namespace squeal::report {

/// Collective. Writes options.txt into `folder`. It contains the given options, and the defaults of
/// the other options as comments. It omits -report_dir, -resume, -progress and -log_json. Call it
/// once all settings have been read. Throws Error as writeText() does.
void writeRecipe(MPI_Comm comm, const std::filesystem::path& folder);

}  // namespace squeal::report
