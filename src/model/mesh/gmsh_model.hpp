#pragma once
/// This file is the interface to the gmsh library: a file that it has read or meshed, and the
/// physical groups. Not collective: for rank 0 only.
#include "base/system/buffer.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// The elements of one physical group, with nodes as indices for GmshModel::point().
struct GroupElements {
  int dimension = 0;
  std::vector<WholeBlock> blocks;
};

/// Returns the name of a group as options use it, with underscores in place of blanks.
std::string groupName(std::string name);

/// A GmshModel is the mesh that gmsh reads from a file or makes of a geometry. gmsh works in a
/// child process: a crash there becomes an Error here, and its memory is freed with it.
class GmshModel {
 public:
  /// Reads or meshes the file. `parameters` are the settings of a geometry, "name=value". Throws
  /// Error for a file that is not what its name says or that gmsh cannot read or mesh, and for
  /// parameters that the geometry does not have or whose range the value leaves.
  GmshModel(const std::string& file, const std::vector<std::string>& parameters);

  /// Returns a group, borrowed. If the mesh has none of this name, throws Error, naming the group,
  /// the option that needs it and the groups of the mesh.
  const GroupElements& group(const std::string& name, const std::string& wantedBy) const;
  const Point& point(PetscInt index) const { return points_[index]; }
  PetscInt tag(PetscInt index) const { return tags_[index]; }
  PetscInt nodeCount() const { return points_.size(); }
  int largestDimension() const { return dimension_; }
  /// Returns the tags of the elements of the largest dimension that are in no group.
  const std::vector<PetscInt>& ungrouped() const { return ungrouped_; }
  /// Returns false for a node at a point of the geometry. gmsh makes these whether or not a cell
  /// uses them, for example at the centre of a circle.
  bool isOfMesh(PetscInt index) const { return !atPoint_[index]; }
  /// Returns the number of nodes of the file that are in no element; gmsh drops them.
  PetscInt droppedNodes() const { return droppedNodes_; }
  /// Returns all groups by the names that options use: see groupName().
  const std::map<std::string, GroupElements>& groups() const { return groups_; }

 private:
  void take(Buffer& buffer);

  std::vector<Point> points_;
  std::vector<PetscInt> tags_;
  std::map<std::string, GroupElements> groups_;
  int dimension_ = 0;
  std::vector<PetscInt> ungrouped_;
  std::vector<char> atPoint_;
  PetscInt droppedNodes_ = 0;
};

}  // namespace squeal::mesh
