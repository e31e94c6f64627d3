#pragma once
/// Contact carried by one change of variables: u = T x + u0 (trial) and L(f) = T + f E (test).
///
/// z holds, at each pad contact node, tangential displacements and the gap instead of the Cartesian
/// displacement, elsewhere the Cartesian displacement itself. u = A z with n·u_P = n·u_D + g
/// [2.13]; held components and images are dropped from z by a selection B, so T = A B. Friction is
/// a product of two matrices with a row per contact node: N reads the normal force from the nodal
/// forces r, R_N = N r, and the slip rows S read the slip τ·[u] of u = T x, [u] = u_P − u_D. E = Nᵀ
/// S puts the friction of R_N on the tangential rows [3.6]: L(f)ᵀ r = Tᵀ r + f Sᵀ N r, that is R_T
/// = −f R_N τ on the pad, its opposite on the disc.
#include <optional>
#include <string>
#include <vector>

#include "contact/constraints.hpp"
#include "contact/friction.hpp"
#include "elasticity/elasticity.hpp"
#include "mesh/mesh.hpp"
#include "petsc/owned.hpp"

namespace squeal::contact {

using mesh::Point;

/// One contact node of the pad side, owned by this rank, in the order of Mesh::pairs.
struct ContactNode {
  Point position;    ///< m
  Point normal;      ///< n, unit, from disc to pad
  Point slip;        ///< τ = w/|w|, w = −V at the base motions; zero where there is no slip
  double slipSpeed;  ///< |w| at the base motions, m/s
  double area;  ///< ∫ φ dA, m² (m in the plane); zero or negative on tri6 corners and quad8 corners
  double lumpedArea;  ///< share of the faces by the diagonal of their mass, always positive, m²
  int interface;      ///< index into Contact::interfaces
  PetscInt node;      ///< local node
  PetscInt globalNode;
  PetscInt master;  ///< global node of the disc; −1: rigid obstacle
};

/// Sliding of a contact node in steady motion.
struct Slip {
  Point direction{};  ///< τ = w/|w|; zero where |w| = 0
  double speed = 0;   ///< |w|, m/s
  double law = 1;     ///< φ(|w|): the coefficient of friction is f φ
  double slope = 0;   ///< dφ/d|w|, s/m
};

/// Answer of the friction force of one contact node to a change w* of its relative velocity, −B w*
/// [4.7]: B = across (1 − ττᵀ − nnᵀ) + along ττᵀ.
struct VelocityResponse {
  double across = 0;  ///< f R_N φ / |w|, N·s/m; zero in the plane, which has one tangent
  double along = 0;   ///< f R_N dφ/d|w|, N·s/m
};
VelocityResponse velocityResponse(const Slip& slip, double normalForce, double friction,
                                  int dimension);

/// T for one choice of the gaps that are unknowns.
struct Transformation {
  OwnedMat selection;  ///< B, N×n
  OwnedMat trial;      ///< T = A B, N×n
  /// [contact node] global column of its gap; −1 where it is dropped
  std::vector<PetscInt> gapColumn;
  PetscInt ownedColumns = 0, columns = 0;
};

struct Contact {
  std::vector<std::string> interfaces;
  std::vector<std::string> padSurfaces;  ///< [interface]
  std::vector<ContactNode> nodes;
  PetscInt totalNodes = 0;  ///< contact nodes of all ranks
  /// False on faces (tri6, quad8) where nodal complementarity is wrong
  bool weightsPositive = true;
  Constraints constraints;
  FrictionLaw law;
  OwnedMat periodic;  ///< P, N×N: u of images from that of their primaries; the identity elsewhere
  OwnedMat reaction;  ///< N, N×N: R_N of a contact node from all nodal forces, in the row of its
                      ///< gap; others empty
  OwnedMat jump;      ///< J, N×N: [u] = u_P − u_D in the rows of the pad nodes; others empty
  OwnedMat convected;  ///< D, N×N: (V·∇)u_D at the contact nodes, in the rows of the pad nodes, 1/s
                       ///< · m at the base motions; empty without convective terms
  OwnedMat kinematics;  ///< A, N×N
  OwnedVec offset;      ///< u0, N: held displacements and the motion of obstacles
  /// [owned node · dimension + component of z] 1 if an unknown (gaps included)
  std::vector<unsigned char> free;
  const mesh::Mesh* mesh = nullptr;  ///< borrowed

  bool isPadSurface(const std::string& surface) const;
  /// Row of z and of N that belongs to the gap of a contact node.
  PetscInt gapRow(const ContactNode& node) const;
  /// Collective. `gapFree[i]`: the gap of contact node i is an unknown.
  Transformation transformation(const std::vector<unsigned char>& gapFree) const;
  /// True if all points of a sweep slide alike: no convective terms, constant friction law.
  bool slipIsGiven() const { return !convected && law.constant(); }
  /// Collective. w = −v V − v D u_D in the tangent plane [2.15, 4.7] at the speed factor v,
  /// [contact node]; `displacement` u may be null: w = −v V.
  std::vector<Slip> slip(double speed, Vec displacement) const;
  /// Collective. S, N×n: φ τ·[u] of u = T x at the nodes with `slides`, in the rows of their gaps.
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const std::vector<unsigned char>& slides) const;
  /// Collective. B, N×N, diagonal blocks at the pad nodes: the change −B w* of the friction force
  /// with the relative velocity w* [4.7], B = f R_N (φ/|w| (1 − ττᵀ − nnᵀ) + dφ/d|w| ττᵀ), N·s/m.
  OwnedMat velocityResponse(const std::vector<Slip>& slip, const std::vector<double>& normalForce,
                            double friction) const;
};

/// Contact interfaces from the options, for the mesh reader. Error: an interface with neither a
/// disc surface nor an obstacle.
std::vector<mesh::InterfaceRequest> readInterfaces();

/// Collective. Normals, slip directions, constraints and A. Errors: bad constraint, held component
/// that is not tangential on a contact node, obstacle face that is not flat, body that can move
/// rigidly with contact closed (names body and motion).
Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies);

/// Collective. Error, naming position and options, if a node with `active` does not slip: friction
/// has no direction there.
void requireSlip(const Contact& contact, const std::vector<Slip>& slip,
                 const std::vector<unsigned char>& active);

/// A connected part of the mesh that can move without strain.
struct LooseBody {
  std::string body, motion;  ///< names of its bodies; the rigid motion in words
};

/// Collective. The loosest part that neither constraints nor springs (those of Bodies, may be null)
/// hold, nor closed frictionless contact where `contactCloses`; none if all are held.
std::optional<LooseBody> looseBody(const mesh::Mesh& mesh, const Contact& contact, Vec springs,
                                   bool contactCloses);

/// Collective. Error naming the body that can move without strain, if there is one, while contact
/// stays closed without friction.
void rejectLooseBodies(const mesh::Mesh& mesh, const Contact& contact, Vec springs);

}  // namespace squeal::contact
