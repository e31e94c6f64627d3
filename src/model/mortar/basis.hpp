// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The shape functions φ of a face at any point, and the basis φ̃ = Eᵀφ of the slave side, whose
/// integrals are positive. The nodal displacements u of φ and ũ of φ̃ satisfy u = E ũ, edge by edge
/// with a parameter α:
///   u_c = ũ_c at corners,   u_e = (1 − 2α) ũ_e + α (ũ_a + ũ_b) between the corners a and b,
/// so neighbouring faces with the same α agree on ũ. Not collective. Source: Popp, Wohlmuth, Gee
/// and Wall, SIAM J. Sci. Comput. 34 (2012).
#include <array>
#include <span>
#include <vector>

namespace squeal::mortar {

inline constexpr std::size_t mostNodes = 9;  ///< largest number of nodes of a face

/// Reference coordinates of a face, as in gmsh. The second coordinate of a line is zero.
using Reference = std::array<double, 2>;
using NodeValues = std::array<double, mostNodes>;  ///< [node]; zero beyond the nodes of the face

/// A mid-edge node with the corners of its edge.
struct MidEdge {
  int node;
  std::array<int, 2> corners;
};

/// The properties that all faces of one gmsh element type share. Nodes are in gmsh's order:
/// corners, mid-edge nodes, centre.
struct FaceType {
  int type, dimension, order, nodes, corners;
  /// Edges with a node between their corners. A line3 has one.
  std::vector<MidEdge> edges;
  std::vector<Reference> reference;  ///< [node]

  Reference centre() const;
};

/// Returns the type of a face: line2, line3, tri3, tri6, quad4, quad8 or quad9. The reference stays
/// valid. Throws Error for any other type.
const FaceType& faceType(int gmshType);

/// The shape functions of a face at a point.
struct FaceShape {
  NodeValues value{};
  std::array<Reference, mostNodes> gradient{};  ///< [node] in reference coordinates
};

/// Returns the shape functions at a point, inside or outside the face.
FaceShape faceShape(const FaceType& type, const Reference& point);

/// The nodes that carry a multiplier: all nodes, or only the corners for a (bi)linear multiplier.
enum class Multiplier { nodes, corners };

/// The cover of a slave face by the master faces.
enum class Cover { full, partial };

/// Returns α for those edges of a face at which only faces of the same type meet. With this α, ∫φ̃
/// is positive for all pivots (dual.hpp) of fully covered faces, and φ̃ is nonnegative on partly
/// covered tri6 and quad8 faces. On line3 and quad9 faces α is 0, and ∫φ̃ is positive only for a
/// fully covered face. With multipliers at the corners of a straight tri6, the dual functions ψ_p
/// are the linear functions of the corners.
double usualAlpha(const FaceType& type, Cover cover, Multiplier multiplier = Multiplier::nodes);

/// Returns φ̃ from φ at the same point:
///   φ̃_c = φ_c + Σ α_e φ_e over the edges e at the corner c,   φ̃_e = (1 − 2α_e) φ_e.
/// The function of a centre node does not change. `alpha` contains α of each edge, in the order of
/// FaceType::edges.
NodeValues slaveBasis(const FaceType& type, const NodeValues& shape, std::span<const double> alpha);

}  // namespace squeal::mortar
