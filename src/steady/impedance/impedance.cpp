// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/impedance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "algebra/factor/schur.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/object.hpp"
#include "base/session/stages.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::impedance {

using linalg::Block;
using linalg::DenseMatrix;
using linalg::DenseView;

namespace {

/// The number of causes whose unknowns are in memory together.
constexpr PetscInt blockColumns = 64;

OwnedMat transposed(Mat matrix) {
  OwnedMat result;
  check(MatTranspose(matrix, MAT_INITIAL_MATRIX, result.out()));
  return result;
}

OwnedIS indices(MPI_Comm comm, const std::vector<PetscInt>& list) {
  OwnedIS set;
  check(ISCreateGeneral(comm, list.size(), list.data(), PETSC_COPY_VALUES, set.out()));
  return set;
}

/// Returns the rows of both, the second below the first.
DenseMatrix stacked(const DenseView& first, const DenseView& second) {
  DenseMatrix result(first.rows() + second.rows(), first.columns());
  for (PetscInt j = 0; j < first.columns(); ++j) {
    const auto rest = std::ranges::copy(first.column(j), result.column(j).begin()).out;
    std::ranges::copy(second.column(j), rest);
  }
  return result;
}

/// Collective. Returns a vector that borrows the entries of one column.
OwnedVec borrowedVector(MPI_Comm comm, const DenseView& column) {
  OwnedVec vector;
  check(
      VecCreateMPIWithArray(comm, 1, column.rows(), PETSC_DETERMINE, column.data(), vector.out()));
  return vector;
}

/// Returns A x + B y, with `rows` rows on this rank.
Block sumOfProducts(Mat a, const DenseView& x, Mat b, const DenseView& y, PetscInt rows) {
  Block sum(rows), second(rows);
  linalg::appendProduct(a, x, sum);
  linalg::appendProduct(b, y, second);
  linalg::addScaled(sum, 1, second);
  return sum;
}

/// The most unknowns of the contact that are condensed: 0.5 GB on rank 0, and as much on all.
constexpr PetscInt mostCondensed = 8000;
/// The largest difference of the Schur complement from responses by solves, relative to them.
constexpr double accurate = 1e-10;

/// Returns the matrix that selects the indices of this rank: `local` × indices, with a 1 in the row
/// of each index. MatCreateSubMatrix() requires ascending columns, which gaps followed by tangents
/// are not.
OwnedMat picks(MPI_Comm comm, PetscInt local, IS indices) {
  OwnedMat matrix;
  PetscInt count = 0, first = 0;
  const PetscInt* rows = nullptr;
  check(ISGetLocalSize(indices, &count));
  check(MatCreateAIJ(comm, local, count, PETSC_DETERMINE, PETSC_DETERMINE, 1, nullptr, 0, nullptr,
                     matrix.out()));
  check(MatGetOwnershipRangeColumn(matrix, &first, nullptr));
  check(ISGetIndices(indices, &rows));
  for (PetscInt k = 0; k < count; ++k)
    check(MatSetValue(matrix, rows[k], first + k, 1, INSERT_VALUES));
  check(ISRestoreIndices(indices, &rows));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

/// Returns A B.
OwnedMat productOf(Mat a, Mat b) {
  OwnedMat result;
  check(MatMatMult(a, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

/// Returns Aᵀ B. It processes only the rows of B in which A has entries.
OwnedMat transposedProductOf(Mat a, Mat b) {
  OwnedMat result;
  check(MatTransposeMatMult(a, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

OwnedMat transposedRowsOf(Mat matrix, IS rows) {
  PetscInt local = 0;
  check(MatGetLocalSize(matrix, &local, nullptr));
  return transposedProductOf(matrix, picks(commOf(matrix), local, rows));
}

}  // namespace

Impedance::Impedance(const contact::Contact& contact, const contact::Transformation& open,
                     Mat stiffness, Mat slipRows, const contact::CoupledSystem& closed)
    : contact_(contact), closed_(closed), work_(rightVector(closed.k0())) {
  auto [inner, free] = contact::compared(open, closed.transformation());
  PetscInt begin = 0;
  check(MatGetOwnershipRangeColumn(open.selection, &begin, nullptr));
  for (PetscInt& column : inner) column += begin;
  inner_ = indices(comm(), inner);
  std::vector<PetscInt> rows, columns = open.gapColumn;
  for (PetscInt i = 0; i < nodes(); ++i) {
    nodeOf_.push_back(i);
    rows.push_back(contact.gapRow(contact.interfaces.nodes[i]));
  }
  const PetscInt dimension = contact.mesh->dimension;
  for (PetscInt i = 0; i < nodes(); ++i) {
    const PetscInt tangents = dimension * contact.interfaces.nodes[i].node,
                   gap = tangents + dimension - 1;
    const auto rowOf = [&](PetscInt column) { return open.rows[column]; };
    auto column = std::ranges::lower_bound(free, tangents, {}, rowOf);
    for (; column != free.end() && rowOf(*column) < gap; ++column) {
      nodeOf_.push_back(i);
      columns.push_back(begin + *column);
    }
  }
  released_ = indices(comm(), columns);
  nodeRows_ = indices(comm(), rows);
  // Only the rows of K at the contact matter.
  const OwnedMat friction = transposedRowsOf(slipRows, nodeRows_);
  PetscInt unknowns = 0;
  check(MatGetLocalSize(open.trial, nullptr, &unknowns));
  const OwnedMat toInner = picks(comm(), unknowns, inner_),
                 toFree = picks(comm(), unknowns, released_);
  innerFriction_ = transposedProductOf(toInner, friction);
  forceFriction_ = transposedProductOf(toFree, friction);
  const OwnedMat trialInner = productOf(open.trial, toInner),
                 trialFree = productOf(open.trial, toFree);
  const OwnedMat freeForces = transposedProductOf(trialFree, stiffness);
  forceInner_ = productOf(freeForces, trialInner);
  forceReleased_ = productOf(freeForces, trialFree);
  innerReleased_ = transposed(forceInner_);
  const OwnedMat normal = transposedRowsOf(contact.sliding.reaction, nodeRows_),
                 normalForces = transposedProductOf(normal, stiffness);
  normalInner_ = productOf(normalForces, trialInner);
  normalReleased_ = productOf(normalForces, trialFree);
}

OwnedMat Impedance::directFriction(Mat slipRows) const {
  PetscInt unknowns = 0;
  check(MatGetLocalSize(slipRows, nullptr, &unknowns));
  return transposedProductOf(picks(comm(), unknowns, released_),
                             transposedRowsOf(slipRows, nodeRows_));
}

/// Returns K0⁻¹ of the columns.
Block Impedance::solved(const DenseView& forces) const {
  solves_ += forces.columns();
  return linalg::solved(closed_.solver(), forces);
}

/// Returns the response y to the causes t and w.
Block Impedance::innerOf(const DenseView& t, const DenseView& w) const {
  PetscInt local = 0;
  check(VecGetLocalSize(work_, &local));
  Block forces = sumOfProducts(innerFriction_, t, innerReleased_, w, local);
  for (double& force : forces.entries()) force = -force;
  return solved(forces);
}

DenseMatrix Impedance::responses(const DenseView& causes) const {
  const PetscInt n = nodes(), m = std::ssize(nodeOf_);
  DenseMatrix result(n + m);
  result.reserve(causes.columns());
  for (PetscInt begin = 0; begin < causes.columns(); begin += blockColumns) {
    const DenseView some =
        causes.columnRange(begin, std::min(begin + blockColumns, causes.columns()));
    const Block t = linalg::rowRange(some, 0, n), w = linalg::rowRange(some, n, n + m),
                y = innerOf(t, w);
    const Block normal = sumOfProducts(normalInner_, y, normalReleased_, w, n);
    Block force = sumOfProducts(forceInner_, y, forceReleased_, w, m), friction(m);
    linalg::appendProduct(forceFriction_, t, friction);
    linalg::addScaled(force, 1, friction);
    result.append(stacked(normal, force));
  }
  return result;
}

DenseMatrix Impedance::responsesToUnits(const std::vector<PetscInt>& released) const {
  const PetscInt n = nodes(), m = std::ssize(nodeOf_), count = std::ssize(released);
  const PetscInt all = mpi::sum(comm(), m), first = mpi::sumBefore(comm(), m);
  units_ += count;
  if (!isCondensed_ && !refused_ && units_ > after_.value_or(worthwhile(all)) &&
      all <= mostCondensed)
    condense();
  if (!isCondensed_) {
    DenseMatrix units(n + m, count);
    for (PetscInt j = 0; j < count; ++j)
      if (const PetscInt i = released[j] - first; i >= 0 && i < m) units(n + i, j) = 1;
    return responses(units);
  }
  DenseMatrix result(n + m, count);
  for (PetscInt j = 0; j < count; ++j) {
    const auto force = schur_.column(released[j]);
    std::copy_n(force.begin(), n, result.column(j).begin());
    std::ranges::copy(force, result.column(j).begin() + n);
  }
  return result;
}

/// Collective. Returns S_c of the matrix [K0 K_yw; K_wy K_ww], in which each rank has its y before
/// its w. Throws Error if the factorisation fails.
DenseMatrix Impedance::schurComplement() const {
  const std::array<Mat, 4> blocks{closed_.k0(), innerReleased_, forceInner_, forceReleased_};
  OwnedMat nested, stiffness;
  check(MatCreateNest(comm(), 2, nullptr, 2, nullptr, blocks.data(), nested.out()));
  // To MATSEQAIJ, PETSc 3.18 converts through the arrays of the blocks, which marks K0 as changed:
  // it would be factorised again.
  check(MatConvert(nested, MATMPIAIJ, MAT_INITIAL_MATRIX, stiffness.out()));
  PetscInt end = 0;
  check(MatGetOwnershipRange(stiffness, nullptr, &end));
  std::vector<PetscInt> own(nodeOf_.size());
  std::iota(own.begin(), own.end(), end - std::ssize(own));
  return factor::schurComplement(std::move(stiffness), own);
}

/// Collective. Computes S_c. It is refused if its factorisation fails, for example for lack of
/// memory, or if it differs from some of the responses that it replaces.
void Impedance::condense() const {
  Stage stage(comm(), "factor");
  DenseMatrix schur;
  try {
    schur = schurComplement();
  } catch (const Error& error) {
    refused_ = true;
    stage.finish("no condensation to the unknowns of the contact, solves instead: " +
                 std::string(error.what()));
    return;
  }
  const PetscInt size = schur.columns();
  const PetscInt count = std::ssize(nodeOf_), first = mpi::sumBefore(comm(), count);
  constexpr PetscInt samples = 8;
  DenseMatrix units(length(), samples);
  std::vector<PetscInt> chosen;
  for (PetscInt j = 0; j < samples; ++j) {
    chosen.push_back(j * (size - 1) / (samples - 1));
    if (const PetscInt i = chosen[j] - first; i >= 0 && i < count) units(nodes() + i, j) = 1;
  }
  const DenseMatrix exact = responses(units);
  std::array<double, 2> largest{};  // difference, response
  for (PetscInt j = 0; j < samples; ++j)
    for (PetscInt i = 0; i < length(); ++i) {
      const double entry = schur(i < nodes() ? i : i - nodes(), chosen[j]);
      largest[0] = std::max(largest[0], std::abs(exact(i, j) - entry));
      largest[1] = std::max(largest[1], std::abs(exact(i, j)));
    }
  mpi::reduce<double>(comm(), largest, MPI_MAX);
  refused_ = !(largest[0] <= accurate * largest[1]);
  stage.finish(formatted(
      "condensation to %" PetscInt_FMT " unknowns of the contact, checked on %d columns to %.0e%s",
      size, int(samples), largest[0] / largest[1], refused_ ? ": not used" : ""));
  isCondensed_ = !refused_;
  if (isCondensed_) schur_ = std::move(schur);
}

void Impedance::addUnknowns(const DenseView& causes, const std::vector<Vec>& x) const {
  const PetscInt n = nodes();
  const DenseMatrix t = linalg::rowRange(causes, 0, n), w = linalg::rowRange(causes, n, length());
  addInner(innerOf(t, w), x);
  for (std::size_t j = 0; j < x.size(); ++j) {
    const OwnedVec released = borrowedVector(comm(), w.columnRange(j, j + 1));
    check(VecISAXPY(x[j], released_, 1, released));
  }
}

DenseMatrix Impedance::relax(const std::vector<Vec>& residuals, const std::vector<Vec>& x) const {
  const PetscInt n = nodes(), m = length() - n;
  PetscInt local = 0;
  check(VecGetLocalSize(work_, &local));
  Block forces(local), given(m, std::ssize(residuals));
  for (std::size_t j = 0; j < residuals.size(); ++j) {
    check(VecISCopy(residuals[j], inner_, SCATTER_REVERSE, work_));
    check(VecScale(work_, -1));
    const ReadArray values(work_);
    forces.append(std::span(values.data(), values.size()));
    const OwnedVec rows = borrowedVector(comm(), given.columnRange(j, j + 1));
    check(VecISCopy(residuals[j], released_, SCATTER_REVERSE, rows));
  }
  const Block y = solved(forces);
  addInner(y, x);
  Block normal(n), force(m);
  linalg::appendProduct(normalInner_, y, normal);
  linalg::appendProduct(forceInner_, y, force);
  linalg::addScaled(force, 1, given);
  return stacked(normal, force);
}

void Impedance::addInner(const Block& y, const std::vector<Vec>& x) const {
  for (std::size_t j = 0; j < x.size(); ++j) {
    const OwnedVec inner = borrowedVector(comm(), y.columnRange(j, j + 1));
    check(VecISAXPY(x[j], inner_, 1, inner));
  }
}

}  // namespace squeal::impedance
