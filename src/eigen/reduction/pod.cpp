#include "eigen/reduction/pod.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>

#include "algebra/linalg/lapack.hpp"
#include "base/petsc/check.hpp"

namespace squeal::reduction {
namespace {

/// Returns orthonormal vectors that hold the columns but for parts of length `small`.
linalg::DenseMatrix leadingDirections(linalg::DenseMatrix columns, double small) {
  PetscBLASInt m = columns.rows(), n = columns.columns(), few = std::min(m, n), one = 1, info = 0;
  std::vector<double> sizes(few);
  linalg::DenseMatrix left(m, few);
  linalg::callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKgesvd_("S", "N", &m, &n, columns.data(), &m, sizes.data(), left.data(), &m, nullptr, &one,
                 work, &length, &info);
  });
  if (info != 0)
    throw Error("LAPACK dgesvd failed on the vectors of -reduction_basis pod (info " +
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

}  // namespace

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

void turn(const linalg::DenseMatrix& directions, linalg::DensePair& pair) {
  pair.q = turned(directions, pair.q);
  pair.left = turned(directions, pair.left);
}

}  // namespace squeal::reduction
