// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/labelled_faces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/boundary.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/element/shape.hpp"

namespace squeal::audit {
namespace {

using Marks = std::vector<unsigned char>;  // [local node]

/// Collective. Returns marks at the nodes whose global numbers any rank has given.
Marks marked(const mesh::Mesh& mesh, const std::vector<PetscInt>& globalNodes) {
  const OwnedVec marks = elasticity::nodalVector(mesh);
  for (const PetscInt node : globalNodes)
    check(VecSetValue(marks, mesh.dimension * node, 1, INSERT_VALUES));
  check(VecAssemblyBegin(marks));
  check(VecAssemblyEnd(marks));
  const auto values = elasticity::localValues(mesh, marks);
  Marks result(mesh.localNodes());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = values[mesh.dimension * i] != 0;
  return result;
}

/// Returns the nodes of this rank that touch or are tied on an interface, and their masters.
std::vector<PetscInt> nodesOf(const Subject& model, int interface) {
  std::vector<PetscInt> nodes;
  const auto add = [&](const interfaces::Connection& connection, PetscInt node) {
    nodes.push_back(model.mesh.globalNode[node]);
    for (const auto& master : connection.masters)
      if (master.value != 0) nodes.push_back(master.node);
  };
  const auto& all = model.contact.interfaces;
  for (std::size_t i = 0; i < all.nodes.size(); ++i)
    if (all.nodes[i].interface == interface) add(all.connections[i], all.nodes[i].surfaceNode);
  for (const auto& tied : all.tied)
    if (tied.interface == interface) add(tied.connection, tied.connection.node);
  return nodes;
}

/// Returns the nodes of the bodies on this rank that a coupling joins to a reference node.
std::vector<PetscInt> coupledNodesOf(const Subject& model, int coupling) {
  std::vector<PetscInt> nodes;
  for (const auto& coupled : model.contact.interfaces.coupled)
    if (coupled.coupling == coupling) {
      nodes.push_back(model.mesh.globalNode[coupled.node]);
      for (const auto& master : coupled.masters) nodes.push_back(master.node);
    }
  return nodes;
}

/// Collective. Returns marks at all nodes that are joined to others.
Marks joinedNodes(const Subject& model) {
  const auto& mesh = model.mesh;
  const auto& all = model.contact.interfaces;
  std::vector<PetscInt> nodes;
  for (int i = 0; i < std::ssize(all.options); ++i) {
    const auto some = nodesOf(model, i);
    nodes.insert(nodes.end(), some.begin(), some.end());
    for (const auto& side : {all.options[i].surfaces.pad, all.options[i].surfaces.disc}) {
      const auto surface = std::ranges::find(mesh.surfaces, side.name) - mesh.surfaces.begin();
      for (const auto& block : mesh.faces)
        for (std::size_t f = 0; f < block.surface.size(); ++f)
          if (block.surface[f] == surface)
            for (const PetscInt node : block.nodesOf(f)) nodes.push_back(mesh.globalNode[node]);
    }
  }
  for (int c = 0; c < std::ssize(all.couplings); ++c) {
    const auto some = coupledNodesOf(model, c);
    nodes.insert(nodes.end(), some.begin(), some.end());
  }
  for (const auto& image : mesh.images) {
    nodes.push_back(mesh.globalNode[image.node]);
    nodes.push_back(image.primary);
  }
  return marked(mesh, nodes);
}

using Key = std::vector<PetscInt>;  // local corners, ascending

Key keyOf(std::span<const PetscInt> nodes, int type) {
  Key key(nodes.begin(), nodes.begin() + element::shapeTable(type).corners);
  std::ranges::sort(key);
  return key;
}

/// Returns the interfaces of the faces of named surfaces on this rank.
std::map<Key, std::set<int>> interfacesOfFaces(const Subject& model) {
  const auto& mesh = model.mesh;
  std::vector<std::vector<int>> ofSurface;
  for (const auto& surface : mesh.surfaces) {
    auto& list = ofSurface.emplace_back();
    const auto& options = model.contact.interfaces.options;
    for (int i = 0; i < std::ssize(options); ++i)
      if (options[i].surfaces.pad.name == surface || options[i].surfaces.disc.name == surface)
        list.push_back(i);
  }
  std::map<Key, std::set<int>> found;
  for (const auto& block : mesh.faces)
    for (std::size_t f = 0; f < block.surface.size(); ++f)
      if (const auto& list = ofSurface[block.surface[f]]; !list.empty())
        found[keyOf(block.nodesOf(f), block.type)].insert(list.begin(), list.end());
  return found;
}

/// The groups of the faces of this rank.
class Groups {
 public:
  /// Collective.
  explicit Groups(const mesh::Mesh& mesh) : names_(mesh.surfaces) {
    for (const auto& block : mesh.faces)
      for (std::size_t f = 0; f < block.surface.size(); ++f)
        surfaces_[keyOf(block.nodesOf(f), block.type)].insert(block.surface[f]);
    for (const auto& [name, nodes] : mesh.nodeGroups) {
      if (mesh.reference(name) || std::ranges::find(mesh.surfaces, name) != mesh.surfaces.end())
        continue;
      std::vector<PetscInt> global;
      for (const PetscInt node : nodes) global.push_back(mesh.firstNode + node);
      names_.push_back(name);
      marks_.push_back(marked(mesh, global));
    }
  }
  std::vector<int> of(const elasticity::BoundaryFace& face) const {
    std::vector<int> found;
    if (const auto named = surfaces_.find(keyOf(face.nodes, face.type)); named != surfaces_.end())
      found.assign(named->second.begin(), named->second.end());
    const int surfaces = int(names_.size() - marks_.size());
    for (int i = 0; i < std::ssize(marks_); ++i)
      if (std::ranges::all_of(face.nodes, [&](PetscInt node) { return marks_[i][node]; }))
        found.push_back(surfaces + i);
    return found;
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::map<Key, std::set<int>> surfaces_;
  std::vector<Marks> marks_;  // [group of nodes]
};

/// Collective. Returns the labels of all ranks, ascending.
std::vector<FaceLabel> gathered(MPI_Comm comm, const std::set<FaceLabel>& own) {
  std::vector<int> numbers;  // of each label the body, and both lists behind their lengths
  for (const auto& label : own) {
    numbers.push_back(label.body);
    for (const auto* list : {&label.interfaces, &label.groups}) {
      numbers.push_back(int(list->size()));
      numbers.insert(numbers.end(), list->begin(), list->end());
    }
  }
  const auto all = concatenated(comm, numbers);
  std::set<FaceLabel> labels;
  for (auto at = all.begin(); at != all.end();) {
    FaceLabel label;
    label.body = *at++;
    for (auto* list : {&label.interfaces, &label.groups}) {
      const int count = *at++;
      list->assign(at, at + count);
      at += count;
    }
    labels.insert(std::move(label));
  }
  return {labels.begin(), labels.end()};
}

}  // namespace

LabelledFaces labelledFaces(const Subject& model) {
  const auto& mesh = model.mesh;
  const auto boundary = elasticity::boundaryFaces(mesh);
  const Marks joined = joinedNodes(model);
  std::vector<Marks> touching;  // [interface], then [coupling]
  const auto& all = model.contact.interfaces;
  for (int i = 0; i < std::ssize(all.options); ++i)  // meshes that do not match have two groups
    touching.push_back(all.reports[i].matching && !all.options[i].onObstacle()
                           ? marked(mesh, nodesOf(model, i))
                           : Marks(mesh.localNodes()));
  for (int c = 0; c < std::ssize(all.couplings); ++c)
    touching.push_back(marked(mesh, coupledNodesOf(model, c)));
  const auto named = interfacesOfFaces(model);
  const Groups groups(mesh);
  std::vector<FaceLabel> own;
  for (const auto& face : boundary) {
    const Key key = keyOf(face.nodes, face.type);
    std::set<int> interfaces;
    if (const auto found = named.find(key); found != named.end()) interfaces = found->second;
    for (int i = 0; i < std::ssize(touching); ++i)
      if (std::ranges::all_of(face.nodes, [&](PetscInt node) { return touching[i][node]; }))
        interfaces.insert(i);
    own.push_back({face.body, {interfaces.begin(), interfaces.end()}, groups.of(face)});
  }
  LabelledFaces result;
  result.labels = gathered(mesh.comm, {own.begin(), own.end()});
  result.groups = groups.names();
  for (std::size_t f = 0; f < boundary.size(); ++f) {
    const auto& given = boundary[f];
    auto& face = result.faces.emplace_back();
    auto& marks = result.joined.emplace_back();
    face.type = given.type, face.sign = given.sign;
    face.body = std::ranges::lower_bound(result.labels, own[f]) - result.labels.begin();
    for (const PetscInt node : given.nodes) {
      face.nodes.push_back(mesh.globalNode[node]);
      face.parts.push_back(mesh.nodePart[node]);
      face.points.push_back(mesh.coordinates[node]);
      marks.push_back(joined[node]);
    }
  }
  return result;
}

}  // namespace squeal::audit
