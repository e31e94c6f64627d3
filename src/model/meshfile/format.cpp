// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/format.hpp"

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

struct Known {
  const char* ending;
  std::vector<const char*> starts;  ///< the file has one of these beginnings
  const char* part;                 ///< see Format
  FileKind kind;
};

/// Returns the formats that are data.
const std::vector<Known>& formats() {
  const std::vector<const char*> step{"ISO-10303-21"},
      brep{"DBRep_DrawableShape", "CASCADE Topology", "\nCASCADE Topology"}, any{""};
  static const std::vector<Known> list{
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

[[noreturn]] void refuse(const std::string& file, const std::string& ending) {
  const std::string option = "option -mesh_file " + file + ": ";
  std::vector<std::string> known, rare;
  for (const auto& format : formats())
    (format.kind == FileKind::mesh ? rare : known).push_back(format.ending);
  const std::string list = joined(known) + ", geometries .geo, .geo_unrolled, and " + joined(rare) +
                           " if gmsh was built for them";
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

Format requireSound(const std::string& file) {
  const std::string option = "option -mesh_file " + file + ": ", ending = endingOf(file);
  if (const auto why = whyUnreadable(file); !why.empty()) throw Error(option + why);
  if (!std::filesystem::is_regular_file(file)) throw Error(option + "not a regular file");
  const std::string script = file + ".opt";
  if (std::filesystem::exists(script))
    throw Error(option + "gmsh would run the script '" + script + "' next to it; remove it");
  if (ending == ".geo" || ending == ".geo_unrolled") return {FileKind::geometry, ending, ""};
  for (const auto& format : formats()) {
    if (ending != format.ending) continue;
    if (std::none_of(format.starts.begin(), format.starts.end(),
                     [&](const char* start) { return beginsWith(file, start); }))
      throw Error(option + "not a " + ending + " file: it does not begin with '" +
                  (format.kind == FileKind::mesh ? "HDF" : format.starts[0]) + "'");
    return {format.kind, ending, format.part};
  }
  refuse(file, ending);
}

}  // namespace squeal::meshfile
