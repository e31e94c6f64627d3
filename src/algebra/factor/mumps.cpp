// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/factor/mumps.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "base/options/options.hpp"
#include "base/petsc/log_events.hpp"
#include "base/session/stages.hpp"
#include "base/system/memory.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::factor {
namespace {

/// Number of right-hand sides per pass of MUMPS. With its default of 32, the remaining few would
/// need another pass. An option -…_mat_mumps_icntl_27 takes precedence.
constexpr int atOnce = 64;

/// MUMPS estimates its workspace and its message buffers from the pattern, but pivoting may need
/// more. A failed factorisation is repeated with these additional percentages (ICNTL(14)).
constexpr int workspaces[] = {100, 400};
/// Values of INFOG(1) if the workspace of a factorisation, or a buffer for messages between ranks,
/// is too small, and if the workspace of a solve is.
constexpr int tooSmall[] = {-8, -9, -17, -20}, tooSmallToSolve[] = {-11, -14, -15};

/// Ratio of estimated to free memory above which the factorisation is not attempted.
constexpr double hopeless = 2;

/// The jobs of MUMPS.
enum Job { begin = -1, end = -2, analysis = 1, factorisation = 2, solution = 3 };

/// Returns true for entries of ICNTL that the storage of matrix and right-hand sides determines.
bool isReserved(int i) { return i == 5 || (i >= 18 && i <= 21) || i == 26 || i == 30; }

/// Reads the options of ICNTL and CNTL.
PetscErrorCode readOptions(const char* prefix, DMUMPS_STRUC_C& id) {
  for (int i = 1; i <= 60; ++i) {
    if (isReserved(i)) continue;
    const std::string name = formatted("-mat_mumps_icntl_%d", i);
    PetscInt value = id.icntl[i - 1];
    PetscBool given = PETSC_FALSE;
    PetscCall(PetscOptionsGetInt(nullptr, prefix, name.c_str(), &value, &given));
    if (!given) continue;
    PetscCheck(i != 7 || (value >= 0 && value <= 7 && value != 1), PETSC_COMM_SELF,
               PETSC_ERR_ARG_OUTOFRANGE, "ICNTL(7) of MUMPS is 0 or 2 to 7");
    id.icntl[i - 1] = value;
  }
  for (int i = 1; i <= 15; ++i) {
    const std::string name = formatted("-mat_mumps_cntl_%d", i);
    PetscCall(PetscOptionsGetReal(nullptr, prefix, name.c_str(), &id.cntl[i - 1], nullptr));
  }
  for (const char* variable : {"TMPDIR", "MUMPS_OOC_TMPDIR"})
    if (const char* folder = std::getenv(variable))
      std::snprintf(id.ooc_tmpdir, sizeof id.ooc_tmpdir, "%s", folder);
  PetscCall(PetscOptionsGetString(nullptr, prefix, "-mat_mumps_ooc_tmpdir", id.ooc_tmpdir,
                                  sizeof id.ooc_tmpdir, nullptr));
  return 0;
}

}  // namespace

MumpsFactor::MumpsFactor(MPI_Comm comm, const std::string& prefix) {
  check(MPI_Comm_dup(comm, &comm_));
  check(MPI_Comm_size(comm_, &ranks_));
  id_.comm_fortran = MPI_Comm_c2f(comm_);
  id_.par = 1;
  id_.sym = 2;
  call(begin);
  for (int i = 1; i <= 4; ++i) icntl(i) = 0;  // checked writes ignore unit 0, the standard error
  icntl(18) = 3;                              // the matrix is distributed
  icntl(27) = atOnce;
  std::snprintf(id_.ooc_tmpdir, sizeof id_.ooc_tmpdir, "/tmp");
  applySolverOptions([&] { return readOptions(prefix.empty() ? nullptr : prefix.c_str(), id_); });
  if (icntl(4) > 0)  // the option enables the output
    icntl(1) = icntl(2) = icntl(3) = 6;
  else
    icntl(4) = 1;  // with 0, MUMPS sets the unit to -1, where some of its WRITEs abort the program
}

MumpsFactor::~MumpsFactor() {
  int finalised = 0;
  MPI_Finalized(&finalised);
  if (finalised) return;
  call(end);
  PetscSFDestroy(&toOwners_);
  MPI_Comm_free(&comm_);
}

void MumpsFactor::call(int job) {
  id_.job = job;
  dmumps_c(&id_);
}

void MumpsFactor::enableInertia(double zero) {
  icntl(13) = 1;  // ScaLAPACK on the root would hide its pivots' signs
  icntl(24) = 1;
  if (zero > 0) id_.cntl[2] = zero;
}

void MumpsFactor::keep(const std::vector<PetscInt>& rows) {
  kept_.clear();
  for (const PetscInt row : rows) kept_.push_back(row + 1);
  schur_.assign(rows.size() * rows.size(), 0.0);
  icntl(19) = 1;  // centralised, by rows
  // From three ranks on, blocks of the last front exceed the message buffers that MUMPS plans.
  if (ranks_ > 2) icntl(14) = std::max<MUMPS_INT>(icntl(14), workspaces[0]);
  id_.size_schur = std::ssize(kept_);
  id_.listvar_schur = kept_.data();
  id_.schur = schur_.data();
}

/// Passes the upper triangle of this rank's rows to MUMPS.
void MumpsFactor::setEntries(Mat matrix) {
  PetscInt n = 0, first = 0, last = 0;
  check(MatGetSize(matrix, &n, nullptr));
  check(MatGetOwnershipRange(matrix, &first, &last));
  localRows_ = last - first;
  rows_.clear(), columns_.clear(), entries_.clear();
  ownRows_.clear();
  MatInfo info;
  check(MatGetInfo(matrix, MAT_LOCAL, &info));
  const std::size_t upper = 0.5 * info.nz_used + localRows_;
  rows_.reserve(upper), columns_.reserve(upper), entries_.reserve(upper);
  for (PetscInt row = first; row < last; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check(MatGetRow(matrix, row, &count, &columns, &values));
    for (PetscInt j = 0; j < count; ++j)
      if (columns[j] >= row) {
        rows_.push_back(row + 1);
        columns_.push_back(columns[j] + 1);
        entries_.push_back(values[j]);
      }
    check(MatRestoreRow(matrix, row, &count, &columns, &values));
    ownRows_.push_back(row + 1);
  }
  hasEntries_ = true;
  if (n > std::numeric_limits<MUMPS_INT>::max())
    throw Error("a factorisation: the matrix has more rows than MUMPS can count");
  id_.n = n;
  id_.nnz_loc = std::ssize(entries_);
  id_.irn_loc = rows_.data();
  id_.jcn_loc = columns_.data();
  id_.a_loc = entries_.data();
}

void MumpsFactor::analyse(Mat matrix, const MumpsFactor* like) {
  setEntries(matrix);
  if (like) {
    if (mpi::rank(comm_) == 0) order_.assign(like->id_.sym_perm, like->id_.sym_perm + id_.n);
    id_.perm_in = order_.data();
    icntl(7) = 1;
    icntl(28) = 1;
  }
  call(analysis);
  if (const std::string why = failure(); !why.empty()) throw Error("a factorisation: " + why);
}

/// Compares the memory estimate of the analysis with the free memory, before the machine swaps or
/// the kernel kills the process. If memory is short, the factor goes to disk.
void MumpsFactor::fitIntoMemory() {
  const double ownInCore = 1e6 * id_.info[14], ownOnDisk = 1e6 * id_.info[16];
  double inCore = ownInCore, onDisk = ownOnDisk;
  const double free = memoryFreeOnNode(comm_, inCore);
  memoryFreeOnNode(comm_, onDisk);
  const bool onDiskByOption = icntl(22) == 1;
  const auto worst =
      mpi::maxLocated(comm_, (onDiskByOption ? onDisk : inCore) / std::max(free, 1.0));
  if (worst.value <= 1) return;
  std::array sizes{inCore, onDisk, free};
  mpi::broadcast(comm_, sizes, worst.rank);
  const std::string text =
      formatted("the factorisation%s needs %.3g GB on a node where %.3g GB are free",
                onDiskByOption ? ", with its factor on disk," : "",
                1e-9 * sizes[onDiskByOption ? 1 : 0], 1e-9 * sizes[2]);
  if (sizes[1] > hopeless * sizes[2]) throw Error(text + ": " + lessMemory);
  icntl(22) = 1;
  printWarning(comm_,
               "warning: " + text +
                   (onDiskByOption ? std::string("; trying it nevertheless")
                                   : formatted("; with the factor on disk, in %s, it needs %.3g "
                                               "GB",
                                               id_.ooc_tmpdir, 1e-9 * sizes[1])));
}

std::string MumpsFactor::factorise(Mat matrix) {
  if (matrix && !hasEntries_) setEntries(matrix);
  fitIntoMemory();
  ++sparseWork().factorisations;
  call(factorisation);
  for (const int percent : workspaces) {
    if (std::ranges::find(tooSmall, infog(1)) == std::end(tooSmall)) break;
    if (icntl(14) >= percent) continue;
    icntl(14) = percent;
    call(factorisation);
  }
  // Only iterative refinement and error analysis of solves still need the entries.
  if (icntl(10) == 0 && icntl(11) == 0) {  // assigning {} would retain the memory
    rows_ = std::vector<MUMPS_INT>(), columns_ = std::vector<MUMPS_INT>();
    entries_ = std::vector<double>();
  }
  hasEntries_ = false;
  solutionRows_.clear();
  return failure();
}

void MumpsFactor::solve(const double* b, double* x, PetscInt columns) {
  if (columns == 0) return;
  sparseWork().rightHandSides += columns;
  id_.nrhs = columns;
  if (ranks_ == 1) {
    icntl(20) = icntl(21) = 0;
    std::copy(b, b + static_cast<std::ptrdiff_t>(columns) * localRows_, x);
    id_.rhs = x;
    id_.lrhs = localRows_;
    call(solution);
  } else {
    icntl(20) = 10;
    icntl(21) = 1;
    id_.rhs_loc = const_cast<double*>(b);  // MUMPS only reads it
    id_.irhs_loc = ownRows_.data();
    id_.nloc_rhs = localRows_;
    id_.lrhs_loc = std::max<PetscInt>(localRows_, 1);
    id_.lsol_loc = std::max<MUMPS_INT>(id_.info[22], 1);
    solution_.resize(static_cast<std::size_t>(id_.lsol_loc) * columns);
    id_.sol_loc = solution_.data();
    std::vector<MUMPS_INT> rows(id_.lsol_loc);
    id_.isol_loc = rows.data();
    call(solution);
    rows.resize(id_.info[22]);
    const bool same = toOwners_ && !solutionRows_.empty() && rows == solutionRows_;
    if (!mpi::all(comm_, same)) {
      solutionRows_ = std::move(rows);
      std::vector<PetscInt> global;
      for (const MUMPS_INT row : solutionRows_) global.push_back(row - 1);
      PetscLayout layout = nullptr;
      check(PetscSFDestroy(&toOwners_));
      check(PetscLayoutCreateFromSizes(comm_, localRows_, id_.n, 1, &layout));
      check(PetscSFCreate(comm_, &toOwners_));
      check(PetscSFSetGraphLayout(toOwners_, layout, global.size(), nullptr, PETSC_COPY_VALUES,
                                  global.data()));
      check(PetscLayoutDestroy(&layout));
    }
    scatterSolution(x, columns);
  }
  if (infog(1) < 0) throw Error("a solve by MUMPS: " + failure());
}

/// Sends the rows of the solution to their owners, all columns in one message.
void MumpsFactor::scatterSolution(double* x, PetscInt columns) {
  const std::size_t here = solutionRows_.size(), own = localRows_;
  byRows_.resize((here + own) * columns);
  double* const leaves = byRows_.data();
  double* const roots = leaves + here * columns;
  for (PetscInt j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < here; ++i)
      leaves[i * columns + j] = solution_[static_cast<std::size_t>(id_.lsol_loc) * j + i];
  MPI_Datatype row = MPI_DATATYPE_NULL;
  check(MPI_Type_contiguous(columns, MPI_DOUBLE, &row));
  check(MPI_Type_commit(&row));
  check(PetscSFReduceBegin(toOwners_, row, leaves, roots, MPI_REPLACE));
  check(PetscSFReduceEnd(toOwners_, row, leaves, roots, MPI_REPLACE));
  check(MPI_Type_free(&row));
  for (PetscInt j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < own; ++i) x[own * j + i] = roots[i * columns + j];
}

/// Returns the reason why MUMPS failed, from INFOG(1) and INFOG(2) of its manual; empty if it did
/// not fail.
std::string MumpsFactor::failure() const {
  const int code = id_.infog[0];
  if (code >= 0) return "";
  const std::string numbers =
      formatted(" (INFOG(1) = %d, INFOG(2) = %d)", code, static_cast<int>(id_.infog[1]));
  constexpr int allocations[] = {-5, -7, -13, -19, -22}, overflow[] = {-51, -52};
  const auto among = [&](const auto& codes) {
    return std::find(std::begin(codes), std::end(codes), code) != std::end(codes);
  };
  if (among(allocations)) return "MUMPS is out of memory" + numbers + ": " + lessMemory;
  if (among(tooSmall) || among(tooSmallToSolve))
    return "MUMPS needs a larger workspace than estimated" + numbers +
           formatted(": raise -…_mat_mumps_icntl_14, percent, above %d",
                     static_cast<int>(id_.icntl[13]));
  if (among(overflow))
    return "the factor has more entries than a 32-bit integer can count" + numbers +
           ": use more ranks";
  if (code == -6 || code == -10)
    return "the matrix is singular" + numbers + ": is a body under-constrained?";
  if (code <= -90 && code > -100)
    return "MUMPS cannot store its factor in the folder " + std::string(id_.ooc_tmpdir) + numbers +
           ": name another folder by -…_mat_mumps_ooc_tmpdir";
  return "MUMPS fails" + numbers;
}

void solve(MumpsFactor& factor, Mat b, Mat x) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscInt columns = 0;
  check(MatGetSize(b, nullptr, &columns));
  check(MatDenseGetArrayRead(b, &from));
  check(MatDenseGetArrayWrite(x, &to));
  factor.solve(from, to, columns);
  check(MatDenseRestoreArrayWrite(x, &to));
  check(MatDenseRestoreArrayRead(b, &from));
}

}  // namespace squeal::factor
