// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Stages and events of this program in PETSc's -log_view.
#include <petscsys.h>

#include <string>

namespace squeal {

/// Kinds of work that -log_view lists in addition to PETSc's own events.
enum class Work {
  blockSolve,        ///< solves with a factorised matrix, in blocks
  blockProduct,      ///< products of a sparse matrix and a block
  innerProduct,      ///< products Xᵀ Y of distributed blocks
  denseEigenvalues,  ///< eigenproblems of dense matrices, each on one rank
  sketch             ///< products with random signs, for norm estimates
};

/// Collective. Registers all kinds of work with PETSc. -log_view requires that all ranks register
/// them in the same order, even kinds of work that a rank does not do.
void registerWork();

/// A PETSc event that lasts from construction to destruction. Not collective.
class LoggedWork {
 public:
  explicit LoggedWork(Work work);
  ~LoggedWork();
  LoggedWork(const LoggedWork&) = delete;
  LoggedWork& operator=(const LoggedWork&) = delete;
  static void addOperations(double count) { PetscLogFlops(count); }

 private:
  PetscLogEvent event_;
};

/// A stage of PETSc's log that lasts from construction to destruction. Objects of the same name
/// share one stage. The time of a nested stage is not included in that of the outer one. All ranks
/// must construct the same stages in the same order.
class LoggedStage {
 public:
  explicit LoggedStage(const std::string& name);
  ~LoggedStage();
  LoggedStage(const LoggedStage&) = delete;
  LoggedStage& operator=(const LoggedStage&) = delete;
};

/// The messages that PETSc and this program have sent so far from this rank, not counting those of
/// MUMPS.
struct Traffic {
  double messages = 0;
  double bytes = 0;
  double reductions = 0;  ///< number of reductions and broadcasts that this rank took part in
};
/// Not collective. Returns the totals of this rank.
Traffic trafficSoFar();

/// The work with sparse matrices so far, which determines the cost of a run; the same on all ranks.
struct SparseWork {
  long factorisations = 0;  ///< by MUMPS
  long rightHandSides = 0;  ///< right-hand sides solved with MUMPS factors
  long projections = 0;     ///< products Tᵀ X T with the transformation T of the contact
};
/// Not collective. Returns the record. Code that does such work must count it there.
SparseWork& sparseWork();

}  // namespace squeal
