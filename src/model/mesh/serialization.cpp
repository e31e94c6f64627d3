// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/serialization.hpp"

namespace squeal::mesh {

// A structured binding names all members: one that is missing here does not compile.

void fields(Stream& stream, CellBlock& block) {
  auto& [type, nodesPerCell, nodes, body, tag, material] = block;
  stream(type, nodesPerCell, nodes, body, tag, material);
}

void fields(Stream& stream, FaceBlock& block) {
  auto& [type, nodesPerFace, nodes, surface, sign] = block;
  stream(type, nodesPerFace, nodes, surface, sign);
}

void fields(Stream& stream, InterfaceMatch& match) {
  auto& [label, matching, mismatch, nearlyMatching] = match;
  stream(label, matching, mismatch, nearlyMatching);
}

void fields(Stream& stream, Reference& reference) {
  auto& [name, position, displacement, rotation, part] = reference;
  stream(name, position, displacement, rotation, part);
}

void fields(Stream& stream, MaterialGroup& group) {
  auto& [name, body, isSection] = group;
  stream(name, body, isSection);
}

void fields(Stream& stream, Section& section) {
  auto& [name, normal, reference] = section;
  stream(name, normal, reference);
}

void fields(Stream& stream, Mesh& mesh) {
  auto& [comm, dimension, totalNodes, totalCells, unusedNodes, straightened, diagonal, ownedNodes,
         firstNode, globalNode, coordinates, nodeTag, nodePart, parts, partName, bodies,
         materialGroups, cells, surfaces, faces, nodeGroups, references, sections, sectionPairs,
         layers, layerNodes, images, pairs, interfaces] = mesh;
  stream(dimension, totalNodes, totalCells, unusedNodes, straightened, diagonal, ownedNodes,
         firstNode, globalNode, coordinates, nodeTag, nodePart, parts, partName, bodies,
         materialGroups, cells, surfaces, faces, nodeGroups, references, sections, sectionPairs,
         layers, layerNodes, images, pairs, interfaces);
}

}  // namespace squeal::mesh
