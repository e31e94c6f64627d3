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
  int components = 1;          ///< 1: scalar; 3: vector (plane problems: the third one 0)
  std::vector<double> values;  ///< [local node][component], including ghosts; or [cell][component]
};

/// Collective. Writes `stem`.pvtu and the pieces `stem`/…_PIECE.vtu in a subfolder: one per rank
/// or, on more ranks, `mostPieces` of neighbouring ranks together; compressed binary, coordinates
/// in double and fields in single precision. In addition to the fields, they contain node_tag and
/// part of the nodes, body (index) and rank of the cells and, if a body is made up of sections,
/// their material (index). Throws Error on all ranks, naming `option`, with its dash, if a file
/// cannot be written, if VTK does not have a cell type, and if a field has a wrong size.
void writeVtu(const mesh::Mesh& mesh, const std::filesystem::path& stem,
              const std::vector<Field>& pointFields, const std::string& option, int mostPieces = 8,
              const std::vector<Field>& cellFields = {});

/// Collective. Writes, on rank 0, a ParaView collection of (time, file) pairs: the frames of an
/// animation or of a sweep. Paths are stored relative to the folder of `path`, so the folder can be
/// moved. All paths must be absolute, or all relative. Throws Error on all ranks, naming `option`,
/// if a file cannot be written.
void writePvd(MPI_Comm comm, const std::filesystem::path& path,
              const std::vector<std::pair<double, std::filesystem::path>>& frames,
              const std::string& option);

}  // namespace squeal::fieldfile
