// SPDX-License-Identifier: BSD-2-Clause
#include "model/constraints/couplings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/frame/frame.hpp"

namespace squeal::constraints {
namespace {

using mesh::minus;

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Matrix3 scaled(Matrix3 a, double factor) {
  for (auto& row : a)
    for (auto& x : row) x *= factor;
  return a;
}

Matrix3 sum(Matrix3 a, const Matrix3& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) a[i][j] += b[i][j];
  return a;
}

/// Returns the matrix of r × u.
Matrix3 crossMatrix(const Point& r) {
  return {{{0, -r[2], r[1]}, {r[2], 0, -r[0]}, {-r[1], r[0], 0}}};
}

/// Returns the columns of a matrix that acts on a rotation in the components of a reference node:
/// in the plane that about z is the first.
Matrix3 onRotation(const Matrix3& matrix, int dimension) {
  if (dimension == 3) return matrix;
  Matrix3 columns{};
  for (std::size_t i = 0; i < 3; ++i) columns[i][0] = matrix[i][2];
  return columns;
}

/// Returns the rows of a matrix that gives a rotation, likewise.
Matrix3 ofRotation(const Matrix3& matrix, int dimension) {
  if (dimension == 3) return matrix;
  Matrix3 rows{};
  rows[0] = matrix[2];
  return rows;
}

std::string head(const CouplingSettings& coupling) {
  return "option " + couplingNodesName(coupling.name) + ": ";
}

/// Collects the coupled nodes.
class Couplings {
 public:
  Couplings(const mesh::Mesh& mesh, const Settings& settings) : mesh_(mesh), settings_(settings) {}
  void addRigid(int coupling);
  void addDistributed(int coupling);
  void addSections();
  void rejectImages(const CouplingSettings& coupling) const;
  std::vector<CoupledNode> finish();

 private:
  void add(CoupledNode node, std::string& failure);
  CoupledNode follower(PetscInt node, int coupling, const Matrix3& axes,
                       const std::string& components, const mesh::Reference& reference) const;
  void addFollowingRotation(const std::string& group, int coupling,
                            const mesh::Reference& reference, std::string& failure);
  CoupledMaster rotationOf(const mesh::Reference& reference, const Matrix3& block) const {
    return {reference.rotation, onRotation(block, mesh_.dimension), reference.part,
            reference.position, true};
  }

  const mesh::Mesh& mesh_;
  const Settings& settings_;
  std::map<PetscInt, CoupledNode> nodes_;  // [local node]
};

/// Collective. Throws Error if a node of a group has a periodic image: the two would move apart as
/// the reference node turns.
void Couplings::rejectImages(const CouplingSettings& coupling) const {
  std::vector<PetscInt> own;
  for (const auto& image : mesh_.images) own.push_back(image.primary);
  const auto all = concatenated(mesh_.comm, own);
  const std::set<PetscInt> primaries(all.begin(), all.end());
  std::string failure;
  for (const auto& group : coupling.groups)
    for (const PetscInt node : mesh_.nodeGroups.at(group))
      if (primaries.contains(mesh_.firstNode + node))
        failure = head(coupling) + "the node at " + mesh::text(mesh_.coordinates[node]) +
                  " of group '" + group +
                  "' has a periodic image, which does not turn with a reference node; take such "
                  "nodes out of the group";
  failTogether(mesh_.comm, failure);
}

void Couplings::add(CoupledNode node, std::string& failure) {
  const auto [at, isNew] = nodes_.try_emplace(node.node, node);
  if (isNew || at->second.coupling == node.coupling) return;
  const auto names = couplingNames(settings_);
  failure = names[node.coupling].label() + ": the node at " +
            mesh::text(mesh_.coordinates[node.node]) + " follows " +
            names[at->second.coupling].label() +
            " already; a node can follow one coupling: take it out of one group, or couple the "
            "reference nodes";
}

/// Returns a node that follows the reference node in these components of the axes.
CoupledNode Couplings::follower(PetscInt node, int coupling, const Matrix3& axes,
                                const std::string& components,
                                const mesh::Reference& reference) const {
  CoupledNode found{.node = node, .coupling = coupling};
  Matrix3 follows{};
  for (int k = 0; k < mesh_.dimension; ++k) {
    const bool isCoupled = components.find(char('x' + k)) != std::string::npos;
    found.free[k] = !isCoupled;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!isCoupled) found.own[i][k] = axes[k][i];
      for (std::size_t j = 0; isCoupled && j < 3; ++j) follows[i][j] += axes[k][i] * axes[k][j];
    }
  }
  //   θ × r = −r × θ
  const Point r = minus(mesh_.coordinates[node], reference.position);
  found.masters = {{reference.displacement, follows, reference.part, reference.position, false},
                   rotationOf(reference, scaled(product(follows, crossMatrix(r)), -1))};
  return found;
}

void Couplings::addFollowingRotation(const std::string& group, int coupling,
                                     const mesh::Reference& reference, std::string& failure) {
  const mesh::Reference* slave = mesh_.reference(group);
  if (!slave || settings_.couplings[coupling].pinned) return;
  const PetscInt node = mesh_.ownedNode(slave->rotation);
  if (node < 0) return;
  CoupledNode found{.node = node, .coupling = coupling};
  found.masters = {rotationOf(reference, ofRotation(mesh::identity3, mesh_.dimension))};
  if (mesh_.dimension == 2) found.masters[0].block = {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  add(found, failure);
}

void Couplings::addRigid(int coupling) {
  const auto& given = settings_.couplings[coupling];
  const mesh::Reference& reference = *mesh_.reference(given.reference);
  const auto frame =
      frame::named(settings_.frames, given.frame, couplingFrameName(given.name), mesh_);
  const std::string allowed = std::string("xyz").substr(0, mesh_.dimension);
  // In the plane all components are x and y.
  const std::string components = given.components == "xyz" ? allowed : given.components;
  if (components.empty() || components.find_first_not_of(allowed) != std::string::npos)
    throw Error("option " + couplingComponentsName(given.name) + " " + given.components +
                ": must be some of the letters " + allowed);
  std::string failure;
  for (const auto& group : given.groups) try {
      for (PetscInt node : mesh_.nodeGroups.at(group))
        add(follower(node, coupling, frame.axesAt(mesh_.coordinates[node]), components, reference),
            failure);
      addFollowingRotation(group, coupling, reference, failure);
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(mesh_.comm, failure);
}

/// A node that determines the motion of the reference node of a distributed coupling.
struct WeightedNode {
  PetscInt node = -1;  // global
  int part = -1;
  Point position{};
  double weight = 0;
};

/// Returns T⁻¹. Throws Error, naming the coupling, if the nodes do not determine all rotations.
Matrix3 inverseInertia(const std::vector<WeightedNode>& nodes, const Point& centre, int dimension,
                       const CouplingSettings& coupling) {
  const int n = dimension == 3 ? 3 : 1;
  linalg::DenseMatrix t(n, n);
  for (const auto& [node, part, position, weight] : nodes) {
    const Point r = minus(position, centre);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        t(i, j) += n == 1 ? weight * mesh::dot(r, r)
                          : weight * ((i == j ? mesh::dot(r, r) : 0.0) - r[i] * r[j]);
  }
  const auto eigenvalues = linalg::symmetricEigen(t);  // t has the eigenvectors then
  if (!(eigenvalues.front() > 1e-10 * eigenvalues.back()) || eigenvalues.back() == 0)
    throw Error(head(coupling) + "its " + std::to_string(nodes.size()) +
                " nodes lie on a line or in a point and do not determine the rotation of the "
                "reference node; add nodes");
  Matrix3 inverse{};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        inverse[n == 1 ? 2 : i][n == 1 ? 2 : j] += t(i, k) * t(j, k) / eigenvalues[k];
  return inverse;
}

/// Collective. Returns the nodes of all groups and ranks with their weights; a node of several
/// groups has the sum of theirs.
std::vector<WeightedNode> weightedNodes(const mesh::Mesh& mesh, const CouplingSettings& coupling) {
  std::map<PetscInt, WeightedNode> own;
  for (std::size_t g = 0; g < coupling.groups.size(); ++g)
    for (PetscInt node : mesh.nodeGroups.at(coupling.groups[g])) {
      const PetscInt global = mesh.firstNode + node;
      auto& found = own[global];
      found = {global, mesh.nodePart[node], mesh.coordinates[node],
               found.weight + coupling.weights[g]};
    }
  std::vector<WeightedNode> list;
  for (const auto& [global, node] : own) list.push_back(node);
  return concatenated(mesh.comm, list);
}

void Couplings::addDistributed(int coupling) {
  const auto& given = settings_.couplings[coupling];
  const mesh::Reference& reference = *mesh_.reference(given.reference);
  auto nodes = weightedNodes(mesh_, given);
  double total = 0;
  for (const auto& node : nodes) total += node.weight;
  Point centre{};
  for (auto& node : nodes) {
    node.weight /= total;
    centre = mesh::plus(centre, node.position, node.weight);
  }
  const Matrix3 inverse = inverseInertia(nodes, centre, mesh_.dimension, given),
                arm = crossMatrix(minus(reference.position, centre));
  CoupledNode displacement{
      .node = mesh_.ownedNode(reference.displacement), .coupling = coupling, .distributed = true},
      rotation{
          .node = mesh_.ownedNode(reference.rotation), .coupling = coupling, .distributed = true};
  for (const auto& [node, part, position, weight] : nodes) {
    const Matrix3 turns = scaled(product(inverse, crossMatrix(minus(position, centre))), weight);
    //   θ × s = −s × θ
    const Matrix3 moves = sum(scaled(mesh::identity3, weight), scaled(product(arm, turns), -1));
    displacement.masters.push_back({node, moves, part, position, false});
    rotation.masters.push_back({node, ofRotation(turns, mesh_.dimension), part, position, false});
  }
  std::string failure;
  if (displacement.node >= 0) add(displacement, failure), add(rotation, failure);
  failTogether(mesh_.comm, failure);
}

/// Adds the upper nodes of the sections of bolts, which follow the lower ones and the opening.
void Couplings::addSections() {
  std::string failure;
  for (const auto& [node, lower, section, lowerPart] : mesh_.sectionPairs) {
    const auto& reference = mesh_.references[mesh_.sections[section].reference];
    CoupledNode found{.node = node, .coupling = int(std::ssize(settings_.couplings)) + section};
    found.masters = {
        {lower, mesh::identity3, lowerPart, mesh_.coordinates[node], false},
        {reference.displacement, mesh::identity3, reference.part, reference.position, false}};
    add(found, failure);
  }
  failTogether(mesh_.comm, failure);
}

std::vector<CoupledNode> Couplings::finish() {
  std::vector<CoupledNode> list;
  for (auto& [node, coupled] : nodes_) list.push_back(std::move(coupled));
  return list;
}

}  // namespace

std::vector<CouplingName> couplingNames(const Settings& settings) {
  std::vector<CouplingName> names;
  for (const auto& coupling : settings.couplings) names.push_back({"coupling", coupling.name});
  for (const auto& bolt : settings.bolts) names.push_back({"bolt", bolt.name});
  return names;
}

std::vector<CoupledNode> coupledNodes(const mesh::Mesh& mesh, const Settings& settings) {
  Couplings couplings(mesh, settings);
  for (int i = 0; i < std::ssize(settings.couplings); ++i) {
    const auto& coupling = settings.couplings[i];
    for (const auto& group : coupling.groups)
      if (mpi::sum(mesh.comm, PetscInt(mesh.nodeGroups.at(group).size())) == 0)
        throw Error(head(coupling) + "group '" + group + "' has no nodes");
    couplings.rejectImages(coupling);
    if (coupling.kind == CouplingKind::rigid)
      couplings.addRigid(i);
    else
      couplings.addDistributed(i);
  }
  couplings.addSections();
  return couplings.finish();
}

}  // namespace squeal::constraints
