// SPDX-License-Identifier: BSD-2-Clause
// The rotating disc brake at its full size: the direct solve by PEP on 1, 2 and 3 ranks, and the
// reduced problem against it. Minutes, so not part of the usual run.
#include "support/harness/largest_error.hpp"
#include "support/harness/same_on_ranks.hpp"

namespace squeal::test {
namespace {

const std::string at =
    "-options_file options/disc_brake_rotating.yaml -flutter_friction 0.4 -flutter_speed 10 "
    "-report_fields off ";

std::vector<Complex> eigenvalues(const ProgramRun& run) {
  return eigenvaluesOf(readCsv(run.folder / "eigenvalues.csv"));
}

TEST(RotatingDiscBrake, SeventyEigenvaluesByPep) {
  std::vector<Complex> one;
  for (int ranks = 1; ranks <= 3; ++ranks) {
    const auto run = runProgram("rotating/pep" + std::to_string(ranks), ranks,
                                at + "-flutter_method direct -flutter_direct_count 70", 900);
    ASSERT_EQ(run.exitCode, 0) << run.error;
    const auto errorsFound = readCsv(run.folder / "eigenvalues.csv").column("backward_error");
    const double worstError = worst(errorsFound);
    const auto found = eigenvalues(run);
    std::printf("%d ranks: %zu eigenvalues, worst backward error %.1e\n", ranks, found.size(),
                worstError);
    EXPECT_GE(found.size(), 70U);
    EXPECT_LT(worstError, 1e-10);
    if (ranks == 1) one = found;
    EXPECT_EQ(found.size(), one.size());
    EXPECT_LT(worst(errors(one, found).relative),
              1e-9);  // backward errors of 1e-12 and moderate condition numbers
  }
  const auto run = runProgram("rotating/reduced", 2, at, 900);
  ASSERT_EQ(run.exitCode, 0) << run.error;
  double furthest = 0;
  for (const auto& s : one) furthest = worse(furthest, std::abs(s));
  std::vector<Complex> reduced;
  for (const auto& s : eigenvalues(run))
    if (std::abs(s) < (1 - 1e-6) * furthest) reduced.push_back(s);
  const double difference = worst(errors(reduced, one).relative);
  std::printf("reduced problem, %zu eigenvalues: %.1e from the direct ones\n", reduced.size(),
              difference);
  EXPECT_GT(reduced.size(), 40U);
  EXPECT_LT(
      difference,
      1e-7);  // corrected to backward errors of 1e-9; some ten times as much in s (measured 1.4e-8)
}

}  // namespace
}  // namespace squeal::test
