// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/cost.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/dense.hpp"
#include "base/system/mpi.hpp"

namespace squeal::analysis {
namespace {

// Operations of sparse factors are slower than those of dense products.
constexpr double factorSpeed = 0.24, solveSpeed = 0.12;
/// Work on an unsymmetric spectrum in a basis of m vectors, in m³ operations of dense products.
constexpr double spectrumWork = 50;

/// Returns the number of vectors in the basis at the end of a group of points. Complex eigenvectors
/// need two vectors each, and differ more between points if the speed or loss factors vary.
double basisSize(const RunSize& size, bool setsDiffer) {
  double perMode = setsDiffer ? 4.6 : 2.3;
  if (!size.corrected) return size.modes;
  if (size.damped) perMode = 3.5 + std::min(3.5, 0.1 * size.points);
  if (size.damped && size.varied) perMode += 2;
  return std::min(perMode * size.modes, size.unknowns);
}

}  // namespace

double groupWork(const GroupSize& size) {
  // The latency of many small steps; a factorisation of a solid takes about 30 n² operations and
  // has 15 n^(4/3) entries.
  constexpr double start = 1e10;
  const double n = size.unknowns, flops = size.factorFlops > 0 ? size.factorFlops : 30 * n * n,
               entries = size.factorEntries > 0 ? size.factorEntries : 15 * std::pow(n, 4. / 3),
               factor = flops / factorSpeed, solve = 4 * entries / solveSpeed;
  const double freeModes = 2.1 * size.modes * solve + 150 * n * size.modes * size.modes;
  // Points with similar active sets share most of their vectors.
  constexpr double vectorsPerMode = 2.3, furtherPerMode = 0.85, perNode = 1.4, similar = 40,
                   mostSets = 5;
  const double further = furtherPerMode * size.modes * std::min(1.0, size.differing / similar) *
                         (std::min(size.activeSets, mostSets) - 1),
               basis = vectorsPerMode * size.modes + further + perNode * size.differing;
  const double corrections = (basis - size.modes) * solve + 6 * n * basis * basis;
  return start + 2 * factor + freeModes + corrections +
         spectrumWork * (size.points + size.spectra) * basis * basis * basis;
}

double denseSpeed(MPI_Comm comm) {
  constexpr PetscInt order = 400;
  linalg::DenseMatrix a(order, order);
  for (PetscInt j = 0; j < order; ++j)
    for (PetscInt i = 0; i < order; ++i) a(i, j) = 1.0 / (1 + i + j);
  linalg::product(a, a);  // the first product also starts the library
  constexpr int times = 3;
  check(MPI_Barrier(comm));
  const double begin = MPI_Wtime();
  for (int i = 0; i < times; ++i) linalg::product(a, a);
  return mpi::sum(comm, times * 2.0 * order * order * order / (MPI_Wtime() - begin));
}

double changesOnStep(double contactUnknowns) { return std::max(0.03 * contactUnknowns, 1.0); }

double followedSteps(double steps, double contactUnknowns, int most) {
  return most > 0 && changesOnStep(contactUnknowns) <= most ? steps : 0;
}

DividedSweep dividedSweep(const RunSize& size) {
  const double all = size.steadyPoints - 1, changes = changesOnStep(size.contactUnknowns),
               dampings = size.points / size.steadyPoints, followed = size.followedSteps / all,
               tracked = size.trackedSteps / all;
  const bool share = changes <= size.released;  // neighbouring points may share a basis
  const auto divided = [&](double stepsOfGroup) {
    const double groups = std::ceil(all / stepsOfGroup);
    const GroupSize group{.unknowns = size.unknowns,
                          .modes = size.modes,
                          .points = dampings * (stepsOfGroup + 1),
                          .activeSets = stepsOfGroup + 1,
                          .differing = changes * stepsOfGroup,
                          // one at both ends of the interval of each set
                          .spectra = !share         ? 0
                                     : followed > 0 ? tracked * stepsOfGroup * 2 * changes
                                                    : tracked * stepsOfGroup,
                          .factorFlops = size.factorFlops,
                          .factorEntries = size.factorEntries};
    return DividedSweep{groups, groups * groupWork(group)};
  };
  DividedSweep best = divided(1);
  for (double steps = 2; steps <= all && changes * steps <= size.released; ++steps)
    if (const auto other = divided(steps); other.work < best.work) best = other;
  return best;
}

RunCost runCost(const RunSize& size, bool setsDiffer, double speed) {
  constexpr double start = 1.5;  // s, of the program, and for its report
  const double basis = basisSize(size, false), n = size.unknowns, contact = size.contactUnknowns;
  const double factor = size.factorFlops / (factorSpeed * speed),
               solve = 4 * size.factorEntries / (solveSpeed * speed);
  const double freeModes = 2.1 * size.modes * solve + 150 * n * size.modes * size.modes / speed;
  const double corrections = (basis - size.modes) * solve + 6 * n * basis * basis / speed;
  // The first points, and tracking, need more solves than the later ones.
  const double dense = 280 * (size.points + 8) * basis * basis * basis / speed;
  const double steady = 6 * contact * contact * contact / speed + 5 * solve;
  double points = factor + freeModes + corrections + dense;
  if (setsDiffer) {
    const DividedSweep divided = dividedSweep(size);
    // The responses to changes of contact on a step
    const double path = 50 * size.followedSteps * contact * contact * contact / speed;
    const double inGroups =
        size.damped ? points + (divided.groups - 1) * (points - dense) : divided.work / speed;
    points = path + std::max(points, inGroups);
  }
  RunCost cost;
  cost.seconds =
      start + 1.2 * size.secondsSoFar + 2e-5 * n + 2 * factor + size.steadyPoints * steady + points;
  const double stored = basisSize(size, setsDiffer);
  // Matrices of the order of the basis: the pairs of all points, the terms that belong to one point
  // for the points that are solved together, and the linearised problems of the ranks.
  constexpr double together = 16;
  const double denseMatrices =
      size.damped ? 40 + 1.5 * size.points + 8 * size.pointTerms * std::min(size.points, together)
                  : 80 + 3 * size.points;
  cost.bytes = size.bytesInUse + 2 * size.factorBytes +
               8 * (2.7 * n * stored + denseMatrices * stored * stored +
                    4 * std::min(7.0, size.steadyPoints) * contact * contact);
  return cost;
}

}  // namespace squeal::analysis
