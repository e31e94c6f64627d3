// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/inventory.hpp"

#include <algorithm>
#include <map>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::analysis {
namespace {

std::vector<double> numbers(const mesh::Point& point, int count) {
  return {point.begin(), point.begin() + count};
}

/// Makes the lists.
class Lists {
 public:
  Lists(const mesh::Mesh& mesh, const ModelSettings& settings)
      : mesh_(mesh), settings_(settings), dimension_(mesh.dimension) {}
  ItemList supports() const;
  ItemList loads() const;
  ItemList references() const;
  ItemList couplings() const;
  ItemList equations() const;
  ItemList springs() const;
  ItemList bushings() const;
  ItemList masses() const;
  ItemList bolts() const;

 private:
  /// Collective. Adds the number of nodes of a group that is not a reference node.
  void countNodes(const std::string& group, Item& item) const {
    if (!mesh_.reference(group))
      item.facts.emplace_back(
          "nodes", double(mpi::sum(mesh_.comm, PetscInt(mesh_.nodeGroups.at(group).size()))));
  }
  double faces(const std::string& surface) const;
  void addForces(std::map<std::string, Item>& found) const;
  void addBodyForces(std::map<std::string, Item>& found) const;
  std::vector<double> vector(const VectorValue& value) const {
    return numbers(value.in(dimension_), dimension_);
  }

  const mesh::Mesh& mesh_;
  const ModelSettings& settings_;
  int dimension_;
};

/// Collective. Returns the number of faces of a surface group.
double Lists::faces(const std::string& surface) const {
  double count = 0;
  for (const auto& block : mesh_.faces)
    for (const int s : block.surface) count += mesh_.surfaces[s] == surface;
  return mpi::sum(mesh_.comm, count);
}

ItemList Lists::supports() const {
  std::map<std::string, Item> found;
  for (const auto& [group, clamp] : settings_.constraints.clamps) {
    Item& item = found[group] = {group, {}};
    countNodes(group, item);
    if (!clamp.components.empty()) item.facts.emplace_back("clamped", clamp.components);
    if (!clamp.rotations.empty()) item.facts.emplace_back("clamped_rotation", clamp.rotations);
    if (!clamp.frame.empty()) item.facts.emplace_back("frame", clamp.frame);
  }
  for (const auto& [group, ground] : settings_.elasticity.ground) {
    Item& item = found[group];
    if (item.name.empty()) item.name = group, countNodes(group, item);
    if (ground.springs) item.facts.emplace_back("stiffness_n_per_m", vector(ground.stiffness));
    if (!ground.frame.empty()) item.facts.emplace_back("frame", ground.frame);
    if (ground.dashpots) item.facts.emplace_back("damping_n_s_per_m", vector(ground.damping));
  }
  ItemList list{"supports", {}};
  for (auto& [group, item] : found) list.items.push_back(std::move(item));
  return list;
}

void Lists::addForces(std::map<std::string, Item>& found) const {
  for (const auto& given : settings_.elasticity.attachments.forces) {
    Item& item = found[given.group];
    if (item.name.empty()) item.name = given.group;
    countNodes(given.group, item);
    if (const auto force = vector(given.force); std::ranges::any_of(force, std::identity{}))
      item.facts.emplace_back("force_n", force);
    if (given.hasMoment) item.facts.emplace_back("moment_n_m", numbers(given.moment.in(3), 3));
    if (!given.frame.empty()) item.facts.emplace_back("frame", given.frame);
    if (!given.hydraulic) item.facts.emplace_back("hydraulic", "off");
  }
}

void Lists::addBodyForces(std::map<std::string, Item>& found) const {
  const auto& settings = settings_.elasticity;
  const auto add = [&](const std::string& name, const char* fact, std::vector<double> value) {
    Item& item = found[name];
    item.name = name;
    item.facts.emplace_back(fact, std::move(value));
  };
  if (const auto gravity = vector(settings.gravity); std::ranges::any_of(gravity, std::identity{}))
    add("gravity", "acceleration_m_per_s2", gravity);
  for (const auto& [body, given] : settings.accelerations)
    add(body, "acceleration_m_per_s2", vector(given));
  for (const auto& [body, given] : settings.spins) add(body, "spin_rad_per_s", {given.speed});
}

ItemList Lists::loads() const {
  std::map<std::string, Item> found;
  for (const auto& [surface, pressure] : settings_.elasticity.pressure) {
    found[surface] = {surface, {{"faces", faces(surface)}, {"pressure_pa", pressure}}};
    if (settings_.elasticity.constantPressure.contains(surface))
      found[surface].facts.emplace_back("hydraulic", "off");
  }
  addForces(found);
  addBodyForces(found);
  ItemList list{"loads", {}};
  for (auto& [name, item] : found) list.items.push_back(std::move(item));
  return list;
}

ItemList Lists::references() const {
  ItemList list{"references", {}};
  for (const auto& reference : mesh_.references) {
    const bool isOfBolt = std::ranges::any_of(mesh_.sections, [&](const auto& section) {
      return &mesh_.references[section.reference] == &reference;
    });
    if (!isOfBolt)
      list.items.push_back(
          {reference.name, {{"position_m", numbers(reference.position, dimension_)}}});
  }
  return list;
}

ItemList Lists::couplings() const {
  ItemList list{"couplings", {}};
  for (const auto& given : settings_.constraints.couplings) {
    const bool isRigid = given.kind == constraints::CouplingKind::rigid;
    Item item{given.name,
              {{"kind", isRigid ? "rigid" : "distributed"},
               {"reference", given.reference},
               {"groups", joined(given.groups)}}};
    double nodes = 0;
    for (const auto& group : given.groups) nodes += mesh_.nodeGroups.at(group).size();
    item.facts.emplace_back("nodes", mpi::sum(mesh_.comm, nodes));
    if (isRigid && given.components != "xyz")
      item.facts.emplace_back("components", given.components);
    list.items.push_back(std::move(item));
  }
  return list;
}

ItemList Lists::equations() const {
  ItemList list{"equations", {}};
  for (const auto& given : settings_.constraints.equations)
    list.items.push_back({given.name, {{"equation", given.text}}});
  return list;
}

ItemList Lists::springs() const {
  ItemList list{"springs", {}};
  for (const auto& given : settings_.elasticity.attachments.springs)
    list.items.push_back({given.name,
                          {{"from", given.from},
                           {"to", given.to},
                           {"stiffness_n_per_m", given.stiffness},
                           {"damping_n_s_per_m", given.damping}}});
  return list;
}

ItemList Lists::bushings() const {
  ItemList list{"bushings", {}};
  for (const auto& given : settings_.elasticity.attachments.bushings) {
    list.items.push_back({given.name,
                          {{"from", given.from},
                           {"to", given.to.empty() ? "the ground" : given.to},
                           {"stiffness", given.stiffness},
                           {"damping", given.damping}}});
    if (!given.frame.empty()) list.items.back().facts.emplace_back("frame", given.frame);
  }
  return list;
}

ItemList Lists::masses() const {
  ItemList list{"masses", {}};
  for (const auto& given : settings_.elasticity.attachments.masses) {
    Item item{given.group, {}};
    countNodes(given.group, item);
    item.facts.emplace_back("mass_kg", given.total);
    if (given.hasInertia) item.facts.emplace_back("inertia_kg_m2", given.inertia);
    if (given.hasOffset) item.facts.emplace_back("offset_m", vector(given.offset));
    list.items.push_back(std::move(item));
  }
  return list;
}

ItemList Lists::bolts() const {
  ItemList list{"bolts", {}};
  for (const auto& given : settings_.constraints.bolts) {
    Item item{given.name, {{"section", given.section}}};
    if (given.force) item.facts.emplace_back("force_n", *given.force);
    if (given.shortening) item.facts.emplace_back("shortening_m", *given.shortening);
    list.items.push_back(std::move(item));
  }
  return list;
}

std::string text(const Fact& fact) {
  if (const auto* word = std::get_if<std::string>(&fact)) return *word;
  if (const auto* number = std::get_if<double>(&fact)) return formatted("%.6g", *number);
  std::string list;
  for (const double number : std::get<std::vector<double>>(fact))
    list += (list.empty() ? "" : ",") + formatted("%.6g", number);
  return list;
}

}  // namespace

std::vector<ItemList> inventory(const mesh::Mesh& mesh, const ModelSettings& settings) {
  const Lists lists(mesh, settings);
  std::vector<ItemList> all{lists.supports(),  lists.loads(),     lists.references(),
                            lists.couplings(), lists.equations(), lists.springs(),
                            lists.bushings(),  lists.masses(),    lists.bolts()};
  std::erase_if(all, [](const ItemList& list) { return list.items.empty(); });
  return all;
}

std::string text(const Item& item) {
  std::vector<std::string> facts;
  for (const auto& [name, fact] : item.facts)
    facts.push_back(name == "nodes" || name == "faces" ? text(fact) + " " + name
                                                       : name + " " + text(fact));
  return item.name + " (" + joined(facts) + ")";
}

}  // namespace squeal::analysis
