// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/serialization.hpp"

namespace squeal::meshfile {

// A structured binding names all members: one that is missing here does not compile.

void fields(Stream& stream, ElementBlock& block) {
  auto& [type, nodesPerElement, corners, nodes, label, tag, typeName, material] = block;
  stream(type, nodesPerElement, corners, nodes, label, tag, typeName, material);
}

void fields(Stream& stream, GroupElements& group) {
  auto& [dimension, blocks] = group;
  stream(dimension, blocks);
}

void fields(Stream& stream, Contents& contents) {
  auto& [points, tags, groups, dimension, ungrouped, atPoint, droppedNodes] = contents;
  stream(points, tags, groups, dimension, ungrouped, atPoint, droppedNodes);
}

void fields(Stream& stream, Format& format) {
  auto& [kind, ending, part] = format;
  stream(kind, ending, part);
}

void fields(Stream& stream, GeometryParameter& parameter) {
  auto& [name, value] = parameter;
  stream(name, value);
}

void fields(Stream& stream, ShapeMesh& shape) {
  auto& [size, order, given] = shape;
  stream(size, order, given);
}

void fields(Stream& stream, Job& job) {
  auto& [file, option, format, parameters, shape, contents] = job;
  stream(file, option, format, parameters, shape, contents);
}

}  // namespace squeal::meshfile
