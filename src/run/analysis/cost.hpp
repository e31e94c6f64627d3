// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Estimates of the memory and the time of a run, before anything is solved. They are based on the
/// operation counts of the stages; the constants and the size of the basis come from measurements
/// (docs/performance.md).
#include <mpi.h>

namespace squeal::analysis {

/// The size of a run, as far as the input determines it.
struct RunSize {
  double unknowns = 0;
  double modes = 0;         ///< free modes
  double points = 0;        ///< of the sweep
  double steadyPoints = 0;  ///< number of different steady states at these points
  /// Number of unknowns that contact adds when it opens or slides: gaps of interfaces that can
  /// separate, and tangential displacements of nodes that stick.
  double contactUnknowns = 0;
  double factorBytes = 0;    ///< memory of a factorisation of K0
  double factorEntries = 0;  ///< entries of the factor
  double factorFlops = 0;    ///< operations of a factorisation
  double bytesInUse = 0;     ///< mesh, matrices and libraries, on all ranks
  double secondsSoFar = 0;   ///< for mesh, matrices, contact and audit
  bool corrected = true;     ///< the basis gets corrections (`-flutter_basis` is not modal)
  bool damped = false;       ///< the problem has terms in s
  /// The problem has terms that scale with the speed or the damping factor, so the eigenvectors of
  /// the points differ more.
  bool varied = false;
  int pointTerms = 0;  ///< number of powers of s with terms specific to each point
};

struct RunCost {
  double bytes = 0, seconds = 0;
};

/// Collective. Returns the speed of dense matrix products on all ranks together, operations/s. The
/// measurement takes a few hundredths of a second.
double denseSpeed(MPI_Comm comm);

/// Returns the estimates for a run whose points are solved in `groups` groups, each with its own
/// factorisations and basis. `setsDiffer`: a basis serves several active sets. `speed` is that of
/// denseSpeed(). The motion after flutter is not included.
RunCost runCost(const RunSize& size, double groups, bool setsDiffer, double speed);

}  // namespace squeal::analysis
