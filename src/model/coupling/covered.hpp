// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The covered parts of the faces of a slave surface, and the basis that follows from them.
#include <string>
#include <vector>

#include "model/coupling/coupling.hpp"
#include "model/coupling/search.hpp"
#include "model/mortar/moments.hpp"

namespace squeal::coupling {

/// The two surfaces of an interface on this rank, and the masters near its slaves. Images of
/// periodic nodes are replaced by their primaries, so that the entries of both meet.
struct Surfaces {
  std::vector<Face> slaves, masters;
  std::vector<std::vector<PetscInt>> localNodes;  ///< [slave][node] local number, not replaced
  std::vector<double> distances;    ///< [slave] largest distance of points that touch, m
  std::vector<Point> translations;  ///< by which the mesh is repeated, m
  Candidates candidates;
};

/// Collective. Finds the surfaces of two groups. The distance is zero for half the size of a face.
Surfaces surfacesOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const std::string& slave,
                    const std::string& master, double searchDistance);

/// Returns the distance within which each face is searched, m. Not collective.
std::vector<double> searchDistances(const std::vector<Face>& faces, double searchDistance);

/// Returns the area of a whole face, m² (m in the plane). Not collective.
double areaOf(const Face& face);

/// A slave face with what covers it. Faces are borrowed from Surfaces.
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

/// The values at the nodes of the slave that decide on the basis φ̃, [local node]. They are the
/// same on all ranks that have the node, and on its images.
struct SlaveBasis {
  std::vector<double> alpha;  ///< of the edge of a mid-edge node
  std::vector<double> whole;  ///< ∫ φ̃ dA over all faces of the slave; zero elsewhere
  std::vector<bool> dropped;  ///< nodes of the slave that carry no condition: too little covered
  PetscInt droppedNodes = 0;  ///< those at faces that are covered in part, on all ranks
  std::vector<PetscInt> droppedOwned;  ///< local numbers of those that this rank owns

  std::vector<double> alphaOf(const CoveredFace& face) const;  ///< [edge]
  std::vector<bool> droppedOf(const CoveredFace& face) const;  ///< [node]
};

/// Collective. Returns α and the nodes to be dropped, the excluded ones, [local node], among them.
/// Partly covered faces need a larger α, on which all faces at an edge agree. A dropped mid-edge
/// node has α = 0, so that ũ = u there; SlaveBasis::whole still has the α before nodes are dropped,
/// with which it is positive.
SlaveBasis chooseBasis(const mesh::Mesh& mesh, const NodeExchange& exchange,
                       const std::vector<CoveredFace>& faces,
                       const std::vector<unsigned char>& excluded);

}  // namespace squeal::coupling
