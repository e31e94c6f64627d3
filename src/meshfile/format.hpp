#pragma once
/// Which files are handed to the gmsh library, and as what. Not collective.
#include <string>

namespace squeal::meshfile {

/// `-mesh_file`: the path to read.
std::string meshFile();

enum class FileKind {
  geometry,  ///< a script: it may read other files and start programs
  msh,       ///< gmsh's own mesh format
  unv,       ///< I-deas universal
  mesh       ///< another mesh format
};

/// gmsh runs as a script whatever it does not know by its ending or first line. Error unless `file`
/// is a geometry by its name, or a mesh by its name and its first line, and no options file of gmsh
/// lies beside it, which gmsh would run as well.
FileKind requireSound(const std::string& file);

}  // namespace squeal::meshfile
