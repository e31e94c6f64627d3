// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/tightening.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/petsc/arrays.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/contact/build.hpp"
#include "model/contact/coupled.hpp"
#include "model/mesh/vector.hpp"
#include "steady/condensed/condensed_problem.hpp"
#include "steady/steady/nodal_forces.hpp"

namespace squeal::analysis {
namespace {

/// The body that a bolt cuts.
struct BoltBody {
  int body = -1;      // index into Mesh::bodies
  double length = 0;  // along the normal of the section, m
};

/// Collective. Returns the body of a bolt.
BoltBody bodyOf(const mesh::Mesh& mesh, int section) {
  std::set<PetscInt> nodes;  // on the upper side, which this rank owns
  for (const auto& pair : mesh.sectionPairs)
    if (pair.section == section) nodes.insert(pair.node);
  BoltBody found;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      if (std::ranges::any_of(block.nodesOf(e),
                              [&](PetscInt node) { return nodes.contains(node); }))
        found.body = block.body[e];
  found.body = mpi::max(mesh.comm, found.body);
  double low = INFINITY, high = -INFINITY;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      if (block.body[e] == found.body)
        for (const PetscInt node : block.nodesOf(e)) {
          const double x = mesh::dot(mesh.coordinates[node], mesh.sections[section].normal);
          low = std::min(low, x), high = std::max(high, x);
        }
  found.length = mpi::max(mesh.comm, high) - mpi::min(mesh.comm, low);
  return found;
}

/// Returns the forces of the bolts on the openings of their sections.
OwnedVec tensions(const mesh::Mesh& mesh, const std::vector<constraints::BoltSettings>& bolts) {
  OwnedVec load = elasticity::nodalVector(mesh);
  const WriteArray values(load);
  for (std::size_t i = 0; i < bolts.size(); ++i) {
    const auto& section = mesh.sections[i];
    const PetscInt node = mesh.ownedNode(mesh.references[section.reference].displacement);
    if (!bolts[i].force || node < 0) continue;
    for (int d = 0; d < mesh.dimension; ++d)
      values[mesh.dimension * node + d] = -*bolts[i].force * section.normal[d];
  }
  return load;
}

/// Collective. Returns the opening of each section, m.
std::vector<double> openingsOf(const mesh::Mesh& mesh, Vec displacement) {
  std::vector<double> openings(mesh.sections.size(), 0.0);
  const ReadArray u(displacement);
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const auto& section = mesh.sections[i];
    const PetscInt node = mesh.ownedNode(mesh.references[section.reference].displacement);
    if (node < 0) continue;
    for (int d = 0; d < mesh.dimension; ++d)
      openings[i] += section.normal[d] * u[mesh.dimension * node + d];
  }
  mpi::reduce<double>(mesh.comm, openings, MPI_SUM);
  return openings;
}

/// Collective. Warns of bolts that become shorter by more than a tenth of the length of their body
/// along them, or longer: the strains are not small.
void warnOfShortening(const mesh::Mesh& mesh, const std::vector<constraints::BoltSettings>& bolts,
                      const std::vector<double>& openings) {
  constexpr double large = 0.1;
  for (std::size_t i = 0; i < bolts.size(); ++i) {
    const BoltBody body = bodyOf(mesh, int(i));
    if (std::abs(openings[i]) <= large * body.length) continue;
    printWarning(
        mesh.comm,
        formatted("warning: bolt '%s' becomes %.4g m %s, %.3g times the length of its body "
                  "'%s' along it, %.4g m; strains are not small: check the unit of %s and "
                  "the modulus of the body",
                  bolts[i].name.c_str(), std::abs(openings[i]),
                  openings[i] < 0 ? "shorter" : "longer", std::abs(openings[i]) / body.length,
                  mesh.bodies[body.body].c_str(), body.length,
                  (bolts[i].force ? constraints::boltForceName(bolts[i].name)
                                  : constraints::boltShorteningName(bolts[i].name))
                      .c_str()));
  }
}

/// Collective. Returns the state in which the bolts have their tensions, which are loads of the
/// model, without swept friction. A small speed gives interfaces with their own coefficient of
/// friction a direction to slide.
steady::Solution tightened(const Model& model, bool withPressure) {
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const contact::CoupledSystem system(model.bodies, model.contact, model.bonded());
  const sweep::Parameters at{.friction = 0, .speed = 1e-6, .pressure = withPressure ? 1.0 : 0.0};
  if (!withPressure) return problem.solve(at, system);
  return condensed::CondensedProblem(problem, system).solveWithPivots(at);
}

}  // namespace

void tightenBolts(Model& model, const constraints::Settings& settings) {
  const auto& bolts = settings.bolts;
  const mesh::Mesh& mesh = *model.mesh;
  if (std::ranges::none_of(bolts, [](const auto& bolt) { return bolt.force.has_value(); })) {
    std::vector<double> given;
    for (const auto& bolt : bolts) given.push_back(-*bolt.shortening);
    return warnOfShortening(mesh, bolts, given);
  }
  Stage stage(mesh.comm, "bolts");
  const OwnedVec load = tensions(mesh, bolts);
  OwnedVec constant = std::move(model.bodies.constantLoad);
  model.bodies.constantLoad = elasticity::nodalVector(mesh);
  if (constant) check(VecCopy(constant, model.bodies.constantLoad));
  check(VecAXPY(model.bodies.constantLoad, 1, load));
  check(VecAXPY(model.bodies.load, 1, load));
  const steady::Solution solution = tightened(model, settings.boltsUnderPressure);
  if (!solution.converged)
    throw Error("the step that tightens the bolts has no solution: " + solution.reason +
                (settings.boltsUnderPressure ? ""
                                             : "; if only the pressures press some parts on "
                                               "others, give " +
                                                   constraints::boltsUnderPressureName() + " on"));
  const auto openings = openingsOf(mesh, solution.displacement);
  check(VecAXPY(model.bodies.load, -1, load));
  model.bodies.constantLoad = std::move(constant);
  contact::lockBolts(model.contact, model.bodies, openings);
  std::string text;
  for (std::size_t i = 0; i < bolts.size(); ++i)
    text += formatted("%s'%s' is %.6g m shorter", i == 0 ? "" : ", ", bolts[i].name.c_str(),
                      -openings[i]);
  stage.finish(text);
  warnOfShortening(mesh, bolts, openings);
}

std::vector<double> boltForces(const Model& model, const steady::Solution& solution) {
  const mesh::Mesh& mesh = *model.mesh;
  std::vector<double> forces(mesh.sections.size(), 0.0);
  if (forces.empty()) return forces;
  const OwnedVec nodal =
      steady::supportForces(mesh, model.bodies, solution.at, solution.displacement);
  {
    const ReadArray values(nodal);
    for (const auto& [node, lower, section, part] : mesh.sectionPairs)
      for (int d = 0; d < mesh.dimension; ++d)
        forces[section] -= mesh.sections[section].normal[d] * values[mesh.dimension * node + d];
  }
  mpi::reduce<double>(mesh.comm, forces, MPI_SUM);
  return forces;
}

}  // namespace squeal::analysis
