// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrices/associated.hpp"

#include <algorithm>

#include "algebra/factor/symmetric_solver.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/pencil.hpp"

namespace squeal::matrices {
namespace {

constexpr double symmetric = 1e-10;  // printed digits of exports

bool isAssociated(const pencil::Term& term, int power) {
  return term.power == power && !term.containsFriction() && term.speedExponent == 0 &&
         term.dampingExponent == 0;
}

std::string namesOf(const std::vector<NamedTerm>& terms, int power) {
  std::vector<std::string> names;
  for (const auto& [name, term] : terms)
    if (isAssociated(term, power)) names.push_back("'" + name + "'");
  return joined(names);
}

/// Collective. Returns the sum of the terms that isAssociated() accepts, with their factors. Throws
/// Error if there is none.
OwnedMat sum(const std::vector<NamedTerm>& terms, int power) {
  OwnedMat total;
  for (const auto& [name, term] : terms) {
    if (!isAssociated(term, power)) continue;
    if (!total) {
      check(MatDuplicate(term.matrix, MAT_COPY_VALUES, total.out()));
      check(MatScale(total, term.factor));
    } else {
      check(MatAXPY(total, term.factor, term.matrix, DIFFERENT_NONZERO_PATTERN));
    }
  }
  if (!total)
    throw Error(
        formatted("options -matrices_<name>_role: there is no %s matrix without exponents of "
                  "friction, speed and damping, and without -matrices_<name>_of_friction",
                  power == 2 ? "mass" : "stiffness"));
  return total;
}

/// Collective. Returns a text with the number of rows without a positive entry on the diagonal, and
/// the first of them; it is empty if there are none.
std::string badDiagonal(Mat matrix) {
  OwnedVec diagonal;
  PetscInt first = 0, end = 0, size = 0;
  check(MatCreateVecs(matrix, diagonal.out(), nullptr));
  check(MatGetDiagonal(matrix, diagonal));
  check(VecGetOwnershipRange(diagonal, &first, &end));
  check(VecGetSize(diagonal, &size));
  const ReadArray values(diagonal);
  PetscInt count = 0, lowest = size;
  for (PetscInt i = first; i < end; ++i)
    if (!(values[i - first] > 0)) ++count, lowest = std::min(lowest, i);
  count = mpi::sum(commOf(matrix), count);
  lowest = mpi::min(commOf(matrix), lowest);
  if (count == 0) return "";
  return formatted(" (diagonal entries that are not positive: %" PetscInt_FMT
                   ", the first in row %" PetscInt_FMT ")",
                   count, lowest + 1);
}

/// Collective. Throws Error if the matrix is not positive definite, except for `free` eigenvalues
/// that are zero because so many rows are. In a large model, cancellation
/// leaves a pivot of 1e-13 of the scaled matrix instead of zero. The rows are scaled, so stiff
/// springs do not cause such small pivots.
void requirePositiveDefinite(Mat matrix, const std::string& what, const std::string& advice,
                             PetscInt free = 0) {
  PetscReal norm = 0;
  check(MatNorm(matrix, NORM_FROBENIUS, &norm));
  if (norm == 0) throw Error(what + " is zero");
  const std::string bad = badDiagonal(matrix);
  const auto [negative, zero] = factor::inertia(matrix, 1e-13);
  if (negative == 0 && zero == free) return;
  throw Error(formatted("%s is not positive definite: %" PetscInt_FMT " negative and %" PetscInt_FMT
                        " zero eigenvalues%s; %s",
                        what.c_str(), negative, zero, bad.c_str(), advice.c_str()));
}

}  // namespace

OwnedMat symmetrised(Mat matrix) {
  OwnedMat part;
  check(MatTranspose(matrix, MAT_INITIAL_MATRIX, part.out()));
  check(MatAXPY(part, 1, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatScale(part, 0.5));
  check(MatSetOption(part, MAT_SYMMETRIC, PETSC_TRUE));
  return part;
}

SymmetricPart symmetricPart(const std::vector<NamedTerm>& terms) {
  OwnedMat stiffness = sum(terms, 0), mass = sum(terms, 2);
  const std::string massName = "the mass " + namesOf(terms, 2),
                    stiffnessName = "the stiffness " + namesOf(terms, 0);
  if (const double departure = asymmetry(mass); departure > symmetric)
    throw Error(
        formatted("%s is not symmetric: ‖M − Mᵀ‖ is %.1e of ‖M‖; friction of inertia forces needs "
                  "an exponent of friction, or -matrices_<name>_of_friction",
                  massName.c_str(), departure));
  double departure = asymmetry(stiffness);
  if (departure <= symmetric) departure = 0;
  mass = symmetrised(mass);
  stiffness = symmetrised(stiffness);
  const PetscInt massless = factor::zeroRows(mass);
  requirePositiveDefinite(
      mass, massName, "an unknown without mass must have a row and a column of zeros", massless);
  requirePositiveDefinite(
      stiffness, stiffnessName + (departure > 0 ? ", by its symmetric part," : ""),
      departure > 0 ? "friction in it may be the reason: mark its matrix by "
                      "-matrices_<name>_of_friction or an exponent of friction, or judge "
                      "a list of eigenvalues by -referee_list; if a body is "
                      "under-constrained, support it by weak springs"
                    : "is a body under-constrained? If so, support it by weak springs");
  return {factor::AssociatedSystem(std::move(stiffness), std::move(mass),
                                   "associated symmetric stiffness"),
          departure, massless};
}

}  // namespace squeal::matrices
