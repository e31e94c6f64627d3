// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What tests of single stages share: options in, mesh, bodies and contact out.
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/options/settings.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "model/contact/build.hpp"
#include "model/contact/contact.hpp"
#include "model/contact/coupled.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/element.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/read.hpp"
#include "model/mesh/vector.hpp"
#include "model/ties/ties.hpp"
#include "run/analysis/analysis.hpp"
#include "run/analysis/model_settings.hpp"
#include "support/algebra/sparse.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/reader.hpp"

namespace squeal::test {

/// Replaces the contents of the options database by these.
inline void setOptions(const std::string& options) {
  clearOptions();
  insert(settingsOfText("-quiet " + options));
}

/// The same for a case file with changes.
inline void setCase(const std::string& name, const std::string& changes = {}) {
  clearOptions();
  insertFile(PETSC_COMM_WORLD, "options/" + name + ".yaml");
  insert(settingsOfText("-quiet " + changes));
}

inline std::string material(const std::string& body, const std::string& young,
                            const std::string& poisson, const std::string& density) {
  const std::string name = " -material_" + body;
  return name + "_young " + young + name + "_poisson " + poisson + name + "_density " + density +
         " ";
}

/// Collective on the communicator. From the options in force.
inline mesh::Mesh readMesh(MPI_Comm comm = PETSC_COMM_WORLD) {
  const auto settings = analysis::ModelSettings::given();
  return mesh::read(comm, analysis::meshRequest(settings), settings.file, settings.mesh,
                    {elasticity::foldedAnywhere, elasticity::straightened}, readInCopy);
}

/// Collective. The message of the error of reading the file with these options; empty if it is
/// read.
inline std::string messageOfMesh(const std::string& file, const std::string& options) {
  setOptions("-mesh_file " + file + " " + options);
  return errorOf([] { readMesh(); });
}

/// Collective. From the options in force.
inline elasticity::Bodies assembleBodies(const mesh::Mesh& mesh) {
  return elasticity::assemble(mesh, material::Settings::given(),
                              constraints::Settings::given().couplings,
                              elasticity::Settings::given());
}

/// Collective. From the options in force.
inline interfaces::Interfaces findTies(mesh::Mesh& mesh) {
  return ties::findTies(mesh, interfaces::Settings::given(), constraints::Settings::given());
}

/// Collective. With supports that suffice; from the options in force.
inline contact::Assembled assembleContact(const mesh::Mesh& mesh, elasticity::Bodies bodies,
                                          interfaces::Interfaces ties) {
  auto assembled =
      contact::assemble(mesh, std::move(bodies), std::move(ties), contact::Settings::given());
  contact::requireSupports(mesh, assembled.bodies, assembled.contact);
  return assembled;
}

/// The stages before the first solution. Contact borrows the mesh, which therefore keeps its
/// address.
struct Model {
  std::unique_ptr<mesh::Mesh> mesh;
  elasticity::Bodies bodies;
  contact::Contact contact;
};

/// Collective. From the options in force.
inline Model buildModel() {
  Model model;
  model.mesh = std::make_unique<mesh::Mesh>(readMesh());
  auto ties = findTies(*model.mesh);
  auto assembled = assembleContact(*model.mesh, assembleBodies(*model.mesh), std::move(ties));
  model.bodies = std::move(assembled.bodies);
  model.contact = std::move(assembled.contact);
  return model;
}

/// Collective. A nodal vector with the values of `field(x)`, a Point.
template <class Field>
OwnedVec nodalField(const mesh::Mesh& mesh, const Field& field) {
  OwnedVec u = elasticity::nodalVector(mesh);
  PetscScalar* values = nullptr;
  check(VecGetArray(u, &values));
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    const mesh::Point value = field(mesh.coordinates[node]);
    for (int d = 0; d < mesh.dimension; ++d) values[mesh.dimension * node + d] = value[d];
  }
  check(VecRestoreArray(u, &values));
  return u;
}

/// Collective. The rigid motion shift + turn × x of the mesh and of its reference nodes, which have
/// the rotation `turn`. In space.
inline OwnedVec rigidMotion(const mesh::Mesh& mesh, const mesh::Point& shift,
                            const mesh::Point& turn) {
  OwnedVec u = nodalField(
      mesh, [&](const mesh::Point& x) { return mesh::plus(shift, mesh::cross(turn, x)); });
  const WriteArray values(u);
  for (const auto& reference : mesh.references)
    if (const PetscInt node = mesh.ownedNode(reference.rotation); node >= 0)
      for (int d = 0; d < 3; ++d) values[3 * node + d] = turn[d];
  return u;
}

using mesh::dot;

/// The bodies without contact.
struct Built {
  mesh::Mesh mesh;
  elasticity::Bodies bodies;
};

/// Collective. Builds the bodies from only these options.
inline Built buildBodies(const std::string& options) {
  setOptions(options);
  Built built{readMesh(), {}};
  built.bodies = assembleBodies(built.mesh);
  return built;
}

}  // namespace squeal::test
