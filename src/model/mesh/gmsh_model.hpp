// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The mesh that gmsh has read from a file or made, with its physical groups. Not collective: for
/// rank 0 only.
#include "model/mesh/mesh.hpp"
#include "model/meshfile/contents.hpp"
#include "model/meshfile/reader.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::mesh {

/// A GmshModel is the mesh that gmsh reads from a file or makes of a geometry. The reader calls
/// gmsh in a child process: a crash there becomes an Error here, and its memory is freed with it.
class GmshModel {
 public:
  /// Reads or meshes the file. Throws Error for a file that is not what its name says or that gmsh
  /// cannot read or mesh, and for parameters that the geometry does not have or whose range the
  /// value leaves.
  explicit GmshModel(const meshfile::Settings& settings,
                     meshfile::Reader reader = meshfile::readInProgram);

  /// Returns a group, borrowed. If the mesh has none of this name, throws Error, naming the group,
  /// the option that needs it, the groups of the mesh and the reference nodes that would do as
  /// well.
  const meshfile::GroupElements& group(const std::string& name, const std::string& wantedBy,
                                       const std::vector<std::string>& references = {}) const;
  /// Makes a group for each body whose sections are groups of the mesh while the body is not.
  /// Throws Error for a section that is not in the mesh or has another dimension than the others.
  void joinSections(const Request& request);
  const Point& point(PetscInt index) const { return contents_.points[index]; }
  PetscInt tag(PetscInt index) const { return contents_.tags[index]; }
  PetscInt nodeCount() const { return contents_.points.size(); }
  int largestDimension() const { return contents_.dimension; }
  /// Returns the tags of the elements of the largest dimension that are in no group.
  const std::vector<PetscInt>& ungrouped() const { return contents_.ungrouped; }
  /// Returns false for a node at a point of the geometry. gmsh makes these whether or not a cell
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
