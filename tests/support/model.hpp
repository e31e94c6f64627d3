// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What tests of single stages share: options in, mesh, bodies and contact out; matrices and
/// vectors as plain arrays on every rank.
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/options/settings.hpp"
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

/// The message of the Error that `action` throws; empty if none.
template <class Action>
std::string errorOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Collective on the communicator. From the options in force.
inline mesh::Mesh readMesh(MPI_Comm comm = PETSC_COMM_WORLD) {
  const auto settings = analysis::ModelSettings::given();
  return mesh::read(comm, analysis::meshRequest(settings), settings.file, settings.mesh,
                    {elasticity::foldedAnywhere, elasticity::straightened});
}

/// Collective. From the options in force.
inline elasticity::Bodies assembleBodies(const mesh::Mesh& mesh) {
  return elasticity::assemble(mesh, material::Settings::given(), elasticity::Settings::given());
}

/// Collective. From the options in force.
inline interfaces::Interfaces findTies(mesh::Mesh& mesh) {
  return ties::findTies(mesh, interfaces::Settings::given());
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
  model.bodies = assembleBodies(*model.mesh);
  model.contact =
      contact::build(*model.mesh, model.bodies, std::move(ties), contact::Settings::given());
  return model;
}

/// Collective. All entries on every rank.
inline linalg::DenseMatrix denseCopy(Mat matrix) {
  PetscInt rowCount = 0, columnCount = 0;
  check(MatGetSize(matrix, &rowCount, &columnCount));
  OwnedIS rows, columns;
  check(ISCreateStride(PETSC_COMM_SELF, rowCount, 0, 1, rows.out()));
  check(ISCreateStride(PETSC_COMM_SELF, columnCount, 0, 1, columns.out()));
  const IS rowSets[] = {rows}, columnSets[] = {columns};
  Mat* sub = nullptr;
  check(MatCreateSubMatrices(matrix, 1, rowSets, columnSets, MAT_INITIAL_MATRIX, &sub));
  OwnedMat dense;
  check(MatConvert(sub[0], MATSEQDENSE, MAT_INITIAL_MATRIX, dense.out()));
  check(MatDestroySubMatrices(1, &sub));
  const PetscScalar* values = nullptr;
  check(MatDenseGetArrayRead(dense, &values));
  linalg::DenseMatrix copy(linalg::DenseView(values, rowCount, columnCount));
  check(MatDenseRestoreArrayRead(dense, &values));
  return copy;
}

/// Collective. All entries on every rank.
inline std::vector<double> allEntries(Vec vector) {
  OwnedScatter scatter;
  OwnedVec all;
  check(VecScatterCreateToAll(vector, scatter.out(), all.out()));
  check(VecScatterBegin(scatter, vector, all, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter, vector, all, INSERT_VALUES, SCATTER_FORWARD));
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  check(VecGetSize(all, &size));
  check(VecGetArrayRead(all, &values));
  std::vector<double> copy(values, values + size);
  check(VecRestoreArrayRead(all, &values));
  return copy;
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

/// Collective. xᵀ A y.
inline double form(Vec x, Mat a, Vec y) {
  OwnedVec product;
  check(VecDuplicate(x, product.out()));
  check(MatMult(a, y, product));
  PetscScalar value = 0;
  check(VecDot(x, product, &value));
  return value;
}

inline double dot(Vec x, Vec y) {
  PetscScalar value = 0;
  check(VecDot(x, y, &value));
  return value;
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

/// Collective. u = A⁻¹ b by MUMPS.
inline void solveDirectly(Mat matrix, Vec rhs, Vec u) {
  OwnedKSP solver;
  PC pc = nullptr;
  check(KSPCreate(commOf(matrix), solver.out()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPPREONLY));
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(KSPSolve(solver, rhs, u));
}

/// Collective. A file of the test, written by one rank before any reads it.
inline std::string writeFile(const std::string& name, const std::string& text) {
  const std::string path = SQUEAL_OUTPUT_DIR "/" + name;
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) std::ofstream(path) << text;
  check(MPI_Barrier(PETSC_COMM_WORLD));
  return path;
}

}  // namespace squeal::test
