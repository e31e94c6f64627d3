// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/components.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/attached_parts.hpp"
#include "model/elasticity/ground.hpp"

namespace squeal::energies {
namespace {

using attachments::Form;

constexpr int none = -1, several = -2;

/// Collective. Returns X u; null if X is.
OwnedVec product(Mat x, Vec u) {
  OwnedVec y;
  if (!x) return y;
  check(VecDuplicate(u, y.out()));
  check(MatMult(x, u, y));
  return y;
}

/// Collective. Adds factor · X to a sum, which is created if it is null.
void addScaled(OwnedMat& sum, double factor, Mat x) {
  if (factor == 0) return;
  if (!sum) {
    check(MatDuplicate(x, MAT_COPY_VALUES, sum.out()));
    check(MatScale(sum, factor));
  } else {
    check(MatAXPY(sum, factor, x, DIFFERENT_NONZERO_PATTERN));
  }
}

}  // namespace

Components::Components(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                       const contact::Contact& contact,
                       const std::vector<std::vector<PetscInt>>& nodes, std::vector<OwnModes> own)
    : mesh_(mesh), bodies_(bodies), contact_(contact), mac_(mesh, bodies, nodes) {
  const auto& settings = bodies.settings;
  for (const auto& body : mesh.bodies) list_.push_back({.kind = "body", .name = body});
  firstGround_ = list_.size();
  for (const auto& [group, given] : settings.ground) {
    list_.push_back({.kind = "ground", .name = group});
    ground_.push_back({group, elasticity::groundSprings(mesh, settings, group),
                       elasticity::groundDashpots(mesh, settings, group)});
  }
  firstForm_ = list_.size();
  attached_ = bodies.links;
  const auto masses = attachments::massesOf(mesh, settings.attachments);
  attached_.insert(attached_.end(), masses.begin(), masses.end());
  for (const auto& form : attached_) {
    const auto same = [&](const auto& one) {
      return one.kind == form.kind && one.name == form.name;
    };
    const auto known = std::find_if(list_.begin() + firstForm_, list_.end(), same);
    ofForm_.push_back(known - list_.begin());
    if (known == list_.end()) list_.push_back({.kind = form.kind, .name = form.name});
  }
  const auto& interfaces = contact.interfaces;
  for (std::size_t i = 0; i < interfaces.names.size(); ++i) {
    ofInterface_.emplace_back();
    if (interfaces.options[i].role == contact::Role::tied) continue;
    ofInterface_.back() = list_.size();
    list_.push_back({.kind = "interface", .name = interfaces.names[i]});
  }
  groundDashpots_ = elasticity::groundOf(mesh, settings).dashpots;
  linkDamping_ = elasticity::formMatrix(mesh, bodies.links, &Form::damping);
  pointMass_ = elasticity::formMatrix(mesh, masses, &Form::mass);
  findBodies(nodes);
  if (mpi::any(mesh.comm, !sharedNodes_.empty())) keepSharedRows();
  motions_.emplace(mesh, bodies, nodes, std::move(own));
}

/// Finds the body of each owned node, and the nodes that bodies share.
void Components::findBodies(const std::vector<std::vector<PetscInt>>& nodes) {
  std::vector<int> bodies(mesh_.ownedNodes, 0);  // number of those with the node
  bodyOf_.assign(mesh_.ownedNodes, none);
  for (std::size_t body = 0; body < nodes.size(); ++body)
    for (const PetscInt node : nodes[body])
      bodyOf_[node] = ++bodies[node] > 1 ? several : int(body);
  for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
    if (bodies[node] > 1) sharedNodes_.push_back(node);
}

void Components::keepSharedRows() {
  shared_.resize(mesh_.bodies.size());
  for (int group = 0; group < std::ssize(mesh_.materialGroups); ++group) {
    auto& sum = shared_[mesh_.materialGroups[group].body];
    const auto part = elasticity::materialRows(mesh_, bodies_, group, sharedNodes_);
    const auto& material = bodies_.materials[group];
    addScaled(sum.stiffness, 1, part.stiffness);
    addScaled(sum.mass, 1, part.mass);
    addScaled(sum.damping, material.massDamping, part.mass);
    addScaled(sum.damping, material.stiffnessDamping, part.stiffness);
  }
}

std::vector<Forms> Components::forms(const NodalProducts& products) const {
  const OwnedVec u = elasticity::nodalVector(mesh_);
  {
    const WriteArray values(u);
    std::ranges::copy(products.u, values.begin());
  }
  std::vector<Forms> forms(list_.size());
  addBodies(products, u, forms);
  addShared(u, forms);
  addGround(products.u.data(), forms);
  addLayers(u, forms);
  std::vector<double> sums;
  for (const auto& one : forms) sums.insert(sums.end(), {one.stiffness, one.mass, one.damping});
  mpi::sumAlike(mesh_.comm, sums);
  for (std::size_t i = 0; i < forms.size(); ++i)
    forms[i] = {sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]};
  addForms(u, forms);
  return forms;
}

/// Collective. Adds this rank's sums over the nodes of one body, without the parts of the matrices
/// that belong to no body.
void Components::addBodies(const NodalProducts& products, Vec u, std::vector<Forms>& forms) const {
  const auto add = [&](const double* y, double factor, double Forms::*form) {
    const double* x = products.u.data();
    for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
      for (int d = 0; d < mesh_.dimension && bodyOf_[node] >= 0; ++d) {
        const PetscInt row = mesh_.dimension * node + d;
        forms[bodyOf_[node]].*form += factor * x[row] * y[row];
      }
  };
  const auto remove = [&](Mat part, double Forms::*form) {
    if (const OwnedVec y = product(part, u); y) add(ReadArray(y).data(), -1, form);
  };
  add(products.mass.data(), 1, &Forms::mass);
  remove(pointMass_, &Forms::mass);
  if (!products.stiffness.empty()) {
    add(products.stiffness.data(), 1, &Forms::stiffness);
    for (const Mat part :
         {bodies_.linkStiffness.get(), bodies_.layerStiffness.get(), bodies_.springs.get()})
      remove(part, &Forms::stiffness);
  }
  if (products.damping.empty()) return;
  add(products.damping.data(), 1, &Forms::damping);
  for (const Mat part : {linkDamping_.get(), groundDashpots_.get()}) remove(part, &Forms::damping);
}

/// Collective. Adds this rank's sums over the nodes that bodies share.
void Components::addShared(Vec u, std::vector<Forms>& forms) const {
  for (std::size_t body = 0; body < shared_.size(); ++body) {
    const auto add = [&](Mat matrix, double Forms::*form) {
      if (!matrix) return;
      OwnedVec product;
      check(MatCreateVecs(matrix, nullptr, product.out()));
      check(MatMult(matrix, u, product));
      const ReadArray x(u), y(product);
      PetscInt row = 0;
      for (const PetscInt node : sharedNodes_)
        for (int d = 0; d < mesh_.dimension; ++d)
          forms[body].*form += x[mesh_.dimension * node + d] * y[row++];
    };
    add(shared_[body].stiffness, &Forms::stiffness);
    add(shared_[body].mass, &Forms::mass);
    add(shared_[body].damping, &Forms::damping);
  }
}

/// Adds this rank's sums over springs and dashpots to the ground.
void Components::addGround(const double* x, std::vector<Forms>& forms) const {
  const int dimension = mesh_.dimension;
  for (std::size_t g = 0; g < ground_.size(); ++g) {
    const auto& nodes = mesh_.nodeGroups.at(ground_[g].name);
    const auto sum = [&](const std::vector<mesh::Matrix3>& blocks) {
      double form = 0;
      for (std::size_t n = 0; n < blocks.size(); ++n)
        for (int i = 0; i < dimension; ++i)
          for (int j = 0; j < dimension; ++j)
            form += x[dimension * nodes[n] + i] * blocks[n][i][j] * x[dimension * nodes[n] + j];
      return form;
    };
    forms[firstGround_ + g].stiffness += sum(ground_[g].springs);
    forms[firstGround_ + g].damping += sum(ground_[g].dashpots);
  }
}

/// Collective. Adds this rank's sums over compliant layers. With K = Gᵀ W G, G u the difference
/// u_L − u_P of a layer node and its node on the face, (K u)_L = W G u, so that the energy of an
/// interface is Σ (u_L − u_P)·(K u)_L over its nodes.
void Components::addLayers(Vec u, std::vector<Forms>& forms) const {
  const OwnedVec force = product(bodies_.layerStiffness, u);
  if (!force) return;
  const ReadArray x(u), y(force);
  const int dimension = mesh_.dimension;
  for (const auto& node : contact_.interfaces.nodes) {
    if (!node.hasLayer()) continue;
    for (int d = 0; d < dimension; ++d)
      forms[ofInterface_[node.interface].value()].stiffness +=
          (x[dimension * node.node + d] - x[dimension * node.surfaceNode + d]) *
          y[dimension * node.node + d];
  }
}

/// Collective. Adds springs, bushings and point masses.
void Components::addForms(Vec u, std::vector<Forms>& forms) const {
  const auto delta = elasticity::formValues(mesh_, attached_, u);
  for (std::size_t f = 0; f < attached_.size(); ++f) {
    const double square = delta[f] * delta[f];
    forms[ofForm_[f]].stiffness += attached_[f].stiffness * square;
    forms[ofForm_[f]].mass += attached_[f].mass * square;
    forms[ofForm_[f]].damping += attached_[f].damping * square;
  }
}

}  // namespace squeal::energies
