#pragma once
/// Contact carried by one change of variables: u = T x + u0 (trial) and L(f) = T + f E (test).
///
/// z holds, at each pad contact node, tangential displacements and the gap instead of the Cartesian displacement, elsewhere the
/// Cartesian displacement itself. u = A z with n·u_P = n·u_D + g [2.13]; held components and images are dropped from z by a
/// selection B, so T = A B. E = P S T with S = n τᵀ on [u] = u_P − u_D, and P repeating rows at periodic images, puts the friction
/// of R_N on the tangential rows [3.6]: R_T = −f R_N τ on the pad, its opposite on the disc.
#include <string>
#include <vector>

#include "contact/constraints.hpp"
#include "elasticity/elasticity.hpp"
#include "petsc/owned.hpp"

namespace squeal::contact {

using mesh::Point;

/// One contact node of the pad side, owned by this rank, in the order of Mesh::pairs.
struct ContactNode {
  Point position;    ///< m
  Point normal;      ///< n, unit, from disc to pad
  Point slip;        ///< τ = w/|w|, w = −V; zero where there is no slip
  double slipSpeed;  ///< |w|, m/s
  double area;       ///< ∫ φ dA, m² (m in the plane); zero or negative on tri6 corners and quad8 corners
  int interface;     ///< index into Contact::interfaces
  PetscInt node;     ///< local node
  PetscInt globalNode;
  PetscInt master;  ///< global node of the disc; −1: rigid obstacle
};

/// T, E, u0 for one choice of the gaps that are unknowns and of the nodes that slide.
struct Transformation {
  OwnedMat selection;               ///< B, N×n
  OwnedMat trial;                   ///< T = A B, N×n
  OwnedMat friction;                ///< E = P S T, N×n
  std::vector<PetscInt> gapColumn;  ///< [contact node] global column of its gap; −1 where it is dropped
  PetscInt ownedColumns = 0, columns = 0;
};

struct Contact {
  std::vector<std::string> interfaces;
  std::vector<std::string> padSurfaces;  ///< [interface]
  std::vector<ContactNode> nodes;
  PetscInt totalNodes = 0;      ///< contact nodes of all ranks
  bool weightsPositive = true;  ///< false on faces (tri6, quad8) where nodal complementarity is wrong
  Constraints constraints;
  OwnedMat periodic;                 ///< N×N: u of images from that of their primaries; the identity elsewhere
  OwnedMat kinematics;               ///< A, N×N
  OwnedVec offset;                   ///< u0, N: held displacements and the motion of obstacles
  std::vector<unsigned char> free;   ///< [owned node · dimension + component of z] 1 if an unknown (gaps included)
  const mesh::Mesh* mesh = nullptr;  ///< borrowed

  bool isPadSurface(const std::string& surface) const;
  /// Collective. `gapFree[i]`: the gap of contact node i is an unknown; `slides[i]`: it carries friction.
  Transformation transformation(const std::vector<unsigned char>& gapFree, const std::vector<unsigned char>& slides) const;
};

/// Contact interfaces from the options, for the mesh reader. Error: an interface with neither a disc surface nor an obstacle.
std::vector<mesh::InterfaceRequest> readInterfaces();

/// Collective. Normals, slip directions, constraints and A. Errors: bad constraint, held component that is not tangential on a
/// contact node, obstacle face that is not flat, body that can move rigidly with contact closed (names body and motion).
Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies);

/// Collective. Error, naming position and options, if a node has no slip velocity: friction has no direction there.
void requireSlip(const Contact& contact);

/// Collective. Error naming the body that can move without strain, if there is one, while contact stays closed without friction.
void rejectLooseBodies(const mesh::Mesh& mesh, const Contact& contact);

}  // namespace squeal::contact
