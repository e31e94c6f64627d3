// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrices/matrices.hpp"

#include "base/system/text.hpp"
#include "eigen/pencil/pencil.hpp"
#include "problem/matrices/read.hpp"

namespace squeal::matrices {
namespace {

NamedTerm readTerm(MPI_Comm comm, const std::string& name, const MatrixSettings& settings) {
  OwnedMat matrix;
  try {
    matrix = read(comm, settings.file, settings.dataset);
  } catch (const Error& error) {
    throw Error("option " + fileOptionOf(name) + ": " + error.what());
  }
  pencil::Term term{.matrix = std::move(matrix),
                    .power = settings.power,
                    .frictionExponent = settings.frictionExponent,
                    .factor = settings.factor,
                    .speedExponent = settings.speedExponent,
                    .dampingExponent = settings.dampingExponent,
                    .ofFriction = settings.ofFriction};
  // To round-off: the projection of a symmetric matrix costs half as much.
  if (asymmetry(term.matrix) < 1e-15) check(MatSetOption(term.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return {name, std::move(term)};
}

void requireEqualSizes(const std::vector<NamedTerm>& terms) {
  PetscInt wanted = 0, size = 0;
  check(MatGetSize(terms.at(0).term.matrix, &wanted, nullptr));
  for (const auto& [name, term] : terms) {
    check(MatGetSize(term.matrix, &size, nullptr));
    if (size != wanted)
      throw Error(formatted("option %s: %" PetscInt_FMT " rows, but matrix '%s' has %" PetscInt_FMT,
                            fileOptionOf(name).c_str(), size, terms[0].name.c_str(), wanted));
  }
}

}  // namespace

std::vector<NamedTerm> readTerms(MPI_Comm comm, const Settings& settings) {
  std::vector<NamedTerm> terms;
  for (const auto& [name, matrix] : settings.files) terms.push_back(readTerm(comm, name, matrix));
  requireEqualSizes(terms);
  return terms;
}

double asymmetry(Mat matrix) {
  OwnedMat difference;
  PetscReal size = 0, departure = 0;
  check(MatNorm(matrix, NORM_FROBENIUS, &size));
  if (size == 0) return 0;
  check(MatTranspose(matrix, MAT_INITIAL_MATRIX, difference.out()));
  check(MatAXPY(difference, -1, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatNorm(difference, NORM_FROBENIUS, &departure));
  return departure / size;
}

}  // namespace squeal::matrices
