// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/coupled.hpp"

#include <algorithm>

#include "base/petsc/log_events.hpp"
#include "base/petsc/matrix.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::contact {
namespace {

/// Collective. Returns Aᵀ B. With Aᵀ at hand, PETSc multiplies much faster. Its workspace, which
/// contains a copy of B, is freed, since a sweep may hold hundreds of such products.
OwnedMat transposedProduct(Mat a, Mat b) {
  OwnedMat transposed, result;
  check(MatTranspose(a, MAT_INITIAL_MATRIX, transposed.out()));
  check(MatMatMult(transposed, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  check(MatProductClear(result));
  return result;
}

}  // namespace

OwnedMat Projection::friction(Mat slipRows) const { return transposedProduct(slipRows, reaction); }

Projection project(const Contact& contact, const Transformation& transformation, Mat x) {
  Projection projection;
  if (!x) return projection;
  ++sparseWork().projections;
  OwnedMat xt;
  check(MatMatMult(x, transformation.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT, xt.out()));
  projection.matrix = transposedProduct(transformation.trial, xt);
  check(MatMatMult(contact.sliding.reaction, xt, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   projection.reaction.out()));
  check(MatProductClear(projection.reaction));
  if (isSymmetric(x)) check(MatSetOption(projection.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return projection;
}

OwnedMat Projection::tested(Mat slipRows) const {
  OwnedMat sum;
  check(MatDuplicate(matrix, MAT_COPY_VALUES, sum.out()));
  if (!slipRows) return sum;
  // The normal force of a contact node and its tangential rows come from the same cells, so the
  // pattern of Sᵀ N X T is part of that of Tᵀ X T.
  check(MatAXPY(sum, 1, friction(slipRows), SUBSET_NONZERO_PATTERN));
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_FALSE));
  return sum;
}

namespace {

/// Collective. Returns the number of contact nodes that are not closed, over all ranks.
PetscInt countOpen(MPI_Comm comm, const Mask& closed) {
  return mpi::sum(comm, PetscInt(std::ranges::count(closed, 0)));
}

/// Throws Error if nothing can move.
void requireUnknowns(const Contact& contact, const Transformation& transformation) {
  if (transformation.columns > 0) return;
  std::vector<std::string> holding;
  const auto& all = contact.interfaces;
  for (const auto& group : all.constraints.groups) holding.push_back("constraint '" + group + "'");
  for (const auto& coupling : all.couplings) holding.push_back(coupling.label());
  for (const auto& interface : all.options) holding.push_back(interface.label());
  throw Error(formatted("no displacement is unknown: all %" PetscInt_FMT
                        " nodes are held, or follow nodes that are (",
                        contact.mesh->totalNodes) +
              joined(holding) + "); free some of them");
}

/// Collective. Returns T of an active set. Throws Error if nothing can move.
Transformation transformationOf(const Contact& contact, const ActiveSet& set) {
  ActiveSet free{set.closed, {}};  // open nodes are also free along the surface
  for (const auto isClosed : set.closed) free.released.push_back(!isClosed);
  for (std::size_t i = 0; i < set.released.size(); ++i)
    free.released[i] = free.released[i] || set.released[i];
  Transformation transformation = contact.transformation(free);
  requireUnknowns(contact, transformation);
  return transformation;
}

Projections projectAll(const elasticity::Bodies& bodies, const Contact& contact,
                       const ActiveSet& set, Mat prestress) {
  Projections result;
  result.transformation = transformationOf(contact, set);
  OwnedMat stressed;
  if (prestress) {
    check(MatDuplicate(bodies.stiffness, MAT_COPY_VALUES, stressed.out()));
    check(MatAXPY(stressed, 1, prestress,
                  bodies.linkStiffness || bodies.layerStiffness ? SUBSET_NONZERO_PATTERN
                                                                : SAME_NONZERO_PATTERN));
    check(MatSetOption(stressed, MAT_SYMMETRIC, PETSC_TRUE));
  }
  const auto projected = [&](Mat x) { return project(contact, result.transformation, x); };
  result.stiffness = projected(prestress ? stressed.get() : bodies.stiffness.get());
  result.mass = projected(bodies.mass);
  result.damping = projected(bodies.damping);
  result.gyroscopic = projected(bodies.gyroscopic);
  result.rotationStiffness = projected(bodies.rotationStiffness);
  return result;
}

/// Collective. Returns the unknowns of this rank of an active set in the numbers of those with all
/// contact open.
OwnedIS columnsOf(MPI_Comm comm, const Transformation& set, const Transformation& open) {
  const PetscInt first = mpi::sumBefore(comm, open.ownedColumns);
  std::vector<PetscInt> columns;
  for (const PetscInt row : set.rows)
    columns.push_back(first + (std::ranges::lower_bound(open.rows, row) - open.rows.begin()));
  OwnedIS part;
  check(ISCreateGeneral(comm, columns.size(), columns.data(), PETSC_COPY_VALUES, part.out()));
  return part;
}

/// Collective. Returns the rows and columns of a projection that belong to an active set.
Projection partOf(const Projection& all, IS columns) {
  Projection part;
  if (!all) return part;
  check(MatCreateSubMatrix(all.matrix, columns, columns, MAT_INITIAL_MATRIX, part.matrix.out()));
  if (isSymmetric(all.matrix)) check(MatSetOption(part.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatCreateSubMatrix(all.reaction, ownRows(all.reaction), columns, MAT_INITIAL_MATRIX,
                           part.reaction.out()));
  return part;
}

}  // namespace

OpenProjections::OpenProjections(const elasticity::Bodies& bodies, const Contact& contact)
    : all_(projectAll(
          bodies, contact,
          {Mask(contact.interfaces.nodes.size(), 0), Mask(contact.interfaces.nodes.size(), 1)},
          nullptr)) {}

Projections OpenProjections::of(const Contact& contact, const ActiveSet& set) const {
  Projections part;
  part.transformation = transformationOf(contact, set);
  const OwnedIS columns = columnsOf(contact.mesh->comm, part.transformation, all_.transformation);
  part.stiffness = partOf(all_.stiffness, columns);
  part.mass = partOf(all_.mass, columns);
  part.damping = partOf(all_.damping, columns);
  part.gyroscopic = partOf(all_.gyroscopic, columns);
  part.rotationStiffness = partOf(all_.rotationStiffness, columns);
  return part;
}

CoupledSystem::CoupledSystem(const OpenProjections& open, const Contact& contact, ActiveSet set)
    : CoupledSystem(open.of(contact, set), set, countOpen(contact.mesh->comm, set.closed)) {}

CoupledSystem::CoupledSystem(const elasticity::Bodies& bodies, const Contact& contact,
                             ActiveSet set, Mat prestress)
    : CoupledSystem(projectAll(bodies, contact, set, prestress), set,
                    countOpen(contact.mesh->comm, set.closed)) {}

CoupledSystem::CoupledSystem(Projections projections, ActiveSet set, PetscInt openNodes)
    : AssociatedSystem(projections.stiffness.matrix.share(), projections.mass.matrix.share(),
                       "stiffness of the closed, frictionless contact"),
      projections_(std::move(projections)),
      activeSet_(std::move(set)),
      openNodes_(openNodes) {}

}  // namespace squeal::contact
