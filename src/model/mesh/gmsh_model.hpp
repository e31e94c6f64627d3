// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The mesh that gmsh has read from a file or made, with its physical groups. Not collective: for
/// rank 0 only.
#include "model/mesh/mesh.hpp"
#include "model/meshfile/contents.hpp"
#include "model/meshfile/reader.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::mesh {

/// A GmshModel is the mesh that gmsh reads from a file or makes from a geometry. The reader calls
/// gmsh in a child process: a crash there becomes an Error here, and the memory of the child is
/// freed when it ends.
class GmshModel {
 public:
  /// Reads or meshes the file. Throws Error for a file whose content does not match its name, or
  /// that gmsh cannot read or mesh. Also throws Error for parameters that the geometry does not
  /// have, and for values outside the range of a parameter.
  explicit GmshModel(const meshfile::Settings& settings,
                     meshfile::Reader reader = meshfile::readInProgram);

  /// Returns a group, borrowed. If the mesh has no group of this name, throws Error, naming the
  /// group, the option that needs it, the groups of the mesh, and the reference nodes that could be
  /// used instead.
  const meshfile::GroupElements& group(const std::string& name, const std::string& wantedBy,
                                       const std::vector<std::string>& references = {}) const;
  /// Makes a group for each body that is not itself a group of the mesh, from the groups of its
  /// sections. Throws Error for a section that is not in the mesh, and for sections of one body
  /// with different dimensions.
  void joinSections(const Request& request);
  const Point& point(PetscInt index) const { return contents_.points[index]; }
  PetscInt tag(PetscInt index) const { return contents_.tags[index]; }
  PetscInt nodeCount() const { return contents_.points.size(); }
  int largestDimension() const { return contents_.dimension; }
  /// Returns the tags of those elements of the largest dimension that are in no group.
  const std::vector<PetscInt>& ungrouped() const { return contents_.ungrouped; }
  /// Returns false for a node at a point of the geometry. gmsh makes such nodes even where no cell
  /// uses them, for example at the centre of a circle.
  bool isOfMesh(PetscInt index) const { return !contents_.atPoint[index]; }
  /// Returns the number of nodes of the file that are in no element; gmsh drops them.
  PetscInt droppedNodes() const { return contents_.droppedNodes; }
  /// Returns all groups by the names that options use: see groupName().
  const std::map<std::string, meshfile::GroupElements>& groups() const { return contents_.groups; }

 private:
  meshfile::Contents contents_;
};

}  // namespace squeal::mesh
