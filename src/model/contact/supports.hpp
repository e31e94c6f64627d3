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

/// The frictionless contact that supports the bodies.
struct SupportingContact {
  bool any = true;     ///< false: contact supports nothing
  Mask closed = {};    ///< [contact node] 0 if it is open; empty: all are closed
  Mask released = {};  ///< [contact node] 1 if a sticking node is free along the
                       ///< surface; empty: all stick
};

/// A condition on the displacement of an owned node at x in the direction d,
///   d·u(x) − Σ_l w_l d·u_l = 0,
/// where l are the masters of contact, a tie or periodicity. A coupling has other masters, with
/// blocks in place of the weights w_l.
struct Support {
  PetscInt node;  ///< local node
  Point position, direction;
  Point masterPosition{};  ///< position at which the masters are assumed to lie (see
                           ///< forEachSupport())
  std::span<const coupling::PartShare> masterParts{};
  std::span<const coupling::Weight> masters{};
  std::span<const constraints::CoupledMaster> coupled{};  ///< masters of a coupling
  int component = 0;                                      ///< row of their blocks
};

/// Not collective. Calls `visit` for each condition that constraints, springs, periodicity, ties,
/// couplings and this contact impose on nodes of this rank. `springs` is Bodies::springs, which may
/// be null; even the softest springs are treated as supports. The masters of a contact or tied node
/// are assumed to lie at the position of this node. Otherwise the facets of a curved master would
/// seem to restrain a rotation that is free.
void forEachSupport(const mesh::Mesh& mesh, const Contact& contact, Mat springs,
                    const SupportingContact& holding,
                    const std::function<void(const Support&)>& visit);

/// Numbers the rigid motions of all parts: for each part 3 translations and 3 rotations (2 and 1 in
/// plane problems), with rotations in units of 1/length.
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
  /// Adds to the row the coefficients of factor · direction·u(x) for a point x of part `part`.
  void add(std::vector<double>& row, int part, const Point& x, const Point& direction,
           double factor) const;
  /// Adds to the row the coefficients of factor · direction·θ for part `part`. `direction` is in
  /// the components of a reference node.
  void addRotation(std::vector<double>& row, int part, const Point& direction, double factor) const;
  /// Adds to the row the coefficients of factor · direction·u for a node of this rank.
  void addNode(const mesh::Mesh& mesh, PetscInt node, const Point& direction, double factor,
               std::vector<double>& row) const;
  /// Subtracts from the row the coefficients of a master of a coupling, for one component of the
  /// node that follows it.
  void addMaster(const constraints::CoupledMaster& master, int component,
                 std::vector<double>& row) const;

 private:
  int perPart_, size_, dimension_;
  Point centre_;
  double length_;
};

/// Collective. Returns the rigid motions about the centre of the mesh. The unit of length is the
/// largest extent of the mesh.
RigidMotions rigidMotions(const mesh::Mesh& mesh);

/// The Gram matrix Σ cᵀc of rows c of coefficients.
class GramMatrix {
 public:
  explicit GramMatrix(int size) : row(size), sum(size, size) {}
  std::vector<double> row;  ///< c, the next row to add
  linalg::DenseMatrix sum;
  /// Not collective. Adds cᵀc to the sum, and sets the row to zero.
  void keep();
};

/// Collective. Adds the rows of the equations from options, and of springs and bushings between
/// nodes. Rank 0 adds all of them.
void addEquations(const mesh::Mesh& mesh, const Contact& contact, const elasticity::Bodies& bodies,
                  const RigidMotions& motions, GramMatrix& gram);

}  // namespace squeal::contact
