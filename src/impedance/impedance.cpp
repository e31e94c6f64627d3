#include "impedance/impedance.hpp"

#include <algorithm>
#include <span>

#include "petsc/arrays.hpp"

namespace squeal::impedance {

using linalg::Block;
using linalg::DenseMatrix;
using linalg::DenseView;

namespace {

/// The number of causes whose unknowns are held at once.
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

ContactVector joined(std::span<const double> first, std::span<const double> second) {
  ContactVector result(first.begin(), first.end());
  result.insert(result.end(), second.begin(), second.end());
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

/// Returns the matrix that picks the indices of this rank: `local` × indices, with a 1 in the row
/// of each index.
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

/// Returns a part of a matrix with few rows. MatCreateSubMatrix() asks for ascending columns, which
/// gaps and tangents in a row are not.
OwnedMat part(Mat matrix, IS rows, IS columns) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix));
  PetscInt localRows = 0, localColumns = 0;
  check(MatGetLocalSize(matrix, &localRows, &localColumns));
  const OwnedMat left = picks(comm, localRows, rows), right = picks(comm, localColumns, columns);
  OwnedMat thin, result;
  check(MatTransposeMatMult(left, matrix, MAT_INITIAL_MATRIX, PETSC_DEFAULT, thin.out()));
  check(MatMatMult(thin, right, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

}  // namespace

Impedance::Impedance(const contact::Contact& contact, const contact::Transformation& open,
                     const contact::Projection& stiffness, Mat slipRows,
                     const contact::CoupledSystem& closed)
    : contact_(contact), closed_(closed), work_(rightVector(closed.k0())) {
  auto [inner, free] = contact::compared(open, closed.transformation());
  PetscInt begin = 0;
  check(MatGetOwnershipRangeColumn(open.selection, &begin, nullptr));
  for (PetscInt& column : inner) column += begin;
  inner_ = indices(comm(), inner);
  std::vector<PetscInt> rows, columns = open.gapColumn;
  for (PetscInt i = 0; i < nodes(); ++i) {
    nodeOf_.push_back(i);
    rows.push_back(contact.gapRow(contact.nodes[i]));
  }
  const PetscInt dimension = contact.mesh->dimension;
  for (PetscInt i = 0; i < nodes(); ++i) {
    const PetscInt tangents = dimension * contact.nodes[i].node, gap = tangents + dimension - 1;
    const auto rowOf = [&](PetscInt column) { return open.rows[column]; };
    auto column = std::ranges::lower_bound(free, tangents, {}, rowOf);
    for (; column != free.end() && rowOf(*column) < gap; ++column) {
      nodeOf_.push_back(i);
      columns.push_back(begin + *column);
    }
  }
  released_ = indices(comm(), columns);
  nodeRows_ = indices(comm(), rows);
  innerFriction_ = transposed(part(slipRows, nodeRows_, inner_));
  forceFriction_ = directFriction(slipRows);
  forceInner_ = part(stiffness.matrix, released_, inner_);
  innerReleased_ = transposed(forceInner_);
  forceReleased_ = part(stiffness.matrix, released_, released_);
  normalInner_ = part(stiffness.reaction, nodeRows_, inner_);
  normalReleased_ = part(stiffness.reaction, nodeRows_, released_);
}

OwnedMat Impedance::directFriction(Mat slipRows) const {
  return transposed(part(slipRows, nodeRows_, released_));
}

/// Returns K0⁻¹ of the columns.
Block Impedance::solved(const DenseView& forces) const {
  solves_ += forces.columns();
  return linalg::solved(closed_.solver(), forces);
}

/// Returns y of the causes t and w.
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
    for (PetscInt j = 0; j < some.columns(); ++j)
      result.append(joined(normal.column(j), force.column(j)));
  }
  return result;
}

void Impedance::addUnknowns(const ContactVector& causes, Vec x) const {
  const PetscInt n = nodes();
  const DenseView t(causes.data(), n, 1), w(causes.data() + n, length() - n, 1);
  addInner(innerOf(t, w), x);
  const OwnedVec released = borrowedVector(comm(), w);
  check(VecISAXPY(x, released_, 1, released));
}

ContactVector Impedance::relax(Vec residual, Vec x) const {
  const PetscInt n = nodes();
  check(VecISCopy(residual, inner_, SCATTER_REVERSE, work_));
  check(VecScale(work_, -1));
  const ReadArray forces(work_);
  const Block y = solved(DenseView(forces.data(), forces.size(), 1));
  addInner(y, x);
  Block normal(n), force(length() - n), given(length() - n, 1);
  linalg::appendProduct(normalInner_, y, normal);
  linalg::appendProduct(forceInner_, y, force);
  const OwnedVec rows = borrowedVector(comm(), given);
  check(VecISCopy(residual, released_, SCATTER_REVERSE, rows));
  linalg::addScaled(force, 1, given);
  return joined(normal.column(0), force.column(0));
}

void Impedance::addInner(const Block& y, Vec x) const {
  const OwnedVec inner = borrowedVector(comm(), y);
  check(VecISAXPY(x, inner_, 1, inner));
}

}  // namespace squeal::impedance
