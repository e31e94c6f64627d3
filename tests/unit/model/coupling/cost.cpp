// SPDX-License-Identifier: BSD-2-Clause
// What a coupling costs on 2 ranks: time and memory are proportional to the number of faces.
#include <gtest/gtest.h>
#include <malloc.h>
#include <petsctime.h>

#include <fstream>

#include "support/model/coupled_surfaces.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using namespace test;

/// Of the rank where it is largest.
struct Cost {
  double milliseconds, kilobytes;  ///< for each slave face of a rank
};

/// Returns the memory of this process, kB; `key` is VmRSS or VmHWM, its largest so far.
double memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
    if (line.starts_with(key)) return std::stod(line.substr(key.size() + 1));
  throw std::runtime_error("no " + key + " in /proc/self/status");
}

/// Forgets the largest memory so far (proc(5)).
void resetPeak() { std::ofstream("/proc/self/clear_refs") << 5; }

/// Collective. Couples two plates of n × n cells and (n + 1) × (n − 1) cells.
Cost costOf(int cell, int n) {
  int ranks = 1;
  check(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  const Case c = caseOf(blocksApart("cost.msh", {cell, {n, n, 1}, {0, 0, -0.1}, {1, 1, 0}, 0},
                                    {cell, {n + 1, n - 1, 1}, {0, 0, 0}, {1, 1, 0.1}, 0}));
  malloc_trim(0);  // what earlier cases have freed would hide what this one takes
  resetPeak();
  const double before = memory("VmRSS");
  PetscLogDouble start = 0, end = 0;
  check(PetscTime(&start));
  const Coupling coupling = padOnDisc(c.mesh);
  check(PetscTime(&end));
  const double faces = double(coupling.slave.faces) / ranks;
  EXPECT_NEAR(coupling.coveredArea, 1, 1e-9);
  const Cost cost{largest(1e3 * (end - start)) / faces, largest(memory("VmHWM") - before) / faces};
  print("cell %d, %d slave faces on %d ranks: %.3f ms and %.1f kB a face of a rank\n", cell,
        int(coupling.slave.faces), ranks, cost.milliseconds, cost.kilobytes);
  return cost;
}

/// The largest one has 10⁵ faces on each side. Other programs may slow down one of the runs.
void expectProportional(int cell, const std::vector<int>& sizes) {
  const Cost least = costOf(cell, sizes.front());
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    const Cost cost = costOf(cell, sizes[i]);
    EXPECT_LT(cost.milliseconds, 3 * least.milliseconds);
    EXPECT_LT(cost.kilobytes, 1.3 * least.kilobytes);
  }
}

TEST(Cost, IsProportionalToTheFacesOfQuad4) { expectProportional(hex8, {79, 158, 316}); }

TEST(Cost, IsProportionalToTheFacesOfTri6) { expectProportional(wedge15, {56, 112, 224}); }

}  // namespace
}  // namespace squeal
