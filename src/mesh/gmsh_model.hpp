#pragma once
/// The gmsh library behind a small door: a file read or meshed in memory, and its physical groups. Not collective: rank 0 only.
#include "mesh/whole.hpp"

namespace squeal::mesh {

/// Elements of one physical group as gmsh gives them, nodes by index into WholeMesh::points.
struct GroupElements {
  int dimension = 0;
  std::vector<WholeBlock> blocks;
};

class GmshModel {
 public:
  GmshModel(const std::string& file, const std::vector<std::string>& parameters);
  ~GmshModel();
  GmshModel(const GmshModel&) = delete;
  GmshModel& operator=(const GmshModel&) = delete;

  /// Error naming the group, the option that wants it and the groups there are, if the mesh has none of this name.
  GroupElements group(const std::string& name, const std::string& wantedBy) const;
  Point point(std::size_t tag) const { return points_.at(tag); }
  int largestDimension() const;
  /// Tags of all elements of the largest dimension (to find cells without a body), with the names of their groups.
  std::map<std::size_t, std::string> allCells(int dimension) const;

 private:
  std::map<std::string, std::vector<std::pair<int, int>>> groups_;  // name -> (dimension, physical tag)
  std::map<std::size_t, Point> points_;
};

}  // namespace squeal::mesh
