// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A job for gmsh, with the results of the checks of its file.
#include <string>
#include <vector>

#include "model/meshfile/format.hpp"
#include "model/meshfile/msh.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::meshfile {

/// A file to read or mesh.
struct Job {
  std::string file, option;  ///< option: the beginning of messages, which names the option
  Format format;
  std::vector<GeometryParameter> parameters;
  ShapeMesh shape;       ///< for a shape
  MshContents contents;  ///< for a .msh; for a .unv only the numbers of nodes and elements

  bool isMeshedHere() const {
    return format.kind == FileKind::geometry || format.kind == FileKind::shape;
  }
  /// Returns true for a .msh file of version 2, which gives each element one group and one entity.
  /// gmsh would put all elements of an entity into all groups of the entity, so it must treat the
  /// groups as the entities.
  bool groupsAreEntities() const { return format.kind == FileKind::msh && contents.version < 4; }
};

}  // namespace squeal::meshfile
