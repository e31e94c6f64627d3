// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/reactions.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/attached_parts.hpp"
#include "model/elasticity/ground.hpp"
#include "model/elasticity/loads.hpp"
#include "steady/steady/nodal_forces.hpp"
#include "steady/steady/resultants.hpp"

namespace squeal::steady {

/// The reactions of this rank, until they are summed over all ranks.
class Reactions::List {
 public:
  enum class Source { outside, inside };
  void add(const char* kind, const std::string& name, const Wrench& own, Source source) {
    rows_.push_back({kind, name, own});
    isOutside_.push_back(source == Source::outside);
  }
  /// Collective. Returns the reactions with their sum.
  std::vector<Reaction> finish(MPI_Comm comm) {
    std::vector<Wrench*> wrenches;
    for (auto& row : rows_) wrenches.push_back(&row.wrench);
    reduce(comm, wrenches);
    Reaction sum{"sum", "", {}};
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (isOutside_[i]) sum.wrench.add(rows_[i].wrench);
    rows_.push_back(sum);
    return std::move(rows_);
  }

 private:
  std::vector<Reaction> rows_;
  std::vector<bool> isOutside_;
};

Reactions::Reactions(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                     const contact::Contact& contact)
    : mesh_(mesh), bodies_(bodies), contact_(contact), conditions_(contact) {
  findLoads();
}

/// Collective. Adds a load unless it is zero. The vectors may be null.
void Reactions::addLoad(const std::string& name, Vec hydraulic, Vec constant, Vec squared) {
  Load load{name, {}, {}, {}};
  bool any = false;
  const auto take = [&](Vec vector, Wrench& sum) {
    if (!vector) return;
    PetscReal size = 0;
    check(VecNorm(vector, NORM_INFINITY, &size));
    any = any || size > 0;
    sum = ownWrench(mesh_, vector);
  };
  take(hydraulic, load.hydraulic);
  take(constant, load.constant);
  take(squared, load.squared);
  if (any) loads_.push_back(std::move(load));
}

/// Collective. Finds the loads of each kind, with settings without the others.
void Reactions::findLoads() {
  const auto& materials = bodies_.materials;
  elasticity::Settings pressures = bodies_.settings, forces = bodies_.settings,
                       gravity = bodies_.settings, spins = bodies_.settings;
  for (auto* settings : {&pressures, &forces, &spins})
    settings->gravity = {}, settings->accelerations.clear();
  for (auto* settings : {&forces, &gravity}) settings->pressure.clear();
  for (auto* settings : {&pressures, &gravity}) settings->attachments.forces.clear();
  gravity.spins.clear();
  const auto onSurfaces = elasticity::surfaceLoads({mesh_, materials, pressures}, {});
  addLoad("pressure", onSurfaces.hydraulic, onSurfaces.constant, nullptr);
  const auto onNodes = elasticity::surfaceLoads({mesh_, materials, forces}, {});
  addLoad("force", onNodes.hydraulic, onNodes.constant, nullptr);
  if (bodies_.settings.bodyForces) {
    const auto masses = attachments::massesOf(mesh_, bodies_.settings.attachments);
    const OwnedVec weight = elasticity::bodyForces({mesh_, materials, gravity}, {});
    check(
        VecAXPY(weight, 1, elasticity::surfaceLoads({mesh_, materials, gravity}, masses).constant));
    addLoad("gravity", nullptr, weight, nullptr);
    addLoad("spin", nullptr, elasticity::bodyForces({mesh_, materials, spins}, {}), nullptr);
  }
  addLoad("centrifugal", nullptr, nullptr, bodies_.centrifugal);
}

Reactions::ContactForces Reactions::contactForces(const Solution& solution) const {
  ContactForces found;
  found.sums.resize(contact_.interfaces.names.size());
  found.rest = supportForces(mesh_, bodies_, solution.at, solution.displacement);
  if (contact_.interfaces.totalNodes == 0) return found;
  const auto slip = withReleased(contact_, solution.slip, solution.sticking);
  const auto onPads =
      forcesOnPads(contact_, solution, tangentialForces(contact_, solution, slip, found.rest));
  const OwnedVec atNodes = elasticity::nodalVector(mesh_), forces = elasticity::nodalVector(mesh_);
  for (int i = 0; i < std::ssize(contact_.interfaces.names); ++i) {
    if (contact_.interfaces.options[i].isTied()) continue;
    check(VecSet(atNodes, 0));
    {
      const WriteArray values(atNodes);
      for (std::size_t k = 0; k < contact_.interfaces.nodes.size(); ++k)
        if (const auto& node = contact_.interfaces.nodes[k]; node.interface == i)
          std::copy_n(onPads[k].begin(), mesh_.dimension,
                      values.begin() + mesh_.dimension * node.node);
    }
    check(MatMultTranspose(contact_.sliding.jump, atNodes, forces));
    found.sums[i] = ownWrench(mesh_, forces);
    check(VecAXPY(found.rest, -1, forces));
  }
  found.rest = contact_.movedFromLayers(found.rest);
  return found;
}

/// Adds the forces of grounded springs, −k u at each node.
void Reactions::addGround(const Solution& solution, List& list) const {
  const ReadArray u(solution.displacement);
  for (const auto& [group, given] : bodies_.settings.ground) {
    if (!given.springs) continue;
    const auto& nodes = mesh_.nodeGroups.at(group);
    const auto stiffness = elasticity::groundSprings(mesh_, bodies_.settings, group);
    Wrench sum;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Point displacement = componentsAt(mesh_, u.data(), nodes[i]);
      Point force{};
      for (std::size_t d = 0; d < 3; ++d) force[d] = -mesh::dot(stiffness[i][d], displacement);
      sum.addNode(mesh_, nodes[i], force);
    }
    list.add("ground", group, sum, List::Source::outside);
  }
}

/// Collective. Adds the forces of springs and bushings, −k δ on the components of δ: on the end
/// `to` or, if that is the ground, on the other one.
void Reactions::addLinks(const Solution& solution, List& list) const {
  const auto& links = bodies_.links;
  const auto lengthening = elasticity::formValues(mesh_, links, solution.displacement);
  for (std::size_t first = 0, last = 0; first < links.size(); first = last) {
    const bool isGrounded =
        std::ranges::none_of(links[first].terms, [](const auto& term) { return term.isTo; });
    Wrench sum;
    for (; last < links.size() && links[last].kind == links[first].kind &&
           links[last].name == links[first].name;
         ++last)
      for (const auto& term : links[last].terms)
        if (const PetscInt node = mesh_.ownedNode(term.node);
            node >= 0 && (term.isTo || isGrounded))
          sum.addNode(mesh_, node, term.direction, -links[last].stiffness * lengthening[last]);
    list.add(links[first].kind.c_str(), links[first].name, sum,
             isGrounded ? List::Source::outside : List::Source::inside);
  }
}

/// Adds the rows of equations, reference nodes, couplings and bolts.
void Reactions::addConditions(const ConditionForces& forces, List& list) const {
  const auto& all = contact_.interfaces;
  for (std::size_t i = 0; i < forces.equations.size(); ++i)
    list.add("equation", all.constraints.equations[i].name, forces.equations[i],
             List::Source::outside);
  std::vector<bool> isOfBolt(mesh_.references.size(), false);
  for (const auto& section : mesh_.sections) isOfBolt[section.reference] = true;
  for (std::size_t i = 0; i < forces.references.size(); ++i) {
    if (isOfBolt[i]) continue;  // it has the row of the bolt
    Wrench fromOutside;         // the couplings balance it
    fromOutside.add(forces.references[i], -1);
    list.add("reference", mesh_.references[i].name, fromOutside, List::Source::inside);
  }
  for (std::size_t i = 0; i < forces.couplings.size(); ++i)
    list.add("coupling", all.couplings[i].name, forces.couplings[i], List::Source::inside);
  for (std::size_t i = 0; i < forces.bolts.size(); ++i)
    list.add("bolt", mesh_.sections[i].name, forces.bolts[i], List::Source::inside);
}

/// Collective. Adds the rows of ties and interfaces, and the moments of internal forces that act at
/// distant points. `sums` are those of contact over both sides, [interface].
void Reactions::addInterfaces(const Solution& solution, const std::vector<Wrench>& sums,
                              const ConditionForces& conditions, List& list) const {
  const auto& all = contact_.interfaces;
  std::vector<Wrench> ofBoth = sums;
  auto resultant = solution.resultants.begin();
  for (std::size_t i = 0; i < all.names.size(); ++i) {
    Wrench onPad;
    if (all.options[i].isTied()) {
      onPad = all.slaves[i].sign > 0 ? conditions.slaves[i] : conditions.masters[i];
      ofBoth[i] = conditions.slaves[i];
      ofBoth[i].add(conditions.masters[i]);
    } else {
      if (mpi::rank(mesh_.comm) == 0)
        onPad = {mesh::plus(resultant->normalForce, resultant->frictionForce), resultant->moment};
      ++resultant;
    }
    if (all.options[i].onObstacle())
      list.add("interface", all.names[i], sums[i], List::Source::outside);
    else
      list.add(all.options[i].isTied() ? "tie" : "interface", all.names[i], onPad,
               List::Source::inside);
  }
  for (std::size_t i = 0; i < all.names.size(); ++i)
    if (!all.options[i].onObstacle())
      list.add(all.options[i].isTied() ? "tie_offset" : "interface_offset", all.names[i], ofBoth[i],
               List::Source::outside);
  if (mpi::any(mesh_.comm, !mesh_.images.empty()))
    list.add("periodic", "images", conditions.periodicity, List::Source::outside);
}

/// Collective. Adds the loads of a point.
void Reactions::addLoads(const Solution& solution, List& list) const {
  const auto& at = solution.at;
  for (const auto& load : loads_) {
    Wrench sum = load.constant;
    sum.add(load.hydraulic, at.pressure);
    sum.add(load.squared, at.speed * at.speed);
    list.add("load", load.name, sum, List::Source::outside);
  }
  if (!bodies_.rotationStiffness) return;
  const OwnedVec forces = elasticity::nodalVector(mesh_);
  check(MatMult(bodies_.rotationStiffness, solution.displacement, forces));
  check(VecScale(forces, -at.speed * at.speed));
  list.add("load", "convected", ownWrench(mesh_, forces), List::Source::outside);
}

std::vector<Reaction> Reactions::of(const Solution& solution) const {
  List list;
  const ContactForces contact = contactForces(solution);
  const ConditionForces conditions = conditions_.of(contact.rest);
  for (std::size_t i = 0; i < conditions.supports.size(); ++i)
    list.add("support", contact_.interfaces.constraints.groups[i], conditions.supports[i],
             List::Source::outside);
  addGround(solution, list);
  addLinks(solution, list);
  addConditions(conditions, list);
  addInterfaces(solution, contact.sums, conditions, list);
  addLoads(solution, list);
  return list.finish(mesh_.comm);
}

}  // namespace squeal::steady
