/// Snapshots over the sweep as a basis: proper orthogonal decomposition.
#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>

#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"
#include "reduction/reduced.hpp"

namespace squeal::reduction {
namespace {

/// Returns orthonormal vectors that hold the columns but for parts of length `small`.
linalg::DenseMatrix principalDirections(linalg::DenseMatrix columns, double small) {
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

/// Turns the basis to the principal directions of all vectors found so far.
void ReducedProblem::compress() {
  constexpr double left = 1e-9;  // of a unit vector; what is lost, corrections bring back
  linalg::DenseMatrix vectors(basis_.size());
  std::vector<double> column(basis_.size());
  for (const auto& pairs : solved_)
    for (const auto& pair : pairs)
      for (const bool imaginary : {false, true}) {
        for (std::size_t i = 0; i < column.size(); ++i) {
          const Complex entry = i < pair.q.size() ? pair.q[i] : 0;
          column[i] = imaginary ? entry.imag() : entry.real();
        }
        vectors.append(std::span<const double>(column));
      }
  if (vectors.empty()) return;
  const linalg::DenseMatrix directions = principalDirections(vectors, left);
  basis_.combine(directions);
  terms_.combine(directions);
  highestMode_ = 0;  // the modes are no longer in the basis
  for (auto& pairs : solved_)
    for (auto& pair : pairs) {
      pair.q = turned(directions, pair.q);
      pair.left = turned(directions, pair.left);
    }
}

}  // namespace squeal::reduction
