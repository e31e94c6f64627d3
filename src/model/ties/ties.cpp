// SPDX-License-Identifier: BSD-2-Clause
#include "model/ties/ties.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/coupling/covered.hpp"
#include "model/coupling/exchange.hpp"
#include "model/interfaces/candidates.hpp"
#include "model/interfaces/chains.hpp"
#include "model/interfaces/lost.hpp"
#include "model/mortar/face.hpp"
#include "model/ties/adjustment.hpp"
#include "model/ties/matched.hpp"

namespace squeal::ties {

using namespace interfaces;

namespace {

/// Collective. Fills the tied nodes, with their levels, and the reports of the ties.
void coupleTies(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all) {
  // First the nodes with several masters, since only nodes of pairs have a choice.
  Claims claims(mesh, exchange);
  for (int i = 0; i < std::ssize(all.options); ++i) {
    if (!all.options[i].isTied() || mesh.interfaces[i].matching) continue;
    const auto found =
        candidatesOf(mesh, exchange, nullptr, i, claims.against(Role::tied, i, all), all);
    claims.add(nodesOf(found), all.options, i);
    for (const auto& [interface, discBody, partner, slave] : found)
      all.tied.push_back({i, connectionOf(slave), slave.masterParts, slave.offset, {}});
  }
  tieMatched(mesh, exchange, all);
  std::stable_sort(all.tied.begin(), all.tied.end(), [](const auto& a, const auto& b) {
    return a.connection.node < b.connection.node;
  });
  setLevels(mesh, all);
}

/// Collective. Sets the members of the reports of the ties that coupleTies() does not set.
void report(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& all) {
  for (int i = 0; i < std::ssize(all.options); ++i) {
    if (!all.options[i].isTied()) continue;
    InterfaceReport& report = all.reports[i];
    double sums[] = {0, 0};  // faces and their area
    for (const auto& face : mortar::facesOf(mesh, all.slaves[i].surface))
      sums[0] += 1, sums[1] += coupling::areaOf(face);
    // nodes of the slave, tied nodes
    const auto slaveNodes = slaveNodesOf(mesh, exchange, all.slaves[i].surface);
    PetscInt counts[] = {PetscInt(slaveNodes.size()), 0};
    for (const auto& node : all.tied) counts[1] += node.interface == i;
    mpi::reduce<PetscInt>(mesh.comm, counts, MPI_SUM);
    mpi::reduce<double>(mesh.comm, sums, MPI_SUM);
    if (!report.matching) report.nodes = counts[1];
    report.untied = counts[0] - report.nodes;
    if (!report.matching) continue;
    report.slave.faces = report.slave.nearFaces = PetscInt(sums[0]);
    report.slave.area = report.slave.nearArea = sums[1];
    report.coveredArea = sums[1] - areaOfLost(mesh, exchange, all, i);
  }
}

void warnOfLittleCover(const mesh::Mesh& mesh, const Interfaces& all) {
  for (std::size_t i = 0; i < all.options.size(); ++i) {
    const auto& options = all.options[i];
    const auto& report = all.reports[i];
    if (!options.isTie() || report.coveredArea >= 0.5 * report.slave.area) continue;
    printWarning(mesh.comm,
                 formatted("warning: %s ties %.3g %% of the area of its slave '%s', %.4g of %.4g "
                           "m2; no part of '%s' faces the rest within %s",
                           options.label().c_str(), 100 * report.coveredArea / report.slave.area,
                           options.surfaces.pad.name.c_str(), report.coveredArea, report.slave.area,
                           options.surfaces.disc.name.c_str(), searchText(options).c_str()));
  }
}

}  // namespace

Interfaces findTies(mesh::Mesh& mesh, const interfaces::Settings& settings,
                    const constraints::Settings& supports) {
  Interfaces all;
  for (const auto& match : mesh.interfaces) {
    const auto& options = all.options.emplace_back(settings.interface(match.label));
    all.names.push_back(options.surfaces.name);
    all.obstacles.push_back({options.obstacleVelocity.in(mesh.dimension),
                             options.obstacleDisplacement.in(mesh.dimension)});
  }
  for (const auto& interface : all.options) all.slaves.push_back({interface.surfaces.pad.name, 1});
  all.reports.resize(all.options.size());
  const coupling::NodeExchange exchange(mesh);
  coupleTies(mesh, exchange, all);
  const auto adjusted = [](const InterfaceSettings& options) { return options.adjust; };
  if (std::any_of(all.options.begin(), all.options.end(), adjusted))
    moveOntoMasters(mesh, exchange, all);
  for (const auto& [node, layer] : mesh.layers) mesh.coordinates[layer] = mesh.coordinates[node];
  all.constraints = constraints::constraintsOf(mesh, supports);
  all.coupled = constraints::coupledNodes(mesh, supports);
  all.couplings = constraints::couplingNames(supports);
  report(mesh, exchange, all);
  warnOfLost(mesh, exchange, all, Role::tied);
  warnOfLittleCover(mesh, all);
  return all;
}

std::string describeTies(const Interfaces& ties) {
  PetscInt nodes = 0;
  int count = 0;
  double largest = 0;
  for (std::size_t i = 0; i < ties.options.size(); ++i) {
    if (!ties.options[i].isTied()) continue;
    ++count, nodes += ties.reports[i].nodes;
    largest = std::max(largest, ties.reports[i].largestAdjustment);
  }
  if (count == 0) return "";
  return formatted("%" PetscInt_FMT " nodes in %d %s, moved by up to %.2g m", nodes, count,
                   count == 1 ? "tie" : "ties", largest);
}

}  // namespace squeal::ties
