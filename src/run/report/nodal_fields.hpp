// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Nodal vectors as fields for VTK files.
#include <filesystem>
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/mesh/mesh.hpp"
#include "run/fieldfile/vtu.hpp"

namespace squeal::report {

/// Collective. Writes these fields to VTK files, in at most `pieces` pieces (`-report_pieces`).
void writeVtk(const mesh::Mesh& mesh, const std::filesystem::path& stem,
              const std::vector<fieldfile::Field>& fields, int pieces);

/// Makes fields from nodal vectors: sends the values from their owners to all ranks whose cells
/// need them. The methods are collective.
class Ghosts {
 public:
  explicit Ghosts(const mesh::Mesh& mesh);
  fieldfile::Field vector(const std::string& name, Vec u) const;
  /// Returns the field of one component of the vector.
  fieldfile::Field scalar(const std::string& name, Vec u, std::size_t component = 0) const;

 private:
  const mesh::Mesh& mesh_;
  OwnedVec local_;
  OwnedScatter scatter_;
};

}  // namespace squeal::report
