// SPDX-License-Identifier: BSD-2-Clause
// Products of a sparse matrix and a block of columns. PETSc's MatMatMult reads the matrix again for
// every four columns, and takes their entries from four places. Here the columns are stored by rows
// first, 32 at a time, so that an entry of the matrix meets 32 neighbouring numbers.
#include <petscsf.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "base/petsc/log_events.hpp"
#include "base/petsc/object.hpp"

namespace squeal::linalg {
namespace {

/// Number of columns that are stored together, the width of a tile, and its unit.
constexpr PetscInt widest = 32, unit = 8;

/// The rows of a sequential AIJ matrix, borrowed from construction to destruction.
class SparseRows {
 public:
  explicit SparseRows(Mat matrix) : matrix_(matrix) {
    PetscBool done = PETSC_FALSE;
    check(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &rows_, &begin_, &column_, &done));
    ensure(done == PETSC_TRUE, "an AIJ matrix gives its rows");
    check(MatSeqAIJGetArrayRead(matrix, &entry_));
  }
  ~SparseRows() {
    PetscBool done = PETSC_FALSE;
    MatSeqAIJRestoreArrayRead(matrix_, &entry_);
    MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &rows_, &begin_, &column_, &done);
  }
  SparseRows(const SparseRows&) = delete;
  SparseRows& operator=(const SparseRows&) = delete;

  PetscInt size() const { return rows_; }
  PetscInt entries() const { return rows_ > 0 ? begin_[rows_] : 0; }

  /// Adds A X to Y. Both are stored by rows of `width` numbers.
  template <int width>
  [[gnu::always_inline]] void addTo(double* y, const double* x) const {
    for (PetscInt i = 0; i < rows_; ++i, y += width) {
      double sum[width];
      for (int c = 0; c < width; ++c) sum[c] = y[c];
      for (PetscInt k = begin_[i]; k < begin_[i + 1]; ++k) {
        const double entry = entry_[k];
        const double* const row = x + static_cast<std::ptrdiff_t>(column_[k]) * width;
        for (int c = 0; c < width; ++c) sum[c] += entry * row[c];
      }
      for (int c = 0; c < width; ++c) y[c] = sum[c];
    }
  }

 private:
  Mat matrix_;
  PetscInt rows_ = 0;
  const PetscInt *begin_ = nullptr, *column_ = nullptr;
  const PetscScalar* entry_ = nullptr;
};

template <int width>
void add(const SparseRows& a, const double* x, double* y) {
  a.addTo<width>(y, x);
}

#ifdef __x86_64__
/// The same for processors with wider registers than those that every x86-64 has.
template <int width>
[[gnu::target("avx2,fma")]] void addByAvx2(const SparseRows& a, const double* x, double* y) {
  a.addTo<width>(y, x);
}
template <int width>
[[gnu::target("avx512f")]] void addByAvx512(const SparseRows& a, const double* x, double* y) {
  a.addTo<width>(y, x);
}
#endif

using Adder = void (*)(const SparseRows&, const double*, double*);

/// Returns the fastest function for tiles of some width on this processor.
template <int width>
Adder fastest() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f")) return addByAvx512<width>;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return addByAvx2<width>;
#endif
  return add<width>;
}

/// Adds A X to Y for tiles of a width up to `widest`, a multiple of `unit`.
void addProduct(const SparseRows& a, PetscInt width, const double* x, double* y) {
  static const std::array byWidth{fastest<8>(), fastest<16>(), fastest<24>(), fastest<32>()};
  byWidth.at(width / unit - 1)(a, x, y);
}

/// A matrix of PETSc's type AIJ as the rows of this rank: those of its own unknowns, and those of
/// the unknowns of other ranks, which are sent by `fromOwners`.
struct Parts {
  Mat own = nullptr, others = nullptr;  // borrowed; `others` is null on a single rank
  PetscInt received = 0;                // number of unknowns of other ranks
  PetscSF fromOwners = nullptr;         // borrowed from the matrix
};

/// Collective. Returns the exchange of the unknowns of other ranks. The matrix keeps it for the
/// next product until its pattern changes.
PetscSF exchangeOf(Mat matrix, PetscInt received, const PetscInt* unknowns) {
  PetscObjectState pattern = 0;
  check(MatGetNonzeroState(matrix, &pattern));
  const std::string name = "squeal_exchange_" + std::to_string(pattern);
  PetscObject known = nullptr;
  check(PetscObjectQuery(object(matrix), name.c_str(), &known));
  if (known) return reinterpret_cast<PetscSF>(known);
  PetscLayout columns = nullptr;
  PetscSF exchange = nullptr;
  check(MatGetLayouts(matrix, nullptr, &columns));
  check(PetscSFCreate(commOf(matrix), &exchange));
  check(PetscSFSetGraphLayout(exchange, columns, received, nullptr, PETSC_COPY_VALUES, unknowns));
  check(PetscObjectCompose(object(matrix), name.c_str(), object(exchange)));
  check(PetscObjectDereference(object(exchange)));
  return exchange;
}

/// Collective. Returns false if the matrix is not of the type AIJ.
bool takeParts(Mat matrix, Parts& parts) {
  PetscBool isSequential = PETSC_FALSE, isDistributed = PETSC_FALSE;
  check(PetscObjectBaseTypeCompare(object(matrix), MATSEQAIJ, &isSequential));
  check(PetscObjectBaseTypeCompare(object(matrix), MATMPIAIJ, &isDistributed));
  if (isSequential) parts.own = matrix;
  if (!isDistributed) return isSequential;
  const PetscInt* unknowns = nullptr;
  check(MatMPIAIJGetSeqAIJ(matrix, &parts.own, &parts.others, &unknowns));
  check(MatGetSize(parts.others, nullptr, &parts.received));
  parts.fromOwners = exchangeOf(matrix, parts.received, unknowns);
  return true;
}

/// Calls copy(i, j) for all entries of a matrix, in pieces that the fastest cache holds both by
/// rows and by columns.
template <class Copy>
void copyByPieces(std::ptrdiff_t rows, std::ptrdiff_t columns, const Copy& copy) {
  constexpr std::ptrdiff_t piece = 32;
  for (std::ptrdiff_t begin = 0; begin < rows; begin += piece) {
    const std::ptrdiff_t end = std::min(begin + piece, rows);
    for (std::ptrdiff_t j = 0; j < columns; ++j)
      for (std::ptrdiff_t i = begin; i < end; ++i) copy(i, j);
  }
}

/// Columns of X, of A X, and of the unknowns of other ranks, stored by rows. Columns that fill up a
/// tile have any value.
struct Tiles {
  std::vector<double> from, to, received;
};

/// Collective. Writes A X to `result`, given by columns, for X of at most `widest` columns.
void multiplyTile(const Parts& parts, const DenseView& x, Tiles& tiles, double* result) {
  auto& [from, to, received] = tiles;
  const PetscInt count = x.columns(), width = (count + unit - 1) / unit * unit;
  const SparseRows own(parts.own);
  from.resize(static_cast<std::size_t>(x.rows()) * width);
  to.assign(static_cast<std::size_t>(own.size()) * width, 0.0);
  copyByPieces(x.rows(), count, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    from[i * width + j] = x.data()[j * x.rows() + i];
  });
  if (!parts.others) {
    addProduct(own, width, from.data(), to.data());
  } else {
    received.resize(static_cast<std::size_t>(parts.received) * width);
    MPI_Datatype row = MPI_DATATYPE_NULL;
    check(MPI_Type_contiguous(static_cast<int>(width), MPI_DOUBLE, &row));
    check(MPI_Type_commit(&row));
    check(PetscSFBcastBegin(parts.fromOwners, row, from.data(), received.data(), MPI_REPLACE));
    addProduct(own, width, from.data(), to.data());
    check(PetscSFBcastEnd(parts.fromOwners, row, from.data(), received.data(), MPI_REPLACE));
    check(MPI_Type_free(&row));
    const SparseRows others(parts.others);
    addProduct(others, width, received.data(), to.data());
    LoggedWork::addOperations(2.0 * others.entries() * count);
  }
  LoggedWork::addOperations(2.0 * own.entries() * count);
  const std::ptrdiff_t rows = own.size();
  copyByPieces(rows, count, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    result[j * rows + i] = to[i * width + j];
  });
}

/// Collective. Writes A X to `result` column by column, for operators without stored entries.
void multiplyColumns(Mat matrix, const OwnedMat& from, const OwnedMat& to, PetscInt count) {
  for (PetscInt j = 0; j < count; ++j) {
    Vec column = nullptr, product = nullptr;
    check(MatDenseGetColumnVecRead(from, j, &column));
    check(MatDenseGetColumnVecWrite(to, j, &product));
    check(MatMult(matrix, column, product));
    check(MatDenseRestoreColumnVecWrite(to, j, &product));
    check(MatDenseRestoreColumnVecRead(from, j, &column));
  }
}

}  // namespace

void appendProduct(Mat matrix, const DenseView& x, Block& result) {
  const LoggedWork work(Work::blockProduct);
  PetscInt rows = 0, length = 0, localRows = 0, localLength = 0;
  check(MatGetSize(matrix, &rows, &length));
  check(MatGetLocalSize(matrix, &localRows, &localLength));
  const PetscInt first = result.columns(), count = x.columns();
  if (count == 0) return;
  ensure(x.rows() == localLength && result.rows() == localRows,
         "the blocks of a product have the rows of the matrix on this rank");
  result.resizeColumns(first + count);
  if (rows == 0) return;
  Parts parts;
  if (takeParts(matrix, parts)) {
    Tiles tiles;
    for (PetscInt begin = 0; begin < count; begin += widest)
      multiplyTile(parts, x.columnRange(begin, std::min(begin + widest, count)), tiles,
                   result.column(first + begin).data());
    return;
  }
  const MPI_Comm comm = commOf(matrix);
  multiplyColumns(matrix, borrowed(comm, length, x),
                  borrowed(comm, rows, result.columnRange(first, first + count)), count);
}

}  // namespace squeal::linalg
