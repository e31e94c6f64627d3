// SPDX-License-Identifier: BSD-2-Clause
// Estimates of memory and time before a run.
#include "run/analysis/cost.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <vector>

namespace squeal::analysis {
namespace {

struct Measured {
  const char* name;
  RunSize size;
  double groups;
  bool setsDiffer;
  double gigabytes;  ///< largest memory of the run
};

/// Runs of the cases in options/ on two ranks, with the sizes that -dry_run finds.
std::vector<Measured> runs() {
  return {
      {"disc_brake",
       {.unknowns = 53151,
        .modes = 200,
        .points = 13,
        .steadyPoints = 13,
        .contactUnknowns = 275,
        .factorBytes = 0.26e9,
        .bytesInUse = 0.44e9},
       1,
       false,
       1.51},
      {"disc_brake_map",
       {.unknowns = 6531,
        .modes = 50,
        .points = 96,
        .steadyPoints = 48,
        .contactUnknowns = 45,
        .factorBytes = 0.05e9,
        .bytesInUse = 0.19e9,
        .damped = true,
        .varied = true,
        .pointTerms = 3},
       1,
       false,
       1.21},
      {"disc_brake_rotating",
       {.unknowns = 53151,
        .modes = 120,
        .points = 30,
        .steadyPoints = 30,
        .contactUnknowns = 275,
        .factorBytes = 0.26e9,
        .bytesInUse = 0.55e9,
        .damped = true,
        .varied = true,
        .pointTerms = 3},
       1,
       false,
       8.17},
      {"layer",
       {.unknowns = 828, .modes = 200, .points = 4, .factorBytes = 0.002e9, .bytesInUse = 0.13e9},
       1,
       false,
       0.32},
      {"floating_caliper",
       {.unknowns = 100276,
        .modes = 200,
        .points = 7,
        .steadyPoints = 7,
        .contactUnknowns = 3542,
        .factorBytes = 0.6e9,
        .bytesInUse = 1.4e9},
       4,
       true,
       7.42}};
}

// The constants are fitted to these runs, within 27 %. Peaks of memory differ by some per cent from
// run to run.
TEST(RunCost, ForetellsTheMemoryOfMeasuredRuns) {
  for (const auto& run : runs()) {
    const double ratio =
        1e-9 * runCost(run.size, run.groups, run.setsDiffer, 1e11).bytes / run.gigabytes;
    EXPECT_GT(ratio, 0.74) << run.name;
    EXPECT_LT(ratio, 1.3) << run.name;
  }
}

// All operations take half the time at twice the speed. A factorisation for the steady states and
// two for each group take their time.
TEST(RunCost, FollowsTheCountsOfOperations) {
  RunSize size{.unknowns = 1e5, .modes = 100, .points = 5};
  const double fixed = 2e-5 * size.unknowns;
  EXPECT_NEAR(runCost(size, 1, false, 2e10).seconds - fixed,
              (runCost(size, 1, false, 1e10).seconds - fixed) / 2, 1e-9);
  const double before = runCost(size, 3, false, 1e10).seconds;
  size.factorFlops = 2.4e9;  // a second at 0.24 of the speed
  EXPECT_NEAR(runCost(size, 3, false, 1e10).seconds - before, 1 + 2 * 3, 1e-9);
  size.secondsSoFar = 10;
  EXPECT_NEAR(runCost(size, 3, false, 1e10).seconds - before, 1 + 2 * 3 + 12, 1e-9);
}

// Where the active sets differ, each step takes the responses of its contact, and spectra on it.
TEST(RunCost, FollowsTheStepsOfTheContact) {
  RunSize size{.unknowns = 1e5, .modes = 100, .contactUnknowns = 1000};
  const auto seconds = [&](bool setsDiffer) { return runCost(size, 1, setsDiffer, 1e10).seconds; };
  const double same = seconds(false), different = seconds(true);
  size.followedSteps = 2;
  EXPECT_NEAR(seconds(true) - different, 2 * 5, 1e-9);  // 50 · 1000³ operations
  EXPECT_EQ(seconds(false), same);
  size.trackedSteps = 3;
  const double basis = 460;
  const double spectra = 3 * 2 * 30;  // three sets for 100 unknowns of the contact, at both ends
  EXPECT_NEAR(seconds(true) - different, 10 + spectra * 50 * basis * basis * basis / 1e10, 1e-9);
  EXPECT_EQ(seconds(false), same);
}

// With 3542 unknowns of the contact, 106 nodes are expected to change on a step.
TEST(RunCost, CountsNoStepWithMoreChangesThanAreFollowed) {
  EXPECT_EQ(followedSteps(6, 3542, 1000), 6);
  EXPECT_EQ(followedSteps(6, 3542, 20), 0);
  EXPECT_EQ(followedSteps(6, 100, 20), 6);
  EXPECT_EQ(followedSteps(6, 100, 0), 0);
  EXPECT_EQ(followedSteps(6, 0, 0), 0);
}

// Two groups or one: what was measured decides. Without tracking, a second group of a large model
// costs more than a larger basis. With it, the spectra of many sets between the points of a brake
// with many contact nodes cost more than a second group.
TEST(GroupWork, WeighsTheSizeOfTheBasisAgainstTheNumberOfGroups) {
  const auto ofSteps = [](int steps, double spectra) {
    return groupWork({.unknowns = 112674,
                      .modes = 200,
                      .points = steps + 1.0,
                      .activeSets = steps + 1.0,
                      .differing = 80.0 * steps,
                      .spectra = spectra * steps});
  };
  EXPECT_LT(ofSteps(2, 0), 2 * ofSteps(1, 0));
  EXPECT_LT(ofSteps(4, 1), ofSteps(2, 1) + ofSteps(2, 1));
  EXPECT_GT(ofSteps(4, 40), 2 * ofSteps(2, 40));
  // A single disc brake whose contact opens a little: one group.
  const auto ofDisc = [](double points, double sets) {
    return groupWork({.unknowns = 55000,
                      .modes = 200,
                      .points = points,
                      .activeSets = sets,
                      .differing = 4 * sets,
                      .spectra = 4 * sets});
  };
  EXPECT_LT(ofDisc(13, 5), ofDisc(7, 3) + ofDisc(7, 3));
}

// With -flutter_basis modal, the basis consists of the modes; with the sets of several points, it
// is twice as large as without.
TEST(RunCost, FollowsTheBasis) {
  // so many unknowns that the memory of dense matrices is negligible
  RunSize size{.unknowns = 1e8, .modes = 100, .points = 1};
  const auto bytesOfVectors = [&](bool setsDiffer) {
    return runCost(size, 1, setsDiffer, 1e10).bytes / (8 * 2.7 * size.unknowns * size.modes);
  };
  EXPECT_NEAR(bytesOfVectors(false), 2.3, 0.01);
  EXPECT_NEAR(bytesOfVectors(true), 4.6, 0.02);
  size.corrected = false;
  EXPECT_NEAR(bytesOfVectors(true), 1, 0.01);
}

TEST(DenseSpeed, IsThatOfAProcessor) {
  const double speed = denseSpeed(PETSC_COMM_WORLD);
  EXPECT_GT(speed, 1e8);   // also with sanitizers on a busy machine
  EXPECT_LT(speed, 1e13);  // more than any two cores reach
}

}  // namespace
}  // namespace squeal::analysis
