// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of a mesh, for its distribution.
#include "base/system/stream.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::mesh {

void fields(Stream& stream, CellBlock& block);
void fields(Stream& stream, FaceBlock& block);
void fields(Stream& stream, InterfaceMatch& match);
void fields(Stream& stream, Reference& reference);
void fields(Stream& stream, MaterialGroup& group);
void fields(Stream& stream, Section& section);
/// Writes or reads all members except the communicator.
void fields(Stream& stream, Mesh& mesh);

}  // namespace squeal::mesh
