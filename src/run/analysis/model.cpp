// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/model.hpp"

#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "model/contact/build.hpp"
#include "model/elasticity/element.hpp"
#include "model/mesh/read.hpp"
#include "model/ties/ties.hpp"
#include "run/analysis/idle_options.hpp"

namespace squeal::analysis {
namespace {

std::string unusedText(PetscInt nodes) {
  if (nodes == 0) return "";
  return nodes == 1 ? "; 1 node in no cell is not used"
                    : "; " + std::to_string(nodes) + " nodes in no cell are not used";
}

std::string straightenedText(const mesh::Straightened& done) {
  if (done.nodes == 0) return "";
  return formatted("; -mesh_straighten: %" PetscInt_FMT " nodes of %" PetscInt_FMT
                   " cells moved by up to %.3g m in %" PetscInt_FMT " rounds, %" PetscInt_FMT
                   " cells were folded",
                   done.nodes, done.cells, done.largestMove, done.rounds, done.folded);
}

mesh::Mesh readMesh(MPI_Comm comm, const ModelSettings& settings) {
  const mesh::Request request = meshRequest(settings);
  Stage stage(comm, "mesh");
  mesh::Mesh mesh = mesh::read(comm, request, settings.file, settings.mesh,
                               {elasticity::foldedAnywhere, elasticity::straightened});
  stage.finish(formatted(
      "%s: %" PetscInt_FMT " nodes, %" PetscInt_FMT " cells, %zu bodies in %d connected parts%s%s",
      settings.file.file.c_str(), mesh.cellNodes(), mesh.totalCells, mesh.bodies.size(),
      mesh.parts - int(mesh.references.size()), unusedText(mesh.unusedNodes).c_str(),
      straightenedText(mesh.straightened).c_str()));
  return mesh;
}

elasticity::Bodies assembleBodies(const mesh::Mesh& mesh, const ModelSettings& settings) {
  Stage stage(mesh.comm, "elasticity");
  elasticity::Bodies bodies = elasticity::assemble(
      mesh, settings.materials, settings.constraints.couplings, settings.elasticity);
  stage.finish(formatted("stiffness, mass and loads on %" PetscInt_FMT " displacements",
                         mesh.dimension * mesh.totalNodes));
  return bodies;
}

interfaces::Interfaces findTies(mesh::Mesh& mesh, const ModelSettings& settings) {
  Stage stage(mesh.comm, "tie");
  auto ties = ties::findTies(mesh, settings.interfaces, settings.constraints);
  if (const auto found = ties::describeTies(ties); !found.empty()) stage.finish(found);
  return ties;
}

contact::Assembled assembleContact(const mesh::Mesh& mesh, elasticity::Bodies bodies,
                                   interfaces::Interfaces ties, const contact::Settings& settings) {
  Stage stage(mesh.comm, "contact");
  auto assembled = contact::assemble(mesh, std::move(bodies), std::move(ties), settings);
  const contact::Contact& contact = assembled.contact;
  stage.finish(formatted("%" PetscInt_FMT " contact nodes on %zu interfaces",
                         contact.interfaces.totalNodes, contact.interfaces.names.size()));
  for (int i = 0; i < std::ssize(contact.interfaces.names); ++i)
    if (const auto& options = contact.interfaces.options[i];
        contact.interfaces.names.size() > 1 || !contact.interfaces.reports[i].matching ||
        options.layerStiffness > 0 || !options.separates)
      printLine(mesh.comm, "  " + interfaces::describe(contact.interfaces, i));
  return assembled;
}

}  // namespace

Model buildModel(MPI_Comm comm, const ModelSettings& settings) {
  Model model;
  model.mesh = std::make_unique<mesh::Mesh>(readMesh(comm, settings));
  warnOfIdleOptions(*model.mesh, settings);
  auto ties = findTies(*model.mesh, settings);  // may move nodes, so before elements
  auto assembled = assembleContact(*model.mesh, assembleBodies(*model.mesh, settings),
                                   std::move(ties), settings.contact);
  model.bodies = std::move(assembled.bodies);
  model.contact = std::move(assembled.contact);
  return model;
}

void requireSupports(const Model& model) {
  try {
    contact::requireSupports(*model.mesh, model.bodies, model.contact);
  } catch (const Error& error) {
    throw Error(std::string(error.what()) +
                "; the audit, which -dry_run prints, lists the supports of each part");
  }
  contact::requireMotion(model.contact);
}

audit::Audit auditModel(const Model& model, const ModelSettings& settings,
                        const std::string& place) {
  Stage stage(model.mesh->comm, "audit");
  auto found = audit::auditOf({*model.mesh, model.bodies, model.contact, settings.materials,
                               settings.constraints.couplings});
  stage.finish(audit::summaryOf(found) + place);
  return found;
}

}  // namespace squeal::analysis
