// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The whole mesh, which rank 0 stores between reading and distribution. Not collective: for rank 0
/// only.
#include "model/mesh/mesh.hpp"
#include "model/meshfile/contents.hpp"
#include "model/meshfile/reader.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::mesh {

/// The cells or faces of one gmsh element type in the whole mesh, with nodes as indices into
/// WholeMesh::points.
using WholeBlock = meshfile::ElementBlock;

/// The boundary faces of one gmsh element type in the whole mesh.
struct WholeFaces : WholeBlock {
  std::vector<PetscInt> cell;  ///< [face] the cell that it bounds, numbered over all blocks
  std::vector<int> sign;       ///< see FaceBlock
};

/// The whole mesh. load() fills all members except primary, images, pairs, interfaces and layers.
struct WholeMesh {
  int dimension = 0;
  std::vector<Point> points;
  std::vector<PetscInt> tags;
  PetscInt unusedNodes = 0;  ///< see Mesh
  Straightened straightened;
  double diagonal = 0;  ///< see Mesh
  std::vector<std::string> bodies, surfaces;
  std::vector<MaterialGroup> materialGroups;  ///< see Mesh
  std::vector<WholeBlock> cells;
  std::vector<WholeFaces> faces;
  std::map<std::string, std::vector<PetscInt>> nodeGroups;
  std::map<std::string, std::vector<std::vector<PetscInt>>>
      discFaces;          ///< [surface of a disc] nodes of each face, once per cell it bounds
  std::vector<int> part;  ///< [node] connected part
  std::vector<std::string> partName;
  std::vector<Section> sections;          ///< see Mesh
  std::vector<SectionPair> sectionPairs;  ///< in numbers of the whole mesh
  std::vector<Reference> references;      ///< see Mesh, in numbers of the whole mesh
  std::vector<LayerNode> layers;          ///< in numbers of the whole mesh
  /// [node] the node that it repeats, or the node itself if it repeats none
  std::vector<PetscInt> primary;
  std::vector<Image> images;               ///< in numbers of the whole mesh
  std::vector<ContactPair> pairs;          ///< in numbers of the whole mesh
  std::vector<InterfaceMatch> interfaces;  ///< see Mesh

  PetscInt nodeCount() const { return points.size(); }
  PetscInt cellCount() const;
};

/// Returns the mean position of nodes.
Point centroid(const WholeMesh& mesh, std::span<const PetscInt> nodes);

/// Reads or meshes a file with gmsh, splits nodes shared across contact interfaces, and finds
/// connected parts and boundary faces.
WholeMesh load(const meshfile::Settings& file, const Request& request, meshfile::Reader reader);

}  // namespace squeal::mesh
