// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/own_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/factor/associated_system.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/matrix.hpp"
#include "base/system/mpi.hpp"
#include "eigen/modes/modes.hpp"
#include "problem/matrices/associated.hpp"

namespace squeal::energies {
namespace {

constexpr double shiftShare = 0.01;  // σ relative to the Rayleigh quotient of a stretch
constexpr double rigidShare = 1e-6;  // largest ω² of a rigid mode, relative to σ

/// The matrices of one body in space, of the unknowns [node of the body][component].
struct BodyMatrices {
  OwnedMat stiffness, mass;
};

/// Collective. Adds the square part of some rows of a matrix to a sum, which is created if null.
void addSquare(Mat rows, IS columns, OwnedMat& sum) {
  OwnedMat square;
  check(MatCreateSubMatrix(rows, ownRows(rows), columns, MAT_INITIAL_MATRIX, square.out()));
  if (!sum)
    sum = std::move(square);
  else
    check(MatAXPY(sum, 1, square, DIFFERENT_NONZERO_PATTERN));
}

/// Collective. Returns the matrices of a body; null ones if no material group belongs to it.
BodyMatrices matricesOf(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, int body,
                        const std::vector<PetscInt>& nodes) {
  const OwnedIS own = elasticity::rowsOf(mesh, nodes);
  BodyMatrices sums;
  for (int group = 0; group < std::ssize(mesh.materialGroups); ++group) {
    if (mesh.materialGroups[group].body != body) continue;
    const auto part = elasticity::materialRows(mesh, bodies, group, nodes);
    addSquare(part.stiffness, own, sums.stiffness);
    addSquare(part.mass, own, sums.mass);
  }
  if (sums.stiffness)
    sums = {matrices::symmetrised(sums.stiffness), matrices::symmetrised(sums.mass)};
  return sums;
}

/// Collective. Returns wᵀ K w / wᵀ M w for the stretch w = X − X_c; 0 without mass.
double stretchQuotient(const mesh::Mesh& mesh, const BodyMatrices& body,
                       const std::vector<PetscInt>& nodes) {
  std::array<double, 4> sums{};
  for (const PetscInt node : nodes) {
    for (std::size_t d = 0; d < 3; ++d) sums[d] += mesh.coordinates[node][d];
    sums[3] += 1;
  }
  mpi::sumAlike(mesh.comm, sums);
  OwnedVec w, product;
  check(MatCreateVecs(body.mass, w.out(), product.out()));
  {
    const WriteArray values(w);
    std::size_t i = 0;
    for (const PetscInt node : nodes)
      for (int d = 0; d < mesh.dimension; ++d)
        values[i++] = mesh.coordinates[node][d] - sums[d] / sums[3];
  }
  const auto form = [&](Mat matrix) {
    double value = 0;
    check(MatMult(matrix, w, product));
    check(VecDot(w, product, &value));
    return value;
  };
  const double mass = form(body.mass);
  return mass > 0 ? form(body.stiffness) / mass : 0;
}

/// Collective. Returns the elastic modes among the lowest ones of K + σ M.
OwnModes elasticModes(const modes::Modes& all, double sigma) {
  const auto rigid = std::ranges::count_if(
      all.lambda, [&](double lambda) { return lambda - sigma <= rigidShare * sigma; });
  OwnModes found;
  for (const double lambda : all.lambda)
    if (lambda - sigma > rigidShare * sigma)
      found.angularFrequency.push_back(std::sqrt(lambda - sigma));
  const linalg::ReadColumns vectors(all.vectors);
  found.vectors = linalg::DenseMatrix(vectors.view().columnRange(rigid, all.lambda.size()));
  return found;
}

OwnModes ownModesOf(const mesh::Mesh& mesh, BodyMatrices matrices,
                    const std::vector<PetscInt>& nodes, const std::string& name, int count) {
  const double sigma = shiftShare * stretchQuotient(mesh, matrices, nodes);
  if (!(sigma > 0)) return {};
  check(MatAXPY(matrices.stiffness, sigma, matrices.mass, SUBSET_NONZERO_PATTERN));
  PetscInt size = 0;
  check(MatGetSize(matrices.mass, &size, nullptr));
  const factor::AssociatedSystem system(std::move(matrices.stiffness), std::move(matrices.mass),
                                        "stiffness of " + name + " by itself");
  const int rigid = mesh.dimension == 3 ? 6 : 3;
  // A body in several pieces has further rigid modes.
  for (PetscInt wanted = std::min<PetscInt>(size, count + rigid);;) {
    const auto all = modes::compute(system, modes::Settings{}.withCount(wanted),
                                    {.stage = "component modes", .subject = name + ": "});
    OwnModes found = elasticModes(all, sigma);
    const PetscInt missing = count - std::ssize(found.angularFrequency);
    if (missing <= 0 || wanted == size) return found;
    wanted = std::min<PetscInt>(size, wanted + missing);
  }
}

}  // namespace

std::vector<std::vector<PetscInt>> nodesOfBodies(const mesh::Mesh& mesh) {
  const PetscInt count = mesh.bodies.size();
  OwnedVec cells;  // [owned node][body] ranks with cells of the body at the node
  check(VecCreateMPI(mesh.comm, count * mesh.ownedNodes, PETSC_DETERMINE, cells.out()));
  std::vector<unsigned char> touches(count * mesh.localNodes(), 0);  // [local node][body]
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (const PetscInt node : block.nodesOf(e)) touches[count * node + block.body[e]] = 1;
  for (PetscInt node = 0; node < mesh.localNodes(); ++node)
    for (PetscInt body = 0; body < count; ++body)
      if (touches[count * node + body])
        check(VecSetValue(cells, count * mesh.globalNode[node] + body, 1, ADD_VALUES));
  check(VecAssemblyBegin(cells));
  check(VecAssemblyEnd(cells));
  const ReadArray values(cells);
  std::vector<std::vector<PetscInt>> nodes(count);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (PetscInt body = 0; body < count; ++body)
      if (values[count * node + body] != 0) nodes[body].push_back(node);
  return nodes;
}

std::vector<OwnModes> ownModes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                               const std::vector<std::vector<PetscInt>>& nodes, int count) {
  if (count == 0) return {};
  std::vector<OwnModes> found(nodes.size());
  for (std::size_t body = 0; body < nodes.size(); ++body)
    if (BodyMatrices matrices = matricesOf(mesh, bodies, body, nodes[body]); matrices.stiffness)
      found[body] = ownModesOf(mesh, std::move(matrices), nodes[body], mesh.bodies[body], count);
  return found;
}

}  // namespace squeal::energies
