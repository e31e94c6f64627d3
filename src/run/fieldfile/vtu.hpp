// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Fields on the mesh as VTK files, which ParaView opens with all nodes of quadratic cells.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::fieldfile {

/// Values at the nodes or in the cells.
struct Field {
  std::string name;
  int components = 1;          ///< 1: scalar; 3: vector (in plane problems the third is 0)
  std::vector<double> values;  ///< [local node][component], including ghosts; or [cell][component]
};

/// Collective. Writes `stem`.pvtu and, in the subfolder `stem`, the pieces …_PIECE.vtu. There is
/// one piece per rank, but at most `mostPieces`: neighbouring ranks then share a piece. The pieces
/// are compressed and binary, with coordinates in double and fields in single precision. They also
/// contain the point fields `node_tag` and `part`, the cell fields `body` (an index) and `rank`
/// and, if any body consists of sections, the cell field `material` (an index). Throws Error on all
/// ranks, naming `option` (given with its dash), if a file cannot be written, if VTK does not have
/// a cell type, or if a field has a wrong size.
void writeVtu(const mesh::Mesh& mesh, const std::filesystem::path& stem,
              const std::vector<Field>& pointFields, const std::string& option, int mostPieces = 8,
              const std::vector<Field>& cellFields = {});

/// Collective. Writes a ParaView collection of (time, file) pairs on rank 0: the frames of an
/// animation or the points of a sweep. File paths are stored relative to the folder of `path`, so
/// the folder can be moved. Either all paths must be absolute, or all relative. Throws Error on all
/// ranks, naming `option`, if a file cannot be written.
void writePvd(MPI_Comm comm, const std::filesystem::path& path,
              const std::vector<std::pair<double, std::filesystem::path>>& frames,
              const std::string& option);

}  // namespace squeal::fieldfile
