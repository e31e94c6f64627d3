// SPDX-License-Identifier: BSD-2-Clause
#include "steady/uniqueness/compliance.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

#include "algebra/factor/symmetric_solver.hpp"
#include "algebra/linalg/block.hpp"
#include "base/options/options.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::uniqueness {
namespace {

const SolverPrefix solverPrefix("steady", "steady_uniqueness_",
                                "options of PETSc's KSP and PC (stiffness with open contact, MUMPS "
                                "LDLt) and of SLEPc's EPS for "
                                "the uniqueness check: ksp_*, pc_*, eps_*, …");

/// The number of columns of K_o⁻¹ in memory together.
constexpr PetscInt blockColumns = 64;

}  // namespace

linalg::DenseMatrix Compliance::at(double friction) const {
  linalg::DenseMatrix a = a0;
  linalg::addScaled(a, friction, a1);
  return a;
}

OpenContact::OpenContact(const contact::Contact& contact, Mat stiffness,
                         const std::vector<contact::Slip>& slip)
    : contact_(contact),
      size_(contact.interfaces.totalNodes),
      ownedSize_(contact.interfaces.nodes.size()) {
  const contact::Mask all(contact.interfaces.nodes.size(), 1);
  transformation_ = contact.transformation(contact::ActiveSet::open(all.size()));
  first_ = mpi::sumBefore(contact.mesh->comm, ownedSize_);

  check(MatPtAP(stiffness, transformation_.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                stiffness_.out()));
  check(MatSetOption(stiffness_, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatCreateAIJ(contact.mesh->comm, transformation_.ownedColumns, ownedSize_, PETSC_DETERMINE,
                     PETSC_DETERMINE, 1, nullptr, 0, nullptr, gaps_.out()));
  for (PetscInt i = 0; i < ownedSize_; ++i)
    check(MatSetValue(gaps_, transformation_.gapColumn[i], first_ + i, 1, INSERT_VALUES));
  interfaces::assembled(gaps_);
  // The slip rows are in the rows of the gaps, which the product B e selects.
  OwnedMat gapRows;
  check(MatMatMult(transformation_.selection, gaps_, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   gapRows.out()));
  const auto columnsOf = [&](int exponent, OwnedMat& columns) {
    const OwnedMat rows = contact.slipRows(transformation_, slip, all, exponent);
    check(MatTransposeMatMult(rows, gapRows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, columns.out()));
  };
  columnsOf(1, friction_);
  const auto exponents = contact.frictionExponents();
  if (std::count(exponents.begin(), exponents.end(), 0)) columnsOf(0, fixedFriction_);

  solver_ = factor::directSolver(stiffness_, solverPrefix);
  if (auto* factor = factor::mumpsFactor(solver_)) factor->enableInertia();
  factorised_ = factor::factorise(solver_).empty();
  rhs_ = block(2), solution_ = block(2);
  check(MatCreateVecs(gaps_, part_.out(), single_.out()));
  check(VecDuplicate(single_, answer_.out()));
}

bool OpenContact::positiveDefinite() const {
  const auto* factor = factor::mumpsFactor(solver_);
  return !factor || factor->inertia().negative == 0;
}

OwnedMat OpenContact::block(PetscInt columns) const {
  OwnedMat matrix;
  check(MatCreateDense(comm(), transformation_.ownedColumns, PETSC_DECIDE, transformation_.columns,
                       columns, nullptr, matrix.out()));
  check(MatZeroEntries(matrix));
  interfaces::assembled(matrix);
  return matrix;
}

Compliance OpenContact::dense() const {
  Compliance compliance{linalg::DenseMatrix(size_, size_), linalg::DenseMatrix(size_, size_)};
  PetscInt firstRow = 0;
  check(MatGetOwnershipRange(stiffness_, &firstRow, nullptr));
  for (PetscInt begin = 0; begin < size_; begin += blockColumns) {
    const PetscInt width = std::min(blockColumns, size_ - begin);
    linalg::Block unit(transformation_.ownedColumns, width);
    for (PetscInt i = 0; i < ownedSize_; ++i)
      if (const PetscInt column = first_ + i - begin; column >= 0 && column < width)
        unit(transformation_.gapColumn[i] - firstRow, column) = 1;
    const linalg::Block solution = linalg::solved(solver_, unit);
    const OwnedMat x = linalg::borrowed(comm(), transformation_.columns, solution);
    for (PetscInt column = 0; column < width; ++column) {
      const PetscInt j = begin + column;
      // Since K_o is symmetric, column j of A0 is eᵀ x, and row j of A1 is −xᵀ U.
      for (Mat side : {gaps_.get(), friction_.get(), fixedFriction_.get()}) {
        if (!side) continue;
        Vec xj = nullptr;
        check(MatDenseGetColumnVecRead(x, column, &xj));
        check(MatMultTranspose(side, xj, part_));
        check(MatDenseRestoreColumnVecRead(x, column, &xj));
        const ReadArray entries(part_);
        for (PetscInt i = 0; i < ownedSize_; ++i)
          if (side == gaps_)
            compliance.a0(first_ + i, j) += entries[i];
          else
            (side == friction_ ? compliance.a1 : compliance.a0)(j, first_ + i) -= entries[i];
      }
    }
  }
  // Every entry has one or two nonzero parts, so the sums are equal on all ranks.
  for (auto* a : {&compliance.a0, &compliance.a1}) mpi::reduce(comm(), a->entries(), MPI_SUM);
  return compliance;
}

void OpenContact::multiplyA0(Vec v, Vec product) const {
  check(MatMult(gaps_, v, single_));
  check(KSPSolve(solver_, single_, answer_));
  check(MatMultTranspose(gaps_, answer_, product));
}

void OpenContact::multiplySymmetricA1(Vec v, Vec product) const {
  const Mat sides[] = {gaps_, friction_};
  Vec column = nullptr;
  for (PetscInt j = 0; j < 2; ++j) {
    check(MatDenseGetColumnVecWrite(rhs_, j, &column));
    check(MatMult(sides[j], v, column));
    check(MatDenseRestoreColumnVecWrite(rhs_, j, &column));
  }
  check(KSPMatSolve(solver_, rhs_, solution_));
  //   A1ᵀ v = −Uᵀ y,   A1 v = −eᵀ z,   y = K_o⁻¹ e v,   z = K_o⁻¹ U v
  check(MatDenseGetColumnVecRead(solution_, 0, &column));
  check(MatMultTranspose(friction_, column, product));
  check(MatDenseRestoreColumnVecRead(solution_, 0, &column));
  check(MatDenseGetColumnVecRead(solution_, 1, &column));
  check(MatMultTranspose(gaps_, column, part_));
  check(MatDenseRestoreColumnVecRead(solution_, 1, &column));
  check(VecAXPBY(product, -0.5, -0.5, part_));
}

void OpenContact::close() {
  if (closedSolver_) return;
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRange(stiffness_, &begin, &end));
  OwnedIS gaps, others;
  check(ISCreateGeneral(comm(), ownedSize_, transformation_.gapColumn.data(), PETSC_COPY_VALUES,
                        gaps.out()));
  std::vector<PetscInt> rest(end - begin);
  std::iota(rest.begin(), rest.end(), begin);
  const std::set<PetscInt> isGap(transformation_.gapColumn.begin(),
                                 transformation_.gapColumn.end());
  std::erase_if(rest, [&](PetscInt column) { return isGap.count(column) > 0; });
  check(ISCreateGeneral(comm(), rest.size(), rest.data(), PETSC_COPY_VALUES, others.out()));
  check(MatCreateSubMatrix(stiffness_, others, others, MAT_INITIAL_MATRIX, closedStiffness_.out()));
  check(MatCreateSubMatrix(stiffness_, others, gaps, MAT_INITIAL_MATRIX, coupling_.out()));
  check(MatCreateSubMatrix(stiffness_, gaps, gaps, MAT_INITIAL_MATRIX, gapStiffness_.out()));
  check(MatSetOption(closedStiffness_, MAT_SYMMETRIC, PETSC_TRUE));
  closedSolver_ = factor::directSolver(closedStiffness_, solverPrefix);
  if (const std::string why = factor::factorise(closedSolver_); !why.empty())
    throw Error("the stiffness matrix of the closed contact cannot be factorised: " + why);
  check(MatCreateVecs(closedStiffness_, inner_.out(), innerAnswer_.out()));
}

void OpenContact::solveA0(Vec v, Vec solution) {
  close();
  check(MatMult(coupling_, v, inner_));
  check(KSPSolve(closedSolver_, inner_, innerAnswer_));
  check(MatMultTranspose(coupling_, innerAnswer_, part_));
  check(MatMult(gapStiffness_, v, solution));
  check(VecAXPY(solution, -1, part_));
}

void rejectUnusedUniquenessOptions(bool dense) {
  solverPrefix.rejectUnused(dense ? std::vector<std::string>{"eps_", "st_"}
                                  : std::vector<std::string>{});
}

}  // namespace squeal::uniqueness
