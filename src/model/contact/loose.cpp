// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/loose.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {
namespace {

// A small dense problem with six unknowns per connected part of the mesh gives the rigid-body
// modes.

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
  /// Adds the coefficients of factor · direction·θ of part `part`, in the components of a reference
  /// node, to the row.
  void addRotation(std::vector<double>& row, int part, const Point& direction,
                   double factor) const {
    double* a = row.data() + part * perPart_;
    if (dimension_ == 2)
      a[2] += factor / length_ * direction[0];
    else
      for (int k = 0; k < 3; ++k) a[3 + k] += factor / length_ * direction[k];
  }
  /// Adds the coefficients of factor · direction·u(x), for a point x of part `part`, to the row.
  void add(std::vector<double>& row, int part, const Point& x, const Point& direction,
           double factor) const {
    double* a = row.data() + part * perPart_;
    const Point r = mesh::scaled(mesh::minus(x, centre_), 1 / length_);
    for (int d = 0; d < dimension_; ++d) a[d] += factor * direction[d];
    //   direction · (e_k × r), k = 1, 2, 3
    const Point moment = mesh::cross(r, direction);
    if (dimension_ == 2)
      a[2] += factor * moment[2];
    else
      for (int k = 0; k < 3; ++k) a[3 + k] += factor * moment[k];
  }

 private:
  int perPart_, size_, dimension_;
  Point centre_;
  double length_;
};

Point unit(int d) {
  Point e{};
  e[d] = 1;
  return e;
}

/// Collective. Returns the rigid motions about the centre of the mesh, with its largest extent as
/// length.
RigidMotions rigidMotions(const mesh::Mesh& mesh) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (const auto& p : mesh.coordinates)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  mpi::reduce<double>(mesh.comm, low, MPI_MIN);
  mpi::reduce<double>(mesh.comm, high, MPI_MAX);
  double length = 0;
  for (int d = 0; d < 3; ++d) length = std::max(length, high[d] - low[d]);
  return {mesh, {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}, length};
}

/// Adds the coefficients of direction·u of a node of this rank to the row.
void addNode(const mesh::Mesh& mesh, const RigidMotions& motions, PetscInt node,
             const Point& direction, std::vector<double>& row) {
  if (mesh.isRotation(mesh.firstNode + node))
    motions.addRotation(row, mesh.nodePart[node], direction, 1);
  else
    motions.add(row, mesh.nodePart[node], mesh.coordinates[node], direction, 1);
}

/// Adds the coefficients of the terms of an equation on this rank to the row.
void addEquation(const mesh::Mesh& mesh, const RigidMotions& motions,
                 const constraints::EquationSettings& equation, std::vector<double>& row) {
  for (const auto& term : equation.terms) {
    const Point direction =
        mesh::scaled(unit(mesh.dimension == 2 && term.rotation ? 0 : term.component), term.factor);
    if (const PetscInt node = constraints::nodeOf(mesh, term); node >= 0)
      addNode(mesh, motions, node, direction, row);
  }
}

/// Adds the coefficients of component d of the condition of a coupled node to the row.
void addCoupled(const mesh::Mesh& mesh, const RigidMotions& motions,
                const constraints::CoupledNode& coupled, int d, std::vector<double>& row) {
  Point coupledPart = unit(d);  // of the direction d, across the components that stay free
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t e = 0; e < 3; ++e) coupledPart[e] -= coupled.own[d][k] * coupled.own[e][k];
  addNode(mesh, motions, coupled.node, coupledPart, row);
  for (const auto& master : coupled.masters) {
    const Point& direction = master.block[d];
    if (master.isRotation)
      motions.addRotation(row, master.part, direction, -1);
    else
      motions.add(row, master.part, master.position, direction, -1);
  }
}

/// Returns the Gram matrix Σ cᵀc over the rows c of all supports, applied to rigid motions. Springs
/// count as supports, however soft. The null space contains the rigid-body modes.
linalg::DenseMatrix gram(const mesh::Mesh& mesh, const Contact& contact, Vec springs,
                         const RigidMotions& motions, const SupportingContact& holding) {
  const int n = motions.size();
  linalg::DenseMatrix g(n, n);
  std::vector<double> row(n);
  const auto keep = [&] {
    for (int j = 0; j < n; ++j)
      if (row[j] != 0)
        for (int i = 0; i < n; ++i) g(i, j) += row[i] * row[j];
    std::fill(row.begin(), row.end(), 0.0);
  };
  std::optional<ReadArray> spring;
  if (springs) spring.emplace(springs);
  const auto& constraints = contact.interfaces.constraints;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (int d = 0; d < mesh.dimension; ++d) {
      const PetscInt i = mesh.dimension * node + d;
      if (constraints.held[i])
        addNode(mesh, motions, node, constraints.direction(node, d), row), keep();
      if (spring && (*spring)[i] > 0 && !(constraints.held[i] && !constraints.axes.contains(node)))
        addNode(mesh, motions, node, unit(d), row), keep();
    }
  for (const auto& equation : constraints.equations) {
    addEquation(mesh, motions, equation, row);
    mpi::reduce<double>(mesh.comm, row, MPI_SUM);
    if (mpi::rank(mesh.comm) > 0) std::fill(row.begin(), row.end(), 0.0);
    keep();
  }
  for (const auto& coupled : contact.interfaces.coupled)
    for (int d = 0; d < mesh.dimension; ++d) addCoupled(mesh, motions, coupled, d, row), keep();
  for (const auto& image : mesh.images)
    for (int d = 0; d < mesh.dimension; ++d) {
      const auto& x = mesh.coordinates[image.node];
      motions.add(row, mesh.nodePart[image.node], x, unit(d), 1);
      motions.add(row, image.primaryPart, mesh::minus(x, image.shift), unit(d), -1);
      keep();
    }
  for (std::size_t i = 0; holding.any && i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    if (!holding.closed.empty() && !holding.closed[i]) continue;
    const bool sticks =
        node.role == Role::sticking && (holding.released.empty() || !holding.released[i]);
    const int sticking = sticks ? mesh.dimension : 0;
    for (int d = 0; d < sticking; ++d) {
      motions.add(row, mesh.nodePart[node.node], node.position, unit(d), 1);
      for (const auto& [part, share] : node.masterParts)
        motions.add(row, part, node.position, unit(d), -share);
      keep();
    }
    motions.add(row, mesh.nodePart[node.node], node.position, node.normal, 1);
    // Both sides move as at the position of the slave's node: the facets of a curved master would
    // otherwise seem to restrain a free rotation.
    for (const auto& [part, share] : node.masterParts)
      motions.add(row, part, node.position, node.normal, -share);
    keep();
  }
  for (const auto& tied : contact.interfaces.tied) {
    const PetscInt node = tied.connection.node;
    for (int d = 0; d < mesh.dimension; ++d) {
      motions.add(row, mesh.nodePart[node], mesh.coordinates[node], unit(d), 1);
      for (const auto& [part, share] : tied.masterParts)
        motions.add(row, part, mesh.coordinates[node], unit(d), -share);
      keep();
    }
  }
  mpi::reduce<double>(mesh.comm, {g.data(), std::size_t(g.size())}, MPI_SUM);
  return g;
}

/// Returns true if an eigenvalue of the Gram matrix belongs to a rigid-body mode.
bool isFree(double eigenvalue, double largest) {
  // A support that extends over a thousandth of the model still restrains a rotation, with 1e-6 of
  // its weight for a translation.
  return eigenvalue <= 1e-12 * std::max(largest, 1.0);
}

}  // namespace

std::vector<unsigned char> looseParts(const mesh::Mesh& mesh, const Contact& contact, Vec springs,
                                      const SupportingContact& holding) {
  const RigidMotions motions = rigidMotions(mesh);
  linalg::DenseMatrix g = gram(mesh, contact, springs, motions, holding);
  const auto eigenvalues = linalg::symmetricEigen(g);
  std::vector<unsigned char> loose(mesh.parts, 0);
  for (int i = 0; i < motions.size(); ++i)
    for (int k = 0; k < motions.size() && isFree(eigenvalues[k], eigenvalues.back()); ++k)
      if (std::abs(g(i, k)) > 1e-6) loose[i / motions.perPart()] = 1;
  return loose;
}

std::optional<RigidBodyMode> rigidBodyMode(const mesh::Mesh& mesh, const Contact& contact,
                                           Vec springs, const SupportingContact& holding) {
  const RigidMotions motions = rigidMotions(mesh);
  linalg::DenseMatrix g = gram(mesh, contact, springs, motions, holding);
  const auto eigenvalues = linalg::symmetricEigen(g);
  if (!isFree(eigenvalues.front(), eigenvalues.back())) return std::nullopt;
  int worst = 0;
  double most = -1;
  for (int part = 0; part < mesh.parts; ++part) {
    double weight = 0;
    for (int k = 0; k < motions.perPart(); ++k)
      weight += std::pow(g(part * motions.perPart() + k, 0), 2);
    if (weight > most) most = weight, worst = part;
  }
  static constexpr const char* plane[] = {"translation x", "translation y", "rotation z"};
  static constexpr const char* space[] = {"translation x", "translation y", "translation z",
                                          "rotation x",    "rotation y",    "rotation z"};
  const char* const* names = mesh.dimension == 2 ? plane : space;
  std::string motion;
  double sign = 0;  // the sign of an eigenvector is arbitrary; make the first listed part positive
  for (int k = 0; k < motions.perPart(); ++k)
    if (const double part = g(worst * motions.perPart() + k, 0); std::abs(part) > 1e-6) {
      if (sign == 0) sign = std::copysign(1, part);
      motion += formatted(motion.empty() ? "%s: %.3g" : ", %s: %.3g", names[k], sign * part);
    }
  return RigidBodyMode{mesh.partName[worst], motion};
}

void rejectRigidBodyModes(const mesh::Mesh& mesh, const Contact& contact, Vec springs) {
  if (const auto mode = rigidBodyMode(mesh, contact, springs, {}))
    throw Error("singular problem: body '" + mode->body +
                "' can move rigidly with closed frictionless contact (" + mode->motion +
                "); support it with -constraint_<group>_clamped or -ground_<group>_stiffness");
}

}  // namespace squeal::contact
