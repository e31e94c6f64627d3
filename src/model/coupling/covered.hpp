// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The covered parts of the faces of a slave surface, and the resulting basis.
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/coupling/search.hpp"
#include "model/mortar/moments.hpp"

namespace squeal::coupling {

/// The faces of the two surfaces of an interface on this rank, and the master faces near the slave
/// faces. A node that is a periodic image has the number of its primary, so both contribute to the
/// same entries.
struct Surfaces {
  std::vector<Face> slaves, masters;
  /// [slave][node] local number; an image has its own
  std::vector<std::vector<PetscInt>> localNodes;
  std::vector<double> distances;    ///< [slave] largest distance of touching points, m
  std::vector<Point> translations;  ///< see translations() in periodic.hpp, m
  Candidates candidates;
};

/// Collective. Finds the surfaces of two groups. If `searchDistance` is zero, it is half the size
/// of each face.
Surfaces surfacesOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const std::string& slave,
                    const std::string& master, double searchDistance);

/// Returns the search distance of each face, m. Not collective.
std::vector<double> searchDistances(const std::vector<Face>& faces, double searchDistance);

/// Returns the area of a whole face, m² (m in plane problems). Not collective.
double areaOf(const Face& face);

/// A slave face with the master faces that cover it. Faces are borrowed from Surfaces.
struct CoveredFace {
  const Face* face;
  const mortar::FaceType* type;
  std::vector<PetscInt> local;  ///< [node] local number
  std::vector<const Face*> masters;
  mortar::FaceMoments moments;
  double area = 0;  ///< m² (m in plane problems)
};

/// Collective. Returns all slave faces of this rank with their integrals. `velocity` may be empty.
/// Throws Error, naming the surface, if a face is so strongly curved that it cannot be projected.
std::vector<CoveredFace> cover(MPI_Comm comm, const Surfaces& surfaces, const std::string& slave,
                               const BodyVelocity& velocity);

/// The values at the nodes of the slave that define the basis φ̃, [local node]. They are equal on
/// all ranks that have the node, and on its images.
struct SlaveBasis {
  std::vector<double> alpha;  ///< at a mid-edge node: α of its edge (see mortar/basis.hpp)
  std::vector<double> whole;  ///< ∫ φ̃ dA over all faces of the slave; zero elsewhere
  /// Nodes of the slave without a condition: excluded, or too little covered.
  std::vector<bool> dropped;
  /// Dropped nodes at faces that are at least partly covered, on all ranks.
  PetscInt droppedNodes = 0;
  std::vector<PetscInt> droppedOwned;  ///< dropped nodes of this rank at such faces

  std::vector<double> alphaOf(const CoveredFace& face) const;  ///< [edge]
  std::vector<bool> droppedOf(const CoveredFace& face) const;  ///< [node]
};

/// Collective. Returns α and the dropped nodes, including the nodes with excluded[local node] set.
/// Partly covered faces need a larger α, and α must be the same for all faces at an edge. A dropped
/// mid-edge node has α = 0, hence ũ = u at this node. SlaveBasis::whole is computed before nodes
/// are dropped, since it is positive with the values of α at that time.
SlaveBasis chooseBasis(const mesh::Mesh& mesh, const NodeExchange& exchange,
                       const std::vector<CoveredFace>& faces,
                       const std::vector<unsigned char>& excluded);

}  // namespace squeal::coupling
