// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The numbers of columns and rows of each table. The summary stores them so that an incomplete
/// table can be detected.
#include <mpi.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace squeal::report {

/// Collective. Returns the names of the columns and the number of rows of each table in the folder,
/// by the name of the table without extension. The result is empty on all ranks except rank 0.
/// Throws Error, naming -report_dir, if a table cannot be read.
nlohmann::ordered_json tableShapes(MPI_Comm comm, const std::filesystem::path& folder);

}  // namespace squeal::report
