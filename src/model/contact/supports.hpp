// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The supports of the bodies as conditions on displacements, and the rigid motions to which they
/// apply.
#include <functional>
#include <span>
#include <vector>

#include "model/contact/contact.hpp"
#include "model/coupling/coupling.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// The frictionless contact that supports bodies.
struct SupportingContact {
  bool any = true;     ///< false: contact supports nothing
  Mask closed = {};    ///< [contact node] 0 if it is open; empty: all are closed
  Mask released = {};  ///< [contact node] 1 if a sticking node is free along the
                       ///< surface; empty: all stick
};

/// A condition on the displacement of an owned node,
///   d·u(x) − Σ_l w_l d·u_l = 0,
/// with the masters l of contact, a tie or periodicity, or those of a coupling with their blocks.
struct Support {
  PetscInt node;  ///< local node
  Point position, direction;
  Point masterPosition{};  ///< of the masters as points of their parts, see forEachSupport()
  std::span<const coupling::PartShare> masterParts{};
  std::span<const coupling::Weight> masters{};
  std::span<const constraints::CoupledMaster> coupled{};  ///< masters of a coupling
  int component = 0;                                      ///< row of their blocks
};

/// Not collective. Calls `visit` for each condition of constraints, springs (Bodies::springs, may
/// be null), periodicity, ties, couplings and this contact on nodes of this rank. Springs count as
/// supports, however soft. Both sides of contact have the position of the slave's node: the facets
/// of a curved master would otherwise seem to restrain a free rotation.
void forEachSupport(const mesh::Mesh& mesh, const Contact& contact, Mat springs,
                    const SupportingContact& holding,
                    const std::function<void(const Support&)>& visit);

/// Numbers the rigid motions of all parts: for each part 3 translations and 3 rotations (2 and 1 in
/// the plane), with rotations in units of 1/length.
class RigidMotions {
 public:
  RigidMotions(const mesh::Mesh& mesh, Point centre, double length)
      : perPart_(mesh.dimension == 2 ? 3 : 6),
        size_(perPart_ * mesh.parts),
        dimension_(mesh.dimension),
        centre_(centre),
        length_(length) {}
  int size() const { return size_; }
  int perPart() const { return perPart_; }
  /// Adds the coefficients of factor · direction·u(x), for a point x of part `part`, to the row.
  void add(std::vector<double>& row, int part, const Point& x, const Point& direction,
           double factor) const;
  /// Adds the coefficients of factor · direction·θ of part `part`, in the components of a reference
  /// node, to the row.
  void addRotation(std::vector<double>& row, int part, const Point& direction, double factor) const;
  /// Adds the coefficients of factor · direction·u of a node of this rank to the row.
  void addNode(const mesh::Mesh& mesh, PetscInt node, const Point& direction, double factor,
               std::vector<double>& row) const;
  /// Subtracts the coefficients of a component that follows a master of a coupling from the row.
  void addMaster(const constraints::CoupledMaster& master, int component,
                 std::vector<double>& row) const;

 private:
  int perPart_, size_, dimension_;
  Point centre_;
  double length_;
};

/// Collective. Returns the rigid motions about the centre of the mesh, with its largest extent as
/// length.
RigidMotions rigidMotions(const mesh::Mesh& mesh);

/// The Gram matrix Σ cᵀc of rows c of coefficients.
class GramMatrix {
 public:
  explicit GramMatrix(int size) : row(size), sum(size, size) {}
  std::vector<double> row;  ///< the row to add
  linalg::DenseMatrix sum;
  /// Not collective. Adds the row, and clears it.
  void keep();
};

/// Collective. Adds the rows of equations of the options, and of springs and bushings between
/// nodes. Rank 0 adds them all.
void addEquations(const mesh::Mesh& mesh, const Contact& contact, const elasticity::Bodies& bodies,
                  const RigidMotions& motions, GramMatrix& gram);

}  // namespace squeal::contact
