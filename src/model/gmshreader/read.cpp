// SPDX-License-Identifier: BSD-2-Clause
#include "model/gmshreader/read.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <set>
#include <stdexcept>

#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "model/gmshreader/cad.hpp"
#include "model/gmshreader/geometry.hpp"

namespace squeal::gmshreader {
namespace {

using meshfile::Contents, meshfile::ElementBlock, meshfile::GroupElements, meshfile::Job;

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
  if (tag < 1 || tag > std::numeric_limits<PetscInt>::max())
    throw Error(job.option + what + " tag " + std::to_string(tag) + ": must be from 1 to " +
                std::to_string(std::numeric_limits<PetscInt>::max()));
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
  std::vector<std::array<double, 3>> points;

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
      applyParameters(job.parameters);
      gmsh::clear();
    }
    if (job.format.kind == meshfile::FileKind::shape)
      importShape(job.file, job.shape, warn);
    else
      gmsh::open(job.file);
    requireParametersUsed(job.parameters);
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    if (tags.empty() && job.isMeshedHere()) meshGeometry(job.file, warn);
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
    const std::string usable = meshfile::groupName(name);
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
          block = elements.blocks.insert(block, ElementBlock{});
          int typeDimension = 0, order = 0;
          std::vector<double> local;
          block->type = found.types[t];
          gmsh::model::mesh::getElementProperties(found.types[t], block->typeName, typeDimension,
                                                  order, block->nodesPerElement, local,
                                                  block->corners);
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

/// Throws Error unless gmsh was built with the part that reads the file.
void requirePart(const Job& job) {
  if (job.format.part.empty()) return;
  std::string parts;
  gmsh::option::getString("General.BuildOptions", parts);
  const auto list = split(parts, ' ');
  if (std::find(list.begin(), list.end(), job.format.part) == list.end())
    throw Error(job.option + "gmsh was built without " + job.format.part + ", which reads " +
                job.format.ending + " files; convert it to .msh or .unv");
}

}  // namespace

Contents read(const Job& job, const Warn& warn) {
  requirePart(job);
  openWith(job, warn);
  requireAllElements(job);
  Nodes nodes(job);
  if (nodes.points.empty()) throw Error(job.option + "the mesh is empty");
  Contents contents;
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

}  // namespace squeal::gmshreader
