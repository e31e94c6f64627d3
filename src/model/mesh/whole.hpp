#pragma once
/// A WholeMesh is the whole mesh, which rank 0 holds between reading and distribution. Not
/// collective: for rank 0 only.
#include "model/mesh/mesh.hpp"

namespace squeal::mesh {

/// The cells or faces of one gmsh element type in the whole mesh.
struct WholeBlock {
  int type = 0, nodesPerElement = 0, corners = 0;
  std::vector<PetscInt> nodes;  ///< [element][node] index into WholeMesh::points
  std::vector<int> label;       ///< [element] body (cells) or surface (faces)
  std::vector<PetscInt> tag;    ///< [element] gmsh's tag

  std::span<PetscInt> nodesOf(std::size_t element) {
    return std::span(nodes).subspan(element * nodesPerElement, nodesPerElement);
  }
  std::span<const PetscInt> nodesOf(std::size_t element) const {
    return std::span(nodes).subspan(element * nodesPerElement, nodesPerElement);
  }
  std::span<const PetscInt> cornersOf(std::size_t element) const {
    return nodesOf(element).first(corners);
  }
};

/// The boundary faces of one gmsh element type in the whole mesh.
struct WholeFaces : WholeBlock {
  std::vector<PetscInt> cell;  ///< [face] number over all blocks of the cell that it bounds
  std::vector<int> sign;       ///< see FaceBlock
};

/// The whole mesh, of which load() fills all but primary, images, pairs, matching and mismatch.
struct WholeMesh {
  int dimension = 0;
  std::vector<Point> points;
  std::vector<PetscInt> tags;
  PetscInt unusedNodes = 0;  ///< see Mesh
  Straightened straightened;
  std::vector<std::string> bodies, surfaces;
  std::vector<WholeBlock> cells;
  std::vector<WholeFaces> faces;
  std::map<std::string, std::vector<PetscInt>> nodeGroups;
  std::map<std::string, std::vector<std::vector<PetscInt>>>
      discFaces;          ///< [surface of a disc] nodes of each face, for each cell it bounds
  std::vector<int> part;  ///< [node] connected part
  std::vector<std::string> partName;
  std::vector<PetscInt> primary;              ///< [node] the node that it repeats, itself if none
  std::vector<Image> images;                  ///< in numbers of the whole mesh
  std::vector<ContactPair> pairs;             ///< in numbers of the whole mesh
  std::vector<unsigned char> matching;        ///< see Mesh
  std::vector<std::string> mismatch;          ///< see Mesh
  std::vector<unsigned char> nearlyMatching;  ///< see Mesh

  PetscInt nodeCount() const { return points.size(); }
  PetscInt cellCount() const;
};

/// Reads or meshes `file` with gmsh, splits nodes shared across contact interfaces, and finds parts
/// and faces. `parameters` are the settings of a .geo file, "name=value".
WholeMesh load(const std::string& file, const std::vector<std::string>& parameters,
               const Request& request);

}  // namespace squeal::mesh
