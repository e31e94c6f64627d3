#include "mesh/gmsh_model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <filesystem>

#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::mesh {
namespace {

void setParameters(const std::vector<std::string>& parameters) {
  std::vector<std::string> known;
  gmsh::onelab::getNames(known);
  gmsh::onelab::clear();  // a default computed from other parameters must follow the values given here
  for (const auto& parameter : parameters) {
    const auto parts = split(parameter, '=');
    char* end = nullptr;
    const double value = parts.size() == 2 ? std::strtod(parts[1].c_str(), &end) : 0;
    if (parts.size() != 2 || parts[1].empty() || *end)
      throw Error("option -mesh_set " + parameter + ": must be a list of name=number");
    if (std::find(known.begin(), known.end(), parts[0]) == known.end())
      throw Error("option -mesh_set " + parameter + ": the geometry has no parameter '" + parts[0] + "'; it has: " + joined(known));
    gmsh::onelab::setNumber(parts[0], {value});
  }
}

}  // namespace

GmshModel::GmshModel(const std::string& file, const std::vector<std::string>& parameters) {
  if (!std::filesystem::is_regular_file(file)) throw Error("option -mesh_file " + file + ": there is no such file");
  gmsh::clear();
  gmsh::logger::start();
  std::string failure;
  try {
    gmsh::onelab::clear();  // gmsh keeps parameters from one file to the next
    if (!parameters.empty()) {
      gmsh::open(file);  // once with its own values, to learn the names it knows
      setParameters(parameters);
      gmsh::clear();
    }
    gmsh::open(file);
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    if (tags.empty()) {  // a geometry: mesh it in memory
      gmsh::model::mesh::generate(std::max(2, gmsh::model::getDimension()));
      gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    }
    for (std::size_t i = 0; i < tags.size(); ++i)
      points_[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
    gmsh::vectorpair physical;
    gmsh::model::getPhysicalGroups(physical);
    for (auto [dimension, tag] : physical) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      groups_[name.empty() ? std::to_string(tag) : name].emplace_back(dimension, tag);
    }
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (const std::string& error) {  // gmsh before 4.9
    failure = error;
  }
  std::vector<std::string> log;
  gmsh::logger::get(log);
  gmsh::logger::stop();
  for (const auto& line : log)
    if (failure.empty() && line.rfind("Error", 0) == 0) failure = line;
  if (!failure.empty()) throw Error("option -mesh_file " + file + ": gmsh says: " + failure);
  if (points_.empty()) throw Error("option -mesh_file " + file + ": the mesh is empty");
}

GmshModel::~GmshModel() { gmsh::clear(); }

GroupElements GmshModel::group(const std::string& name, const std::string& wantedBy) const {
  const auto found = groups_.find(name);
  if (found == groups_.end()) {
    std::vector<std::string> names;
    for (const auto& [known, where] : groups_) names.push_back(known);
    throw Error(wantedBy + " names group '" + name + "', which is not in the mesh; its groups are: " + joined(names));
  }
  GroupElements elements;
  for (auto [dimension, tag] : found->second) elements.dimension = std::max(elements.dimension, dimension);
  for (auto [dimension, physical] : found->second) {
    if (dimension != elements.dimension) continue;
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, physical, entities);
    for (int entity : entities) {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
      for (std::size_t t = 0; t < types.size(); ++t) {
        auto block =
            std::find_if(elements.blocks.begin(), elements.blocks.end(), [&](const auto& b) { return b.type == types[t]; });
        if (block == elements.blocks.end()) {
          block = elements.blocks.insert(block, WholeBlock{});
          std::string typeName;
          int typeDimension = 0, order = 0;
          std::vector<double> local;
          block->type = types[t];
          gmsh::model::mesh::getElementProperties(types[t], typeName, typeDimension, order, block->nodesPerElement, local,
                                                  block->corners);
        }
        block->tag.insert(block->tag.end(), tags[t].begin(), tags[t].end());
        block->nodes.insert(block->nodes.end(), nodes[t].begin(), nodes[t].end());  // gmsh tags for now
      }
    }
  }
  return elements;
}

int GmshModel::largestDimension() const { return gmsh::model::getDimension(); }

std::map<std::size_t, std::string> GmshModel::allCells(int dimension) const {
  std::map<std::size_t, std::string> cells;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  for (auto [d, entity] : entities) {
    std::vector<int> physical, types;
    gmsh::model::getPhysicalGroupsForEntity(d, entity, physical);
    std::vector<std::string> names;
    for (const auto& [name, where] : groups_)
      for (auto [gd, tag] : where)
        if (gd == d && std::find(physical.begin(), physical.end(), tag) != physical.end()) names.push_back(name);
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, d, entity);
    for (const auto& list : tags)
      for (auto tag : list) cells[tag] = names.empty() ? "(no group)" : joined(names);
  }
  return cells;
}

}  // namespace squeal::mesh
