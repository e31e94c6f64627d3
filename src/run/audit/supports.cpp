// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/supports.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/loose.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::audit {
namespace {

/// Counts the nodes of each part by their supports.
class Counts {
 public:
  explicit Counts(const mesh::Mesh& mesh) : mesh_(mesh) {}
  /// Begins a support; all ranks begin the same ones.
  void begin(const std::string& name) {
    names_.push_back(name);
    counts_.resize(counts_.size() + mesh_.parts);
  }
  void add(int part) { ++counts_[counts_.size() - mesh_.parts + part]; }
  void addNode(PetscInt local) { add(mesh_.nodePart[local]); }
  /// Collective.
  std::vector<PartSupports> finish() {
    mpi::reduce<PetscInt>(mesh_.comm, counts_, MPI_SUM);
    std::vector<PartSupports> parts;
    for (int part = 0; part < mesh_.parts; ++part) {
      auto& [name, supports, needsContact] = parts.emplace_back();
      name = mesh_.partName[part];
      for (std::size_t i = 0; i < names_.size(); ++i)
        if (const PetscInt count = counts_[i * mesh_.parts + part]; count > 0)
          supports.push_back({names_[i], count});
    }
    return parts;
  }

 private:
  const mesh::Mesh& mesh_;
  std::vector<std::string> names_;
  std::vector<PetscInt> counts_;  // [support][part]
};

std::string quoted(const char* what, const std::string& name) {
  return std::string(what) + " '" + name + "'";
}

void countSupports(const Subject& model, Counts& counts) {
  const auto& mesh = model.mesh;
  const auto& constraints = model.contact.interfaces.constraints;
  for (int group = 0; group < std::ssize(constraints.groups); ++group) {
    counts.begin(quoted("support", constraints.groups[group]));
    for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
      const auto first = constraints.heldBy.begin() + mesh.dimension * node;
      if (std::find(first, first + mesh.dimension, group) != first + mesh.dimension)
        counts.addNode(node);
    }
  }
  for (const auto& [group, ground] : model.bodies.settings.ground) {
    if (!ground.springs) continue;
    counts.begin(quoted("springs of", group));
    for (const PetscInt node : mesh.nodeGroups.at(group)) counts.addNode(node);
  }
}

/// Counts the ends of springs and bushings.
void countLinks(const Subject& model, Counts& counts) {
  const auto& mesh = model.mesh;
  std::map<std::string, std::set<PetscInt>> nodes;  // global nodes; a bushing has several forms
  for (const auto& link : model.bodies.links)
    for (const auto& term : link.terms) {
      const auto* reference = mesh.referenceWith(term.node);
      nodes[link.name].insert(reference ? reference->displacement : term.node);
    }
  for (const auto& [name, ends] : nodes) {
    counts.begin(name);
    for (const PetscInt node : ends)
      if (const PetscInt own = mesh.ownedNode(node); own >= 0) counts.addNode(own);
  }
}

void countInterfaces(const Subject& model, Counts& counts) {
  const auto& all = model.contact.interfaces;
  const auto addMasters = [&](const std::vector<coupling::PartShare>& parts) {
    for (const auto& [part, share] : parts) counts.add(part);
  };
  for (int i = 0; i < std::ssize(all.options); ++i) {
    counts.begin(all.options[i].label());
    for (const auto& node : all.nodes)
      if (node.interface == i) counts.addNode(node.node), addMasters(node.masterParts);
    for (const auto& tied : all.tied)
      if (tied.interface == i) counts.addNode(tied.connection.node), addMasters(tied.masterParts);
  }
}

void countCouplings(const Subject& model, Counts& counts) {
  const auto& mesh = model.mesh;
  const auto& all = model.contact.interfaces;
  for (int i = 0; i < std::ssize(all.couplings); ++i) {
    counts.begin(all.couplings[i].label());
    for (const auto& coupled : all.coupled) {
      if (coupled.coupling != i || mesh.isRotation(mesh.globalNode[coupled.node])) continue;
      counts.addNode(coupled.node);
      std::set<int> parts;
      for (const auto& master : coupled.masters) {
        if (coupled.distributed) counts.add(master.part);  // the nodes that it follows
        parts.insert(master.part);
      }
      if (!coupled.distributed)
        for (const int part : parts) counts.add(part);
    }
  }
  for (const auto& equation : all.constraints.equations) {
    counts.begin(quoted("equation", equation.name));
    for (const auto& term : equation.terms)
      if (const PetscInt node = constraints::nodeOf(mesh, term); node >= 0) counts.addNode(node);
  }
  counts.begin("periodic images");
  for (const auto& image : mesh.images) counts.addNode(image.node), counts.add(image.primaryPart);
}

}  // namespace

std::vector<PartSupports> partSupports(const Subject& model) {
  Counts counts(model.mesh);
  countSupports(model, counts);
  countLinks(model, counts);
  countInterfaces(model, counts);
  countCouplings(model, counts);
  auto parts = counts.finish();
  const auto loose = contact::looseParts(model.mesh, model.contact, model.bodies,
                                         {.any = false, .closed = {}, .released = {}});
  for (std::size_t part = 0; part < parts.size(); ++part) parts[part].needsContact = loose[part];
  return parts;
}

Findings conditionFindings(const Subject& model) {
  Findings findings;
  const auto& all = model.contact.interfaces;
  for (std::size_t i = 0; i < all.options.size(); ++i) {
    const auto& options = all.options[i];
    const auto& report = all.reports[i];
    const auto add = [&](Kind kind, Severity severity, const std::string& text,
                         const std::string& remedy) {
      findings.push_back({kind, severity, options.label() + ": " + text, remedy});
    };
    const char *slave = all.slaves[i].surface.c_str(), *pad = options.surfaces.pad.name.c_str(),
               *disc = options.surfaces.disc.name.c_str();
    if (report.loss.nodes > 0)
      add(Kind::overconstrained, Severity::warning,
          counted(report.loss.nodes, "node") +
              formatted(" of '%s' without a condition here, the first at %s, because %s joins them "
                        "already",
                        slave, interfaces::text(report.loss.first).c_str(),
                        joined(report.loss.owners, " and ").c_str()),
          "exchange the slave and the master of a tie, or separate the surfaces");
    if (report.carried > 0)
      add(Kind::overconstrained, Severity::note,
          counted(report.carried, "displacement") +
              formatted(" of tied nodes of '%s' with a support as well, which acts on the nodes of "
                        "'%s' that they follow",
                        slave, disc),
          "leave these nodes out of the support or out of the tie, unless this is intended");
    if (report.strain.cells > 0)
      add(Kind::adjustment, Severity::warning,
          formatted("moving '%s' onto '%s', by up to %.3g m, stretches or compresses %s by more "
                    "than a tenth, at most by %.3g %% at %s",
                    pad, disc, report.largestAdjustment,
                    counted(report.strain.cells, "cell").c_str(), 100 * report.strain.change,
                    interfaces::text(report.strain.where).c_str()),
          "let the surfaces touch in the geometry, or give " +
              interfaces::adjustName(options.surfaces.name) + " off");
  }
  return findings;
}

}  // namespace squeal::audit
