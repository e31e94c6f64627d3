// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/pod.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>

#include "algebra/linalg/lapack.hpp"
#include "base/petsc/check.hpp"

namespace squeal::reduction {
namespace {

/// Returns orthonormal vectors that span the columns, except for components of length `small`.
linalg::DenseMatrix leadingDirections(linalg::DenseMatrix columns, double small) {
  PetscBLASInt m = columns.rows(), n = columns.columns(), few = std::min(m, n), one = 1, info = 0;
  std::vector<double> sizes(few);
  linalg::DenseMatrix left(m, few);
  linalg::callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKgesvd_("S", "N", &m, &n, columns.data(), &m, sizes.data(), left.data(), &m, nullptr, &one,
                 work, &length, &info);
  });
  if (info != 0)
    throw Error("LAPACK dgesvd failed on the vectors of -flutter_basis pod (info " +
                std::to_string(info) + ")");
  left.resizeColumns(std::ranges::count_if(sizes, [&](double size) { return size > small; }));
  return left;
}

/// Returns the coordinates of the same vector in a basis V · directions.
std::vector<Complex> turned(const linalg::DenseMatrix& directions, const std::vector<Complex>& q) {
  std::vector<Complex> result(directions.columns());
  for (std::size_t j = 0; j < result.size(); ++j)
    for (std::size_t i = 0; i < q.size(); ++i) result[j] += directions(i, j) * q[i];
  return result;
}

/// Returns orthonormal combinations of `size` basis vectors, size × count, that span the real and
/// imaginary parts of the right vectors of all these pairs. Missing entries of a vector are zero.
linalg::DenseMatrix principalDirections(const std::vector<std::vector<linalg::DensePair>>& solved,
                                        PetscInt size) {
  constexpr double left = 1e-9;  // of a unit vector
  linalg::DenseMatrix vectors(size);
  std::vector<double> column(size);
  for (const auto& pairs : solved)
    for (const auto& pair : pairs)
      for (const bool imaginary : {false, true}) {
        for (std::size_t i = 0; i < column.size(); ++i) {
          const Complex entry = i < pair.q.size() ? pair.q[i] : 0;
          column[i] = imaginary ? entry.imag() : entry.real();
        }
        vectors.append(std::span<const double>(column));
      }
  return vectors.empty() ? vectors : leadingDirections(vectors, left);
}

}  // namespace

void Pod::take(std::vector<PointState>& states) {
  for (auto& state : states) {
    const PetscInt own = state.set->space.own();
    auto& band = state.solution.spectrum.band;
    for (auto& pair : band)
      for (auto* vector : {&pair.q, &pair.left})
        vector->erase(vector->begin(), vector->begin() + own);
    solved_.push_back(std::move(band));
  }
}

bool Pod::compress(ProjectedBasis& basis) {
  const linalg::DenseMatrix directions =
      principalDirections(solved_, basis.basis().size() - basis.basis().boundarySize());
  if (directions.empty()) return false;
  basis.combine(directions);
  // A left vector may have components outside the new basis; they are lost.
  for (auto& pairs : solved_)
    for (auto& pair : pairs)
      for (auto* vector : {&pair.q, &pair.left}) *vector = turned(directions, *vector);
  return true;
}

}  // namespace squeal::reduction
