// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/format.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "base/system/unreadable.hpp"

namespace squeal::meshfile {
namespace {

struct Format {
  const char* ending;
  std::vector<const char*> starts;  ///< beginnings, of which the file has one
  const char* part;  ///< part of the gmsh library that reads it; empty if always there
  FileKind kind;
};

/// Returns the formats that are data.
const std::vector<Format>& formats() {
  const std::vector<const char*> step{"ISO-10303-21"},
      brep{"DBRep_DrawableShape", "CASCADE Topology", "\nCASCADE Topology"}, any{""};
  static const std::vector<Format> list{
      {".msh", {"$MeshFormat"}, "", FileKind::msh},
      {".unv", {"    -1"}, "", FileKind::unv},
      {".med", {"\x89HDF"}, "Med", FileKind::mesh},
      {".cgns", {"\x89HDF", "@(#)ADF"}, "Cgns", FileKind::mesh},
      {".step", step, "OpenCASCADE", FileKind::shape},
      {".stp", step, "OpenCASCADE", FileKind::shape},
      {".brep", brep, "OpenCASCADE", FileKind::shape},
      {".iges", any, "OpenCASCADE", FileKind::shape},  // its reader takes nothing for a script
      {".igs", any, "OpenCASCADE", FileKind::shape}};
  return list;
}

/// Returns the ending of a file name as gmsh sees it: from the last point of the path on. An ending
/// in capitals throughout is returned in small letters.
std::string endingOf(const std::string& file) {
  const auto point = file.rfind('.');
  const std::string ending = point == std::string::npos ? "" : file.substr(point);
  std::string small, capital;
  for (unsigned char c : ending) small += std::tolower(c), capital += std::toupper(c);
  return ending == capital ? small : ending;
}

bool beginsWith(const std::string& file, const std::string& start) {
  std::string begin(start.size(), ' ');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(begin.data(), begin.size()) && begin == start;
}

bool isBuiltIn(const std::string& part) {
  std::string parts;
  gmsh::option::getString("General.BuildOptions", parts);
  const auto list = split(parts, ' ');
  return part.empty() || std::find(list.begin(), list.end(), part) != list.end();
}

[[noreturn]] void refuse(const std::string& file, const std::string& ending) {
  const std::string option = "option -mesh_file " + file + ": ";
  std::vector<std::string> known;
  for (const auto& format : formats())
    if (isBuiltIn(format.part)) known.push_back(format.ending);
  const std::string list = joined(known) + ", and geometries .geo, .geo_unrolled";
  if (ending == ".inp")
    throw Error(option +
                "gmsh writes Abaqus input files but cannot read them; have the mesh written in "
                "another format: " +
                list);
  for (const char* shape : {".stl", ".vtk", ".ply", ".bdf", ".nas", ".mesh"})
    if (ending == shape)
      throw Error(option +
                  "gmsh makes no physical groups of such a file; write a .geo that merges it and "
                  "names them, as in Merge \"x" +
                  shape + "\"; Physical Volume(\"disc\") = {1};");
  throw Error(option + "unknown ending '" + ending + "'; known are " + list);
}

}  // namespace

FileKind requireSound(const std::string& file) {
  const std::string option = "option -mesh_file " + file + ": ", ending = endingOf(file);
  if (const auto why = whyUnreadable(file); !why.empty()) throw Error(option + why);
  if (!std::filesystem::is_regular_file(file)) throw Error(option + "not a regular file");
  const std::string beside = file + ".opt";
  if (std::filesystem::exists(beside))
    throw Error(option + "gmsh would run the script '" + beside + "' next to it; remove it");
  if (ending == ".geo" || ending == ".geo_unrolled") return FileKind::geometry;
  for (const auto& format : formats()) {
    if (ending != format.ending || !isBuiltIn(format.part)) continue;
    if (std::none_of(format.starts.begin(), format.starts.end(),
                     [&](const char* start) { return beginsWith(file, start); }))
      throw Error(option + "not a " + ending + " file: it does not begin with '" +
                  (format.kind == FileKind::mesh ? "HDF" : format.starts[0]) + "'");
    return format.kind;
  }
  refuse(file, ending);
}

}  // namespace squeal::meshfile
