// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/factor/schur.hpp"

#include "algebra/factor/symmetric_solver.hpp"
#include "base/petsc/object.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::factor {
namespace {

/// Collective. Sends to each rank its rows of a symmetric matrix on rank 0, of which the lower
/// triangle is given by rows. Returns them, own rows × size.
linalg::DenseMatrix distributed(MPI_Comm comm, const std::vector<double>& lower,
                                const Concatenation& ranks, PetscInt own) {
  const std::size_t size = ranks.size();
  std::vector<double> column(size), part(own);
  std::vector<int> counts(mpi::size(comm)), begins(counts.size(), 0);
  const int mine = own;
  check(MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm));
  for (std::size_t r = 1; r < begins.size(); ++r) begins[r] = begins[r - 1] + counts[r - 1];
  linalg::DenseMatrix rows(own, size);
  for (std::size_t j = 0; j < size; ++j) {
    if (!lower.empty())
      for (std::size_t i = 0; i < size; ++i)
        column[i] = i >= j ? lower[i * size + j] : lower[j * size + i];
    check(MPI_Scatterv(column.data(), counts.data(), begins.data(), MPI_DOUBLE,
                       rows.column(j).data(), mine, MPI_DOUBLE, 0, comm));
  }
  return rows;
}

}  // namespace

linalg::DenseMatrix schurComplement(OwnedMat matrix, const std::vector<PetscInt>& own) {
  const MPI_Comm comm = commOf(matrix);
  const Concatenation ranks(comm, own.size());
  const auto all = ranks.gathered(own);
  MumpsFactor factor(comm, solverPrefix);
  factor.keep(mpi::rank(comm) == 0 ? all : std::vector<PetscInt>{});
  factor.analyse(matrix);
  matrix = {};
  if (const std::string why = factor.factorise(); !why.empty())
    throw Error("the condensation of the stiffness to the contact: " + why);
  return distributed(comm, factor.schurComplement(), ranks, own.size());
}

}  // namespace squeal::factor
