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
  double followedSteps = 0;  ///< steps of the friction in which changes of contact are located
  double trackedSteps = 0;   ///< steps of the friction over which eigenvalues are tracked
  double released = 350;     ///< `-flutter_released`: nodes in which the sets of a group may differ
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

/// The size of a group of points that share a basis. Independent of the number of ranks.
struct GroupSize {
  double unknowns = 0;
  double modes = 0;       ///< free modes
  double points = 0;      ///< of the sweep
  double activeSets = 0;  ///< number of times that the active set changes between points, plus 1
  double differing = 0;   ///< number of contact nodes in which these sets differ
  double spectra = 0;     ///< number of spectra between the points that tracking takes
  /// Operations of a factorisation and entries of the factor; 0: those of a solid.
  double factorFlops = 0, factorEntries = 0;
};

/// Returns an estimate of the number of contact nodes that open or close on a step of the friction,
/// as measured for floating_caliper; at least 1.
double changesOnStep(double contactUnknowns);

/// Returns how many of `steps` between two frictions a run is expected to follow from one change of
/// the contact to the next: all or none. `most` is the largest number of changes on a step that it
/// follows; 0: it follows none.
double followedSteps(double steps, double contactUnknowns, int most);

/// Returns an estimate of the work on a group without damping: the number of operations of dense
/// products that take the same time.
double groupWork(const GroupSize& size);

/// Collective. Returns the speed of dense matrix products on all ranks together, operations/s. The
/// measurement takes a few hundredths of a second.
double denseSpeed(MPI_Comm comm);

/// A division of the steps of a sweep into groups of neighbouring points.
struct DividedSweep {
  double groups = 1;
  double work = 0;  ///< of all groups: see groupWork()
};

/// Returns the division into groups of equal size with the least work, if changesOnStep() nodes
/// change, one after the other, between neighbouring points. The active sets of a group differ in
/// at most `released` nodes. The sweep has at least two points.
DividedSweep dividedSweep(const RunSize& size);

/// Returns the estimates for a run. `setsDiffer`: changesOnStep() nodes change on each step of the
/// friction, and the points are solved in groups, each with its own factorisation and basis.
/// Otherwise all points have the same active set. `speed` is that of denseSpeed(). The motion after
/// flutter is not included.
RunCost runCost(const RunSize& size, bool setsDiffer, double speed);

}  // namespace squeal::analysis
