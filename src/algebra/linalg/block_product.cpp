// SPDX-License-Identifier: BSD-2-Clause
// Products of a sparse matrix and a block of columns. PETSc's MatMatMult reads the matrix again for
// every four columns, and takes their entries from four places. Here the columns are stored by rows
// first, 32 at a time, so that an entry of the matrix meets 32 neighbouring numbers.
#include <petscsf.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "base/petsc/log_events.hpp"
#include "base/petsc/object.hpp"

namespace squeal::linalg {
namespace {

/// Number of columns that are stored together, the width of a tile, and its unit.
constexpr PetscInt widest = 32, unit = 8;
/// A unit of a row, for the registers of the processor. The widest ones need this alignment.
struct alignas(unit * sizeof(double)) Unit {
  using Numbers [[gnu::vector_size(unit * sizeof(double))]] = double;
  Numbers numbers;
};

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

  /// Sets the entries of the columns with entries to 1.
  void markColumns(std::vector<unsigned char>& marks) const {
    for (PetscInt k = 0; k < entries(); ++k) marks[column_[k]] = 1;
  }
  /// Adds A X to Y. Both are stored by rows of `parts` units. Treats up to `most` rows at a time if
  /// they have the same columns, as those of the displacements of a node have: their products read
  /// X once.
  template <int parts, int most>
  [[gnu::always_inline]] void addTo(Unit* y, const Unit* x) const {
    for (PetscInt i = 0; i < rows_;) {
      if (most == 3 && i + 2 < rows_ && isAlike(i, i + 1) && isAlike(i, i + 2)) {
        addRows<parts, 3>(i, y + i * std::ptrdiff_t(parts), x);
        i += 3;
      } else {
        addRows<parts, 1>(i, y + i * std::ptrdiff_t(parts), x);
        ++i;
      }
    }
  }

 private:
  /// Returns true if two rows have the same columns.
  bool isAlike(PetscInt i, PetscInt j) const {
    return std::equal(column_ + begin_[i], column_ + begin_[i + 1], column_ + begin_[j],
                      column_ + begin_[j + 1]);
  }
  /// Adds `count` rows of A X, from row i on, which have the same columns.
  template <int parts, int count>
  [[gnu::always_inline]] void addRows(PetscInt i, Unit* y, const Unit* x) const {
    // Without unrolled loops, the compiler leaves the sums in memory.
    Unit::Numbers sum[count][parts];
    const double* entry[count];
#pragma GCC unroll 3
    for (int r = 0; r < count; ++r) {
      entry[r] = entry_ + begin_[i + r];
#pragma GCC unroll 4
      for (int p = 0; p < parts; ++p) sum[r][p] = y[r * parts + p].numbers;
    }
    const PetscInt* const column = column_ + begin_[i];
    const PetscInt length = begin_[i + 1] - begin_[i];
    for (PetscInt k = 0; k < length; ++k) {
      const Unit* const row = x + static_cast<std::ptrdiff_t>(column[k]) * parts;
#pragma GCC unroll 3
      for (int r = 0; r < count; ++r) {
#pragma GCC unroll 4
        for (int p = 0; p < parts; ++p) sum[r][p] += entry[r][k] * row[p].numbers;
      }
    }
#pragma GCC unroll 3
    for (int r = 0; r < count; ++r) {
#pragma GCC unroll 4
      for (int p = 0; p < parts; ++p) y[r * parts + p].numbers = sum[r][p];
    }
  }

  Mat matrix_;
  PetscInt rows_ = 0;
  const PetscInt *begin_ = nullptr, *column_ = nullptr;
  const PetscScalar* entry_ = nullptr;
};

template <int parts>
void add(const SparseRows& a, const Unit* x, Unit* y) {
  a.addTo<parts, 1>(y, x);
}

#ifdef __x86_64__
/// The same for processors with wider registers than those that every x86-64 has. The sums of three
/// rows fit into the registers of the last.
template <int parts>
[[gnu::target("avx2,fma")]] void addByAvx2(const SparseRows& a, const Unit* x, Unit* y) {
  a.addTo<parts, 1>(y, x);
}
template <int parts>
[[gnu::target("avx512f")]] void addByAvx512(const SparseRows& a, const Unit* x, Unit* y) {
  a.addTo<parts, 3>(y, x);
}
#endif

using Adder = void (*)(const SparseRows&, const Unit*, Unit*);

/// Returns the fastest function for tiles of some units on this processor.
template <int parts>
Adder fastest() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f")) return addByAvx512<parts>;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return addByAvx2<parts>;
#endif
  return add<parts>;
}

/// Adds A X to Y for tiles of up to four units.
void addProduct(const SparseRows& a, PetscInt units, const Unit* x, Unit* y) {
  static const std::array byUnits{fastest<1>(), fastest<2>(), fastest<3>(), fastest<4>()};
  byUnits.at(units - 1)(a, x, y);
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

/// Collective. Returns the rows of X on this rank that A X needs on any rank: few if A has few
/// entries.
std::vector<PetscInt> neededRows(const Parts& parts, const SparseRows& own, PetscInt rows) {
  const PetscInt* receivers = nullptr;  // [row] their number
  if (parts.fromOwners) {
    check(PetscSFComputeDegreeBegin(parts.fromOwners, &receivers));
    check(PetscSFComputeDegreeEnd(parts.fromOwners, &receivers));
  }
  std::vector<unsigned char> needed(rows, own.entries() >= rows);
  if (own.entries() < rows) own.markColumns(needed);
  std::vector<PetscInt> list;
  for (PetscInt i = 0; i < rows; ++i)
    if (needed[i] || (receivers && receivers[i] > 0)) list.push_back(i);
  return list;
}

/// Memory for columns stored by rows, which begins with any values.
class Tile {
 public:
  /// Returns space for this number of units. A later call may replace it.
  Unit* of(std::size_t units) {
    if (units > units_) memory_ = std::make_unique_for_overwrite<Unit[]>(units_ = units);
    return memory_.get();
  }

 private:
  std::unique_ptr<Unit[]> memory_;
  std::size_t units_ = 0;
};

/// Columns of X, of A X, and of the unknowns of other ranks.
struct Tiles {
  Tile from, to, received;
};

/// Writes the needed rows of X to a tile. Columns that fill it up become zero.
void fill(const DenseView& x, const std::vector<PetscInt>& needed, PetscInt units, Unit* tile) {
  const PetscInt count = x.columns();
  const std::ptrdiff_t rows = x.rows();
  if (count % unit != 0)
    for (const std::ptrdiff_t i : needed) tile[i * units + units - 1] = Unit{};
  const auto copy = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    tile[i * units + j / unit].numbers[j % unit] = x.data()[j * rows + i];
  };
  if (std::ssize(needed) == rows) return copyByPieces(rows, count, copy);
  copyByPieces(std::ssize(needed), count,
               [&](std::ptrdiff_t k, std::ptrdiff_t j) { copy(needed[k], j); });
}

/// Collective. Writes A X to `result`, given by columns, for X of at most `widest` columns.
/// `needed` are the rows of neededRows().
void multiplyTile(const Parts& parts, const DenseView& x, const std::vector<PetscInt>& needed,
                  Tiles& tiles, double* result) {
  const PetscInt count = x.columns(), units = (count + unit - 1) / unit;
  const SparseRows own(parts.own);
  const std::ptrdiff_t rows = own.size();
  Unit* const from = tiles.from.of(static_cast<std::size_t>(x.rows()) * units);
  Unit* const to = tiles.to.of(rows * units);
  std::fill_n(to, rows * units, Unit{});
  fill(x, needed, units, from);
  if (!parts.others) {
    addProduct(own, units, from, to);
  } else {
    Unit* const received = tiles.received.of(static_cast<std::size_t>(parts.received) * units);
    MPI_Datatype row = MPI_DATATYPE_NULL;
    check(MPI_Type_contiguous(static_cast<int>(units * unit), MPI_DOUBLE, &row));
    check(MPI_Type_commit(&row));
    check(PetscSFBcastBegin(parts.fromOwners, row, from, received, MPI_REPLACE));
    addProduct(own, units, from, to);
    check(PetscSFBcastEnd(parts.fromOwners, row, from, received, MPI_REPLACE));
    check(MPI_Type_free(&row));
    const SparseRows others(parts.others);
    addProduct(others, units, received, to);
    LoggedWork::addOperations(2.0 * others.entries() * count);
  }
  LoggedWork::addOperations(2.0 * own.entries() * count);
  copyByPieces(rows, count, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    result[j * rows + i] = to[i * units + j / unit].numbers[j % unit];
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
    const auto needed = neededRows(parts, SparseRows(parts.own), localLength);
    for (PetscInt begin = 0; begin < count; begin += widest)
      multiplyTile(parts, x.columnRange(begin, std::min(begin + widest, count)), needed, tiles,
                   result.column(first + begin).data());
    return;
  }
  const MPI_Comm comm = commOf(matrix);
  multiplyColumns(matrix, borrowed(comm, length, x),
                  borrowed(comm, rows, result.columnRange(first, first + count)), count);
}

}  // namespace squeal::linalg
