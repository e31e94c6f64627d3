#pragma once
/// The whole mesh, held by the reader's rank alone between the gmsh library and the distribution.
/// Not collective: rank 0 only.
#include "mesh/mesh.hpp"

namespace squeal::mesh {

struct WholeBlock {
  int type = 0, nodesPerElement = 0, corners = 0;
  std::vector<PetscInt> nodes;  ///< [element][node] index into WholeMesh::points
  std::vector<int> label;       ///< [element] body (cells) or surface (faces)
  std::vector<PetscInt> tag;    ///< [element] gmsh's tag
};

struct WholeFaces : WholeBlock {
  std::vector<PetscInt> cell;  ///< [face] the cell it bounds
  std::vector<int> sign;       ///< see FaceBlock
};

struct WholeMesh {
  int dimension = 0;
  std::vector<Point> points;
  std::vector<PetscInt> tags;
  PetscInt unusedNodes = 0;  ///< see Mesh
  std::vector<std::string> bodies, surfaces;
  std::vector<WholeBlock> cells;
  std::vector<WholeFaces> faces;
  std::map<std::string, std::vector<PetscInt>> nodeGroups;
  std::map<std::string, std::vector<std::vector<PetscInt>>>
      discFaces;          ///< [surface of a disc side] nodes of each face, of all cells it bounds
  std::vector<int> part;  ///< [node] connected part
  std::vector<std::string> partName;
  std::vector<PetscInt> primary;   ///< [node] the node it repeats, itself if none
  std::vector<Image> images;       ///< whole-mesh numbers
  std::vector<ContactPair> pairs;  ///< whole-mesh numbers

  PetscInt nodeCount() const { return static_cast<PetscInt>(points.size()); }
  PetscInt cellCount() const;
};

/// Reads or meshes `file` with gmsh, splits nodes shared across contact interfaces, finds parts and
/// faces. `parameters`: "name=value" settings of a .geo file.
WholeMesh load(const std::string& file, const std::vector<std::string>& parameters,
               const Request& request);

/// Finds the partner of each periodic image and of each contact node; fills primary, images, pairs.
void pairNodes(WholeMesh& mesh, const Request& request);

/// METIS: the rank of each cell, from the dual graph in which contact partners and periodic images
/// count as one node.
std::vector<int> partition(const WholeMesh& mesh, int ranks);

}  // namespace squeal::mesh
