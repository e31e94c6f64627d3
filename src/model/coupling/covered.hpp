// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The covered parts of the faces of a slave surface, and the resulting basis.
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/coupling/search.hpp"
#include "model/mortar/moments.hpp"

namespace squeal::coupling {

/// The two surfaces of an interface on this rank, and the masters near its slaves. Primaries
/// replace the images of periodic nodes, so both contribute to the same entries.
struct Surfaces {
  std::vector<Face> slaves, masters;
  std::vector<std::vector<PetscInt>> localNodes;  ///< [slave][node] local number, not replaced
  std::vector<double> distances;    ///< [slave] largest distance of touching points, m
  std::vector<Point> translations;  ///< periods of the mesh, m
  Candidates candidates;
};

/// Collective. Finds the surfaces of two groups. A distance of zero means half the size of a face.
Surfaces surfacesOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const std::string& slave,
                    const std::string& master, double searchDistance);

/// Returns the search distance of each face, m. Not collective.
std::vector<double> searchDistances(const std::vector<Face>& faces, double searchDistance);

/// Returns the area of a whole face, m² (m in the plane). Not collective.
double areaOf(const Face& face);

/// A slave face with the master faces that cover it. Faces are borrowed from Surfaces.
struct CoveredFace {
  const Face* face;
  const mortar::FaceType* type;
  std::vector<PetscInt> local;  ///< [node] local number
  std::vector<const Face*> masters;
  mortar::FaceMoments moments;
  double area = 0;  ///< m² (m in the plane)
};

/// Collective. Returns all slave faces of this rank, integrated. `velocity` may be empty. Throws
/// Error, naming the surface, if one is so strongly curved that it cannot be projected.
std::vector<CoveredFace> cover(MPI_Comm comm, const Surfaces& surfaces, const std::string& slave,
                               const BodyVelocity& velocity);

/// The values at the nodes of the slave that define the basis φ̃, [local node]. They are equal on
/// all ranks that have the node, and on its images.
struct SlaveBasis {
  std::vector<double> alpha;  ///< of the edge of a mid-edge node
  std::vector<double> whole;  ///< ∫ φ̃ dA over all faces of the slave; zero elsewhere
  std::vector<bool> dropped;  ///< nodes of the slave without a condition: too little covered
  PetscInt droppedNodes = 0;  ///< dropped nodes at partly covered faces, on all ranks
  std::vector<PetscInt> droppedOwned;  ///< local numbers of the dropped nodes of this rank

  std::vector<double> alphaOf(const CoveredFace& face) const;  ///< [edge]
  std::vector<bool> droppedOf(const CoveredFace& face) const;  ///< [node]
};

/// Collective. Returns α and the dropped nodes, including the excluded ones, [local node]. Partly
/// covered faces need a larger α, the same for all faces at an edge. A dropped mid-edge node has α
/// = 0, hence ũ = u there. SlaveBasis::whole uses the α before nodes are dropped, with which it is
/// positive.
SlaveBasis chooseBasis(const mesh::Mesh& mesh, const NodeExchange& exchange,
                       const std::vector<CoveredFace>& faces,
                       const std::vector<unsigned char>& excluded);

}  // namespace squeal::coupling
