// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The shape of each table, which the summary stores so that an incomplete table can be detected.
#include <mpi.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace squeal::report {

/// Collective. Returns the names of the columns and the number of rows of each table in the folder,
/// by its name without extension; on rank 0, empty on the others. Throws Error, naming -report_dir,
/// if a table cannot be read.
nlohmann::ordered_json tableShapes(MPI_Comm comm, const std::filesystem::path& folder);

}  // namespace squeal::report
