// SPDX-License-Identifier: BSD-2-Clause
#include "model/gmshreader/cad.hpp"

#include <dlfcn.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "base/system/error.hpp"

namespace squeal::gmshreader {
namespace {

/// Has OpenCASCADE read the names of faces, not only of solids. gmsh has no option for it, and to
/// link with OpenCASCADE for the sake of one parameter is not worth while: its functions are looked
/// up among those that gmsh has brought along. Without them faces have no labels.
void readNamesOfFaces() {
  const auto init = reinterpret_cast<bool (*)()>(
      dlsym(RTLD_DEFAULT, "_ZN25STEPCAFControl_Controller4InitEv"));  // …_Controller::Init
  const auto set = reinterpret_cast<bool (*)(const char*, int)>(
      dlsym(RTLD_DEFAULT, "_ZN16Interface_Static7SetIValEPKci"));  // Interface_Static::SetIVal
  if (!init || !set) return;
  init();
  set("read.stepcaf.subshapes.name", 1);
}

/// Throws Error for a STEP file that is cut off, of which OpenCASCADE would read the rest.
void requireEnd(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string begin(12, ' '), end;
  stream.read(begin.data(), begin.size());
  if (begin != "ISO-10303-21") return;
  constexpr std::streamoff most = 1000;  // blanks and comments may follow the last word
  stream.seekg(0, std::ios::end);
  stream.seekg(std::max(std::streamoff{0}, std::streamoff{stream.tellg()} - most));
  end.assign(std::istreambuf_iterator<char>(stream), {});
  if (end.find("END-ISO-10303-21") == std::string::npos)
    throw Error("option -mesh_file " + file +
                ": it does not end with END-ISO-10303-21, so that it is cut off");
}

/// A solid or face of the file.
struct Entity {
  int dimension, number;  ///< as gmsh shows them for the file
  std::string label;      ///< last part; empty if it has none
  double size = 0;        ///< volume or area
  double centre[3]{};
  std::vector<int> pieces;  ///< what it is made of after the cuts
};

/// Sets size and centre of mass.
void measure(Entity& entity, int tag) {
  gmsh::model::occ::getMass(entity.dimension, tag, entity.size);
  gmsh::model::occ::getCenterOfMass(entity.dimension, tag, entity.centre[0], entity.centre[1],
                                    entity.centre[2]);
}

std::vector<Entity> entitiesOf(int dimension) {
  gmsh::vectorpair found;
  gmsh::model::getEntities(found, dimension);
  std::vector<Entity> entities;
  for (const auto& [d, tag] : found) {
    std::string label;
    gmsh::model::getEntityName(d, tag, label);
    entities.push_back({d, tag, label.substr(label.rfind('/') + 1), 0, {}, {tag}});
    measure(entities.back(), tag);
  }
  return entities;
}

/// Returns true if both have the same size and centre: a face and what it is called after a cut
/// elsewhere.
bool alike(const Entity& a, const Entity& b) {
  constexpr double digits = 1e-6;  // of the integrals over faces
  double distance = 0;
  for (int d = 0; d < 3; ++d) distance = std::hypot(distance, a.centre[d] - b.centre[d]);
  return std::abs(a.size - b.size) <= digits * a.size && distance <= digits * std::sqrt(a.size);
}

/// Cuts the solids where they touch, and finds their pieces and those of the faces.
void cut(std::vector<Entity>& solids, std::vector<Entity>& faces, const Warn& warn) {
  std::vector<Entity*> all;
  for (auto& entity : solids) all.push_back(&entity);
  for (auto& entity : faces) all.push_back(&entity);
  gmsh::vectorpair objects, result;
  for (const auto* entity : all) objects.emplace_back(entity->dimension, entity->number);
  std::vector<gmsh::vectorpair> pieces;
  gmsh::model::occ::fragment(objects, {}, result, pieces);
  gmsh::model::occ::synchronize();
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i]->pieces.clear();
    for (const auto& [d, tag] : pieces[i])
      if (d == all[i]->dimension) all[i]->pieces.push_back(tag);
  }
  // gmsh does not tell what has become of an uncut face of a solid that is cut elsewhere.
  const auto now = entitiesOf(2);
  for (auto& face : faces) {
    if (face.pieces.empty())
      for (const auto& candidate : now)
        if (alike(face, candidate)) face.pieces.push_back(candidate.number);
    if (face.pieces.empty() && !face.label.empty())
      warn("face " + std::to_string(face.number) + ", '" + face.label +
           "', is not found again after the solids were cut where they touch");
  }
}

/// Makes the physical groups.
void makeGroups(const std::string& file, const std::vector<Entity>& solids,
                const std::vector<Entity>& faces) {
  std::set<std::string> taken;  // a group of solids hides one of faces
  for (const auto* entities : {&solids, &faces}) {
    std::map<std::string, int> count;
    for (const auto& entity : *entities) ++count[entity.label];
    std::map<std::string, std::set<int>> groups;
    for (const auto& entity : *entities) {
      const bool labelled = !entity.label.empty() && !taken.count(entity.label);
      const auto add = [&](const std::string& name) {
        groups[name].insert(entity.pieces.begin(), entity.pieces.end());
      };
      if (labelled) add(entity.label);
      if (labelled && count[entity.label] == 1) continue;
      const auto own = (entity.dimension == 3 ? "solid_" : "face_") + std::to_string(entity.number);
      if (count.contains(own) || taken.contains(own))
        throw Error("option -mesh_file " + file + ": another part or face has the name '" + own +
                    "', which the program gives to number " + std::to_string(entity.number) +
                    "; rename it in the shape");
      add(own);
    }
    for (const auto& [name, tags] : groups) {
      const int dimension = entities == &solids ? 3 : 2;
      const int group = gmsh::model::addPhysicalGroup(dimension, {tags.begin(), tags.end()});
      gmsh::model::setPhysicalName(dimension, group, name);
      taken.insert(name);
    }
  }
}

}  // namespace

void importShape(const std::string& file, const meshfile::ShapeMesh& mesh, const Warn& warn) {
  requireEnd(file);
  readNamesOfFaces();
  gmsh::vectorpair imported;
  gmsh::model::occ::importShapes(file, imported);
  gmsh::model::occ::synchronize();
  auto solids = entitiesOf(3), faces = entitiesOf(2);
  if (solids.empty())
    throw Error("option -mesh_file " + file + ": there is no solid in the shape, only " +
                std::to_string(faces.size()) + " faces; a .geo can merge it and make volumes");
  if (solids.size() > 1) cut(solids, faces, warn);
  makeGroups(file, solids, faces);
  if (mesh.size > 0) {
    gmsh::option::setNumber("Mesh.MeshSizeMin", mesh.size);
    gmsh::option::setNumber("Mesh.MeshSizeMax", mesh.size);
  }
  gmsh::option::setNumber("Mesh.ElementOrder", mesh.order);
}

}  // namespace squeal::gmshreader
