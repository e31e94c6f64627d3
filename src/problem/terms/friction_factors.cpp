// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <utility>

#include "algebra/linalg/rows.hpp"
#include "base/petsc/matrix.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/error.hpp"
#include "problem/terms/body_matrices.hpp"
#include "problem/terms/friction_work.hpp"
#include "problem/terms/terms.hpp"

namespace squeal::terms {
namespace {

/// Collective. Returns the numbers of the gap rows of these contact nodes, over all ranks.
OwnedIS gapRows(const contact::Contact& contact, const std::vector<unsigned char>& slides) {
  std::vector<PetscInt> rows;
  for (std::size_t i = 0; i < slides.size(); ++i)
    if (slides[i]) rows.push_back(contact.gapRow(contact.interfaces.nodes[i]));
  OwnedIS set;
  check(
      ISCreateGeneral(contact.mesh->comm, rows.size(), rows.data(), PETSC_COPY_VALUES, set.out()));
  return set;
}

/// Collective. Returns the numbers of the rows of J that Φ and B need for these nodes.
OwnedIS jumpRows(const contact::Contact& contact, const std::vector<unsigned char>& slides) {
  const PetscInt dimension = contact.mesh->dimension;
  std::vector<PetscInt> rows;
  for (std::size_t i = 0; i < slides.size(); ++i)
    if (slides[i] || contact.interfaces.gapBasis)  // E and B couple nodes of tri6 and quad8 faces
      for (PetscInt d = 0; d < dimension; ++d)
        rows.push_back(dimension * contact.interfaces.nodes[i].globalNode + d);
  OwnedIS set;
  check(
      ISCreateGeneral(contact.mesh->comm, rows.size(), rows.data(), PETSC_COPY_VALUES, set.out()));
  return set;
}

/// Collective. Returns the entries of a nodal matrix in these rows and columns, on all ranks.
linalg::DenseMatrix denseOf(Mat matrix, IS rows, IS columns) {
  OwnedMat part;
  check(MatCreateSubMatrix(matrix, rows, columns, MAT_INITIAL_MATRIX, part.out()));
  PetscInt first = 0, end = 0, count = 0;
  check(MatGetOwnershipRange(part, &first, &end));
  check(MatGetSize(part, nullptr, &count));
  linalg::DenseMatrix own(end - first, count);
  for (PetscInt i = first; i < end; ++i) {
    PetscInt entries = 0;
    const PetscInt* places = nullptr;
    const PetscScalar* values = nullptr;
    check(MatGetRow(part, i, &entries, &places, &values));
    for (PetscInt k = 0; k < entries; ++k) own(i - first, places[k]) = values[k];
    check(MatRestoreRow(part, i, &entries, &places, &values));
  }
  return linalg::gatheredRows(Concatenation(commOf(part), own.rows()), own);
}

/// Collective. Returns these rows of a matrix; `square` has the same columns.
OwnedMat rowsOf(Mat matrix, IS rows, Mat square) {
  OwnedMat part;
  check(MatCreateSubMatrix(matrix, rows, ownRows(square), MAT_INITIAL_MATRIX, part.out()));
  return part;
}

/// Collective. Returns N X T of each matrix X of the bodies, in these rows.
std::vector<pencil::Term> normalFactors(const contact::CoupledSystem& system, IS rows) {
  std::vector<pencil::Term> normal;
  for (const auto& role : bodyMatrices(system))
    if (role.projection)
      normal.push_back({.matrix = rowsOf(role.projection.reaction, rows, system.k0()),
                        .power = role.power,
                        .speedExponent = role.speedExponent,
                        .dampingExponent = role.dampingExponent});
  return normal;
}

}  // namespace

pencil::FrictionFactors frictionFactors(const contact::Contact& contact,
                                        const contact::CoupledSystem& system,
                                        const std::vector<unsigned char>& slides) {
  pencil::FrictionFactors factors;
  if (!contact.slipIsConstant()) {
    factors.missing = "the slip differs between points";
    return factors;
  }
  const OwnedIS rows = gapRows(contact, slides);
  const auto slip = contact.slip(1, nullptr);
  for (const int exponent : contact.frictionExponents())
    factors.slip.push_back(
        {.matrix = rowsOf(contact.slipRows(system.transformation(), slip, slides, exponent), rows,
                          system.k0()),
         .frictionExponent = exponent});
  factors.normal = normalFactors(system, rows);
  return factors;
}

pencil::JumpFactors jumpFactors(const contact::Contact& contact,
                                const contact::CoupledSystem& system,
                                const std::vector<unsigned char>& slides) {
  const OwnedIS rows = jumpRows(contact, slides);
  const auto times = [&](Mat nodal) {
    OwnedMat product;
    check(MatMatMult(nodal, system.transformation().trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                     product.out()));
    return rowsOf(product, rows, system.k0());
  };
  pencil::JumpFactors factors;
  factors.jumps = times(contact.sliding.jump);
  if (contact.sliding.convected) factors.convected = times(contact.sliding.convected);
  factors.normal = normalFactors(system, gapRows(contact, slides));
  return factors;
}

pencil::PointFactors pointFactors(const contact::Contact& contact, const steady::Solution& solution,
                                  const std::vector<unsigned char>& slides,
                                  const Settings& settings) {
  const OwnedIS gaps = gapRows(contact, slides), jumps = jumpRows(contact, slides);
  const FrictionState friction = frictionState(contact, solution, settings);
  auto response = denseOf(friction.response, jumps, jumps);
  constexpr double roundOff = 1e-10;
  PetscReal whole = 0;
  check(MatNorm(friction.response, NORM_FROBENIUS, &whole));
  if (whole - std::sqrt(linalg::squaredLength(response.entries())) > roundOff * whole)
    throw Error("friction damping acts on nodes of contact faces that have no gap");
  return {denseOf(contact.slipOfJumpsAt(solution.slip, solution.closed, solution.at.friction), gaps,
                  jumps),
          std::move(response)};
}

}  // namespace squeal::terms
