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

/// The format of a file.
struct Format {
  FileKind kind;
  std::string ending;  ///< of the file's name, ".msh"
  std::string part;    ///< part of the gmsh library that reads it; empty if always there
};

/// Returns the format of a file. Throws Error if it cannot be read, and unless it is a geometry by
/// its name, or a mesh or shape by its name and its first line: gmsh runs any other file as a
/// script. Throws Error also if there is an options file of gmsh next to it, which gmsh would run
/// too.
Format requireSound(const std::string& file);

}  // namespace squeal::meshfile
