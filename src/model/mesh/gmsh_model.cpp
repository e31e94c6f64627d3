// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/gmsh_model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/child.hpp"
#include "base/system/memory.hpp"
#include "base/system/text.hpp"
#include "model/meshfile/cad.hpp"
#include "model/meshfile/format.hpp"
#include "model/meshfile/geometry.hpp"
#include "model/meshfile/msh.hpp"
#include "model/meshfile/unv.hpp"

namespace squeal::mesh {
namespace {

/// The work for gmsh, with the contents that the checks have found in the file.
struct Job {
  std::string file, option;  ///< the option as messages begin with it
  meshfile::FileKind kind;
  std::vector<meshfile::GeometryParameter> parameters;
  meshfile::ShapeMesh shape;       ///< for a shape
  meshfile::MshContents contents;  ///< of a .msh; of a .unv the numbers of nodes and elements
  bool isMeshedHere() const {
    return kind == meshfile::FileKind::geometry || kind == meshfile::FileKind::shape;
  }
  /// Returns true for a .msh file of version 2, which gives each element one group and one entity.
  /// gmsh would put all elements of an entity into all of its groups; it must take the groups
  /// for the entities.
  bool groupsAreEntities() const { return kind == meshfile::FileKind::msh && contents.version < 4; }
};

/// The elements as gmsh lists them by type, and the tags of their nodes.
struct Elements {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
};

Elements elementsOf(int dimension, int entity) {
  Elements elements;
  gmsh::model::mesh::getElements(elements.types, elements.tags, elements.nodes, dimension, entity);
  return elements;
}

/// Returns the tag. Throws Error unless it fits PetscInt.
PetscInt checkedTag(const Job& job, std::int64_t tag, const char* what) {
  if (tag < 1 || tag > PETSC_MAX_INT)
    throw Error(job.option + what + " tag " + std::to_string(tag) + ": must be from 1 to " +
                std::to_string(PETSC_MAX_INT));
  return tag;
}

/// The nodes in gmsh's order, and the index of each tag.
class Nodes {
 public:
  explicit Nodes(const Job& job) : job_(job) {
    std::vector<std::size_t> all;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(all, coordinates, parametric);
    for (std::size_t i = 0; i < all.size(); ++i) {
      tags.push_back(checkedTag(job, all[i], "node"));
      points.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
      for (double x : points.back())
        if (!(std::abs(x) < 1e100))  // the volume of a cell is a product of three
          throw Error(job.option + "node " + std::to_string(all[i]) + " has the coordinate " +
                      shortest(x) + "; must be finite, below 1e100");
      order_.emplace_back(tags.back(), i);
    }
    std::sort(order_.begin(), order_.end());
    for (std::size_t i = 1; i < order_.size(); ++i)
      if (order_[i].first == order_[i - 1].first)
        throw Error(job.option + "there are two nodes with the tag " +
                    std::to_string(order_[i].first));
  }
  PetscInt index(std::int64_t tag) const {
    if (tag >= 1 && tag <= std::ssize(order_) && order_[tag - 1].first == tag)
      return order_[tag - 1].second;  // 1, 2, 3, …
    const auto found = std::ranges::lower_bound(order_, tag, {}, &TagAndIndex::first);
    if (found == order_.end() || found->first != tag)
      throw Error(job_.option + "an element refers to node " + std::to_string(tag) +
                  ", which is not in the mesh");
    return found->second;
  }

  /// Returns 1 for each node at a point of the geometry, [node].
  std::vector<char> atPoints() const {
    std::vector<std::size_t> ofPoints;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(ofPoints, coordinates, parametric, 0);
    std::vector<char> at(tags.size(), 0);
    for (const auto tag : ofPoints) at[index(tag)] = 1;
    return at;
  }

  std::vector<PetscInt> tags;
  std::vector<Point> points;

 private:
  using TagAndIndex = std::pair<PetscInt, PetscInt>;
  const Job& job_;
  std::vector<TagAndIndex> order_;
};

/// Opens the file with gmsh, and reports its errors and warnings.
void openWith(const Job& job, const Warn& warn) {
  gmsh::clear();
  gmsh::onelab::clear();  // gmsh keeps parameters from one file to the next
  gmsh::option::setNumber("Mesh.SwitchElementTags", job.groupsAreEntities());
  gmsh::logger::start();
  std::string failure;
  try {
    if (!job.parameters.empty()) {
      gmsh::open(job.file);  // once with its own values, to learn the names it knows
      meshfile::applyParameters(job.parameters);
      gmsh::clear();
    }
    if (job.kind == meshfile::FileKind::shape)
      meshfile::importShape(job.file, job.shape, warn);
    else
      gmsh::open(job.file);
    meshfile::requireParametersUsed(job.parameters);
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    if (tags.empty() && job.isMeshedHere()) meshfile::meshGeometry(job.file, warn);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::length_error&) {
    throw;
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (const std::string& error) {  // gmsh before 4.9
    failure = error;
  }
  std::vector<std::string> log;
  gmsh::logger::get(log);
  gmsh::logger::stop();
  std::set<std::string> warnings;
  for (const auto& line : log) {
    if (failure.empty() && line.rfind("Error", 0) == 0) failure = line;
    if (line.rfind("Warning", 0) == 0) warnings.insert(line.substr(line.find(' ') + 1));
  }
  if (!failure.empty())
    throw Error(job.option + "gmsh reports: " + failure.substr(0, failure.find('\n')));
  std::size_t printed = 0;
  for (const auto& line : warnings)
    if (++printed <= 5) warn(job.option + "gmsh reports: " + line.substr(0, line.find('\n')));
  if (printed > 5) warn(job.option + std::to_string(printed - 5) + " more warnings of gmsh");
}

/// Returns the dimensions and tags of groups by the names that options use.
std::map<std::string, gmsh::vectorpair> namedGroups(const Job& job) {
  std::map<std::string, gmsh::vectorpair> groups;
  std::map<std::string, std::string> original;
  gmsh::vectorpair physical;
  if (job.groupsAreEntities())
    gmsh::model::getEntities(physical);
  else
    gmsh::model::getPhysicalGroups(physical);
  for (auto [dimension, tag] : physical) {
    if (tag == 0) continue;  // elements in no group
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.empty()) name = std::to_string(tag);
    const std::string usable = groupName(name);
    const auto [known, isNew] = original.emplace(usable, name);
    if (!isNew && known->second != name)
      throw Error(job.option + "the groups '" + known->second + "' and '" + name +
                  "' have the same name '" + usable +
                  "' in options, where underscores stand for blanks");
    groups[usable].emplace_back(dimension, tag);
  }
  return groups;
}

GroupElements elementsOfGroup(const Job& job, const gmsh::vectorpair& group, const Nodes& nodes) {
  GroupElements elements;
  for (auto [dimension, tag] : group) elements.dimension = std::max(elements.dimension, dimension);
  for (auto [dimension, physical] : group) {
    if (dimension != elements.dimension) continue;
    std::vector<int> entities{physical};
    if (!job.groupsAreEntities())
      gmsh::model::getEntitiesForPhysicalGroup(dimension, physical, entities);
    for (int entity : entities) {
      const Elements found = elementsOf(dimension, entity);
      for (std::size_t t = 0; t < found.types.size(); ++t) {
        auto block = std::find_if(elements.blocks.begin(), elements.blocks.end(),
                                  [&](const auto& b) { return b.type == found.types[t]; });
        if (block == elements.blocks.end()) {
          block = elements.blocks.insert(block, WholeBlock{});
          std::string typeName;
          int typeDimension = 0, order = 0;
          std::vector<double> local;
          block->type = found.types[t];
          gmsh::model::mesh::getElementProperties(found.types[t], typeName, typeDimension, order,
                                                  block->nodesPerElement, local, block->corners);
        }
        for (auto tag : found.tags[t]) block->tag.push_back(checkedTag(job, tag, "element"));
        for (auto tag : found.nodes[t]) block->nodes.push_back(nodes.index(tag));
      }
    }
  }
  return elements;
}

std::vector<PetscInt> ungroupedElements(const Job& job, int dimension) {
  std::vector<PetscInt> tags;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  for (auto [d, entity] : entities) {
    std::vector<int> physical;
    gmsh::model::getPhysicalGroupsForEntity(d, entity, physical);
    if (job.groupsAreEntities() ? entity != 0 : !physical.empty()) continue;
    for (const auto& list : elementsOf(d, entity).tags)
      for (auto tag : list) tags.push_back(checkedTag(job, tag, "element"));
  }
  return tags;
}

/// Throws Error if elements are missing: gmsh silently drops those that it cannot place.
void requireAllElements(const Job& job) {
  if (job.contents.elements == 0) return;
  std::int64_t kept = 0;
  for (const auto& list : elementsOf(-1, -1).tags) kept += list.size();
  if (kept != job.contents.elements)
    throw Error(job.option + "gmsh keeps " + std::to_string(kept) + " of the " +
                std::to_string(job.contents.elements) + " elements in the file");
}

/// Reads the mesh in the child process.
GmshContents readWithGmsh(const Job& job, const Warn& warn) {
  openWith(job, warn);
  requireAllElements(job);
  Nodes nodes(job);
  if (nodes.points.empty()) throw Error(job.option + "the mesh is empty");
  GmshContents contents;
  contents.dimension = gmsh::model::getDimension();
  contents.ungrouped = ungroupedElements(job, contents.dimension);
  contents.atPoint = nodes.atPoints();
  const std::int64_t kept = nodes.points.size();
  contents.droppedNodes = std::max(job.contents.nodes - kept, std::int64_t{0});
  for (const auto& [name, group] : namedGroups(job))
    contents.groups[name] = elementsOfGroup(job, group, nodes);
  contents.points = std::move(nodes.points);
  contents.tags = std::move(nodes.tags);
  return contents;
}

/// Returns the limits of the child process. Meshing may take any time and all free memory. The
/// limits for a mesh file follow from its size, as it may be damaged in ways that the checks miss.
ChildLimits limitsFor(const Job& job) {
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

void fields(Stream& stream, GroupElements& group) { stream(group.dimension, group.blocks); }

void fields(Stream& stream, GmshContents& contents) {
  auto& [points, tags, groups, dimension, ungrouped, atPoint, droppedNodes] = contents;
  stream(points, tags, groups, dimension, ungrouped, atPoint, droppedNodes);
}

std::string groupName(std::string name) {
  const auto isBlank = [](unsigned char c) { return std::isspace(c); };
  std::replace_if(name.begin(), name.end(), isBlank, '_');
  return name;
}

GmshModel::GmshModel(const meshfile::Settings& settings) {
  const std::string& file = settings.file;
  Job job{.file = file,
          .option = "option -mesh_file " + file + ": ",
          .kind = meshfile::requireSound(file),
          .parameters = settings.parameters,
          .shape = settings.shape,
          .contents = {}};
  if (job.kind != meshfile::FileKind::shape) meshfile::rejectShapeMesh(file, job.shape);
  if (!job.parameters.empty() && job.kind != meshfile::FileKind::geometry)
    throw Error("option -mesh_set: only a geometry, a .geo file, has parameters; -mesh_file " +
                file + " is a " + (job.kind == meshfile::FileKind::shape ? "shape" : "mesh"));
  if (job.kind == meshfile::FileKind::msh) job.contents = meshfile::requireSoundMsh(file);
  std::optional<meshfile::UnvCopy> copy;
  if (job.kind == meshfile::FileKind::unv) {
    const meshfile::UnvContents contents = meshfile::requireSoundUnv(file);
    if (!contents.groupsAreRead) job.file = copy.emplace(file).path();
    job.contents.nodes = contents.nodes, job.contents.elements = contents.elements;
  }
  Stream stream(inChild(limitsFor(job), [&](const Warn& warn) {
    GmshContents contents = readWithGmsh(job, warn);
    Stream result;
    result(contents);
    return std::move(result).bytes();
  }));
  stream(contents_);
  for (auto& point : contents_.points)
    for (auto& x : point) x *= settings.scale;
}

const GroupElements& GmshModel::group(const std::string& name, const std::string& wantedBy) const {
  const auto found = contents_.groups.find(groupName(name));
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
                             : "its groups are: " + joined(names)));
}

}  // namespace squeal::mesh
