// SPDX-License-Identifier: BSD-2-Clause
#include "base/petsc/matrix.hpp"
#include "problem/terms/body_matrices.hpp"
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

/// Collective. Returns these rows of a matrix; `square` has the same columns.
OwnedMat rowsOf(Mat matrix, IS rows, Mat square) {
  OwnedMat part;
  check(MatCreateSubMatrix(matrix, rows, ownRows(square), MAT_INITIAL_MATRIX, part.out()));
  return part;
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
  for (const auto& role : bodyMatrices(system))
    if (role.projection)
      factors.normal.push_back({.matrix = rowsOf(role.projection.reaction, rows, system.k0()),
                                .power = role.power,
                                .speedExponent = role.speedExponent,
                                .dampingExponent = role.dampingExponent});
  return factors;
}

}  // namespace squeal::terms
