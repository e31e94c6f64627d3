#pragma once
/// PETSc's -log_view lists the work of this program in stages and as events of its own.
#include <petscsys.h>

#include <string>

namespace squeal {

/// Kinds of work that are events of -log_view besides PETSc's own.
enum class Work {
  blockSolve,        ///< solves with a factorised matrix, in blocks
  blockProduct,      ///< products of a sparse matrix and a block
  innerProduct,      ///< products Xᵀ Y of distributed blocks
  denseEigenvalues,  ///< eigenproblems of dense matrices, each on one rank
  sketch             ///< products with random signs that norms are estimated from
};

/// Collective. Registers all kinds of work with PETSc, in the same order on all ranks, as -log_view
/// asks for: a rank may have none of a kind.
void registerWork();

/// A LoggedWork counts as an event of PETSc from construction to destruction. Not collective.
class LoggedWork {
 public:
  explicit LoggedWork(Work work);
  ~LoggedWork();
  LoggedWork(const LoggedWork&) = delete;
  LoggedWork& operator=(const LoggedWork&) = delete;
  /// Counts floating-point operations.
  static void addOperations(double count) { PetscLogFlops(count); }

 private:
  PetscLogEvent event_;
};

/// A LoggedStage is a stage of PETSc's log from construction to destruction. Stages of one name are
/// one stage, and a stage within another takes its time off that. All ranks have to make the same
/// stages in the same order.
class LoggedStage {
 public:
  explicit LoggedStage(const std::string& name);
  ~LoggedStage();
  LoggedStage(const LoggedStage&) = delete;
  LoggedStage& operator=(const LoggedStage&) = delete;
};

/// A Traffic counts what PETSc and this program have sent so far from this rank. The messages of
/// MUMPS are not among them.
struct Traffic {
  double messages = 0;
  double bytes = 0;
  double reductions = 0;  ///< reductions and broadcasts that this rank took part in
};
/// Not collective.
Traffic trafficSoFar();

}  // namespace squeal
