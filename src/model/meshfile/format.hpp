// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Kinds of the files that are passed to the gmsh library. Not collective.
#include <string>

namespace squeal::meshfile {

enum class FileKind {
  geometry,  ///< a script: it may read other files and start programs
  shape,     ///< of a CAD program: STEP, IGES or BREP
  msh,       ///< gmsh's own mesh format
  unv,       ///< I-deas universal
  mesh       ///< another mesh format
};

/// Returns the kind of a file. Throws Error if it cannot be read, and unless it is a geometry by
/// its name, or a mesh or shape by its name and its first line: gmsh runs any other file as a
/// script. Throws Error also if an options file of gmsh lies beside it, which gmsh would run too.
FileKind requireSound(const std::string& file);

}  // namespace squeal::meshfile
