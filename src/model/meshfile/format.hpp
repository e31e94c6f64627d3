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
  std::string ending;  ///< ending of the file's name, such as ".msh"
  std::string part;    ///< optional part of the gmsh library that reads it; empty if none is needed
};

/// Returns the format of a file. A geometry is recognised by its name, and a mesh or shape by its
/// name and its first line. Throws Error for any other file, since gmsh would run it as a script,
/// and for a file that cannot be read. Also throws Error if there is an options file of gmsh next
/// to the file, since gmsh would run that file as well.
Format requireSound(const std::string& file);

}  // namespace squeal::meshfile
