#pragma once
/// The gmsh library behind a small door: a file read or meshed, and its physical groups. Not
/// collective: rank 0 only.
#include "mesh/whole.hpp"
#include "petsc/buffer.hpp"

namespace squeal::mesh {

/// Elements of one physical group, nodes by index into GmshModel::points.
struct GroupElements {
  int dimension = 0;
  std::vector<WholeBlock> blocks;
};

/// A group by the name that options use, which cannot hold blanks: underscores stand for them.
std::string groupName(std::string name);

/// What gmsh makes of a file. gmsh itself works in a child process: a crash there is an Error here,
/// and its memory goes with it.
class GmshModel {
 public:
  /// `parameters`: "name=value" settings of a geometry. Errors: a file that is not what its name
  /// says, or that gmsh cannot read or mesh; parameters that the geometry does not have or whose
  /// range they leave.
  GmshModel(const std::string& file, const std::vector<std::string>& parameters);

  /// Error naming the group, the option that wants it and the groups there are, if the mesh has
  /// none of this name.
  const GroupElements& group(const std::string& name, const std::string& wantedBy) const;
  const Point& point(PetscInt index) const { return points_[static_cast<std::size_t>(index)]; }
  PetscInt tag(PetscInt index) const { return tags_[static_cast<std::size_t>(index)]; }
  PetscInt nodeCount() const { return static_cast<PetscInt>(points_.size()); }
  int largestDimension() const { return dimension_; }
  /// Tags of the elements of the largest dimension that are in no group.
  const std::vector<PetscInt>& ungrouped() const { return ungrouped_; }
  /// False for a node at a point of the geometry, which gmsh puts there whether or not a cell has
  /// it: at the centre of a circle, for one.
  bool isOfMesh(PetscInt index) const { return !atPoint_[static_cast<std::size_t>(index)]; }
  /// Nodes of the file that are in no element: gmsh drops them.
  PetscInt droppedNodes() const { return droppedNodes_; }
  /// By the names that options use: blanks in a name are underscores there.
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
