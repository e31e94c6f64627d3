// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/gmsh_model.hpp"

#include <filesystem>
#include <optional>

#include "base/system/child_limits.hpp"
#include "base/system/error.hpp"
#include "base/system/process_memory.hpp"
#include "base/system/text.hpp"
#include "model/meshfile/job.hpp"
#include "model/meshfile/unv.hpp"

namespace squeal::mesh {
namespace {

/// Returns the limits of the child process. Meshing may take any time and all free memory. The
/// limits for a mesh file follow from its size, as it may be damaged in ways that the checks miss.
ChildLimits limitsFor(const meshfile::Job& job) {
  const std::string subject = job.option.substr(0, job.option.rfind(':'));
  const double free = availableMemory();
  const std::string tooLarge =
      formatted("its mesh needs more than the %.3g GB of memory that are free", free / 1e9);
  if (job.isMeshedHere()) return {subject, {}, free, tooLarge, "gmsh"};
  const double size = std::filesystem::file_size(job.file);
  const double seconds = 5 + 5e-6 * size,
               enough = 5e8 + 100 * size;  // it takes some 15 bytes for a byte of the file
  if (enough > free) return {subject, seconds, free, tooLarge, "gmsh"};
  return {subject, seconds, enough,
          "it asks for more room than a file of its size can fill: it is damaged", "gmsh"};
}

}  // namespace

GmshModel::GmshModel(const meshfile::Settings& settings, meshfile::Reader reader) {
  const std::string& file = settings.file;
  meshfile::Job job{.file = file,
                    .option = "option -mesh_file " + file + ": ",
                    .format = meshfile::requireSound(file),
                    .parameters = settings.parameters,
                    .shape = settings.shape,
                    .contents = {}};
  if (job.format.kind != meshfile::FileKind::shape) meshfile::rejectShapeMesh(file, job.shape);
  if (!job.parameters.empty() && job.format.kind != meshfile::FileKind::geometry)
    throw Error("option -mesh_set: only a geometry, a .geo file, has parameters; -mesh_file " +
                file + " is a " +
                (job.format.kind == meshfile::FileKind::shape ? "shape" : "mesh"));
  if (job.format.kind == meshfile::FileKind::msh) job.contents = meshfile::requireSoundMsh(file);
  std::optional<meshfile::UnvCopy> copy;
  if (job.format.kind == meshfile::FileKind::unv) {
    const meshfile::UnvContents contents = meshfile::requireSoundUnv(file);
    if (!contents.groupsAreRead) job.file = copy.emplace(file).path();
    job.contents.nodes = contents.nodes, job.contents.elements = contents.elements;
  }
  const ChildLimits limits = limitsFor(job);
  contents_ = reader(std::move(job), limits);
  for (auto& point : contents_.points)
    for (auto& x : point) x *= settings.scale;
}

const meshfile::GroupElements& GmshModel::group(const std::string& name,
                                                const std::string& wantedBy,
                                                const std::vector<std::string>& references) const {
  const auto found = contents_.groups.find(meshfile::groupName(name));
  if (found != contents_.groups.end()) return found->second;
  constexpr std::size_t most = 40;  // a shape has a group for each face
  std::vector<std::string> names;
  for (const auto& [known, where] : contents_.groups)
    if (names.size() < most) names.push_back(known);
  if (contents_.groups.size() > most)
    names.push_back("and " + std::to_string(contents_.groups.size() - most) + " more");
  throw Error(wantedBy + " names group '" + name + "', which is not in the mesh; " +
              (names.empty() ? "it has no physical groups at all: name its bodies and surfaces "
                               "(Physical Volume, Physical Surface)"
                             : "its groups are: " + joined(names)) +
              (references.empty() ? "" : "; the reference nodes are: " + joined(references)));
}

void GmshModel::joinSections(const Request& request) {
  for (const auto& [body, sections] : request.bodySections) {
    meshfile::GroupElements all;
    for (const auto& section : sections) {
      const auto& part = group(section.name, "option " + section.option);
      if (all.blocks.empty()) all.dimension = part.dimension;
      if (part.dimension != all.dimension)
        throw Error("option " + section.option + ": the sections '" + sections[0].name + "' and '" +
                    section.name + "' have the dimensions " + std::to_string(all.dimension) +
                    " and " + std::to_string(part.dimension) +
                    "; all are volumes, or all surfaces of a plane mesh");
      all.blocks.insert(all.blocks.end(), part.blocks.begin(), part.blocks.end());
    }
    contents_.groups.emplace(body, std::move(all));  // unless the mesh has a group of this name
  }
}

}  // namespace squeal::mesh
