/// Snapshots over the sweep as a basis: proper orthogonal decomposition.
#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>

#include "linalg/quadratic.hpp"
#include "reduction/reduced.hpp"

namespace squeal::reduction {
namespace {

/// Orthonormal vectors that hold the columns (m high) but for parts of length `small`.
linalg::DenseMatrix principalDirections(linalg::DenseMatrix columns, int rows, double small) {
  PetscBLASInt m = rows, n = static_cast<PetscBLASInt>(columns.size()) / m, few = std::min(m, n),
               one = 1, query = -1, info = 0;
  std::vector<double> sizes(few), left(static_cast<std::size_t>(m * few)), state(1);
  const auto call = [&](PetscBLASInt length) {
    LAPACKgesvd_("S", "N", &m, &n, columns.data(), &m, sizes.data(), left.data(), &m, nullptr, &one,
                 state.data(), &length, &info);
  };
  call(query);
  state.resize(state[0]);
  call(static_cast<PetscBLASInt>(state.size()));
  if (info != 0)
    throw Error("LAPACK dgesvd failed on the vectors of -reduction_basis pod (info " +
                std::to_string(info) + ")");
  const auto kept =
      std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > small; });
  left.resize(m * kept);
  return left;
}

/// Coordinates of the same vector in a basis V · directions.
std::vector<std::complex<double>> turned(const linalg::DenseMatrix& directions, std::size_t m,
                                         const std::vector<std::complex<double>>& q) {
  std::vector<std::complex<double>> result(directions.size() / m);
  for (std::size_t j = 0; j < result.size(); ++j)
    for (std::size_t i = 0; i < q.size(); ++i) result[j] += directions[j * m + i] * q[i];
  return result;
}

}  // namespace

/// Turns the basis to the principal directions of all vectors found so far.
void ReducedProblem::compress() {
  constexpr double left = 1e-9;  // of a unit vector; what is lost, corrections bring back
  const PetscInt old = basis_.size();
  const auto m = static_cast<std::size_t>(old);
  linalg::DenseMatrix vectors;
  for (const auto& pairs : solved_)
    for (const auto& pair : pairs)
      for (const bool imaginary : {false, true}) {
        for (std::size_t i = 0; i < m; ++i) {
          const std::complex<double> entry = i < pair.q.size() ? pair.q[i] : 0;
          vectors.push_back(imaginary ? entry.imag() : entry.real());
        }
      }
  if (vectors.empty()) return;
  const linalg::DenseMatrix directions = principalDirections(vectors, static_cast<int>(old), left);
  const auto count = static_cast<PetscInt>(directions.size() / m);
  basis_.combine(directions, count);
  terms_.combine(directions);
  highestMode_ = 0;  // the modes are no longer in the basis
  for (auto& pairs : solved_)
    for (auto& pair : pairs) {
      pair.q = turned(directions, m, pair.q);
      pair.left = turned(directions, m, pair.left);
    }
}

}  // namespace squeal::reduction
