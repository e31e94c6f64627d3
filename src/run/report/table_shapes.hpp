// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The shape of each table is kept in the summary, so that a table of which a part is lost is
/// known.
#include <mpi.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace squeal::report {

/// Collective. Returns the names of the columns and the number of rows of each table in the folder,
/// by its name without ending; on rank 0, nothing on the others. Throws Error, naming -report_dir,
/// if a table cannot be read.
nlohmann::ordered_json tableShapes(MPI_Comm comm, const std::filesystem::path& folder);

}  // namespace squeal::report
