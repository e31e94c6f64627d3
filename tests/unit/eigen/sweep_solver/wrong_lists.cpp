// SPDX-License-Identifier: BSD-2-Clause
// The proof finds lists that lack an eigenvalue or contain a wrong one; their points are solved
// again.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "eigen/sweep_solver/sweep_solver.hpp"
#include "problem/terms/terms.hpp"
#include "support/harness/ranks.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal::test {
namespace {

using sweep_solver::SolvedSweep;

/// How the proofs are made.
enum class Proofs {
  together,  ///< of all points, with the factors of friction
  singly     ///< by the referee, point by point
};

/// A sweep over the friction between two layers. The list of one point is falsified the first
/// `times` times that it is solved.
class FalsifiedSweep : public sweep_solver::SweepProblem {
 public:
  using List = std::vector<pencil::Eigenvalue>;
  FalsifiedSweep(Proofs proofs, std::size_t point, int times, std::function<void(List&)> falsify)
      : proofs_(proofs), point_(point), times_(times), falsify_(std::move(falsify)) {
    system = layers_.system.get();
    trial = layers_.system->transformation().trial;
    pencil.emplace(terms::affineTerms(layers_.model.contact, *layers_.system));
    for (const double friction : {0.0, 0.2, 0.4}) steadyPoints.push_back({friction});
    ranges.push_back({.first = 0, .last = 3});
  }
  sweep_solver::RangeFactors frictionFactors() const override {
    if (proofs_ == Proofs::singly) return SweepProblem::frictionFactors();
    const std::size_t nodes = layers_.model.contact.interfaces.nodes.size();
    auto factors = terms::frictionFactors(layers_.model.contact, *layers_.system,
                                          std::vector<unsigned char>(nodes, 1));
    PetscInt rows = 0;
    check(MatGetSize(factors.slip.front().matrix, &rows, nullptr));
    std::vector<PetscInt> all(rows);
    std::iota(all.begin(), all.end(), 0);
    return {std::move(factors), {std::move(all)}};
  }
  void examine(std::size_t i, const pencil::Pencil&, const sensitivity::StartSpace&,
               pencil::ComplexModes& point) override {
    ++solved[i];
    if (i == point_ && times_-- > 0) falsify_(point.eigenvalues);
  }
  SolvedSweep solve() {
    checkpoint::Checkpoint none;
    sweep_solver::Request request{
        .settings = sweep_solver::Settings::given(pencil::Settings::given()), .dampings = {1}};
    return sweep_solver::solveSweep(*this, request, none, "sweep");
  }
  std::map<std::size_t, int> solved;  // how often each point has been

 private:
  Layers layers_{"-modes_count 40 -flutter_proof on -flutter_track on"};
  Proofs proofs_;
  std::size_t point_;
  int times_;
  std::function<void(List&)> falsify_;
};

/// Takes an eigenvalue out of a list, and moves another one.
void falsify(FalsifiedSweep::List& list) {
  ASSERT_GT(list.size(), 5U);
  list.erase(list.begin() + 3);
  list[4].s *= 1.01;
}

/// Takes out one of two equal eigenvalues: the layers are periodic, so that waves run both ways.
void takeOneOfTwo(FalsifiedSweep::List& list) {
  const auto equal = [](const auto& a, const auto& b) {
    return std::abs(a.s - b.s) < 1e-6 * std::abs(a.s);
  };
  const auto found = std::ranges::adjacent_find(list, equal);
  ASSERT_NE(found, list.end());
  list.erase(found);
}

std::vector<Complex> listOf(const pencil::ComplexModes& point) {
  std::vector<Complex> list;
  for (const auto& e : point.eigenvalues) list.push_back(e.s);
  return list;
}

class WrongLists : public testing::TestWithParam<Proofs> {};

/// Expects the eigenvalues of a sweep without wrong lists.
void expectRight(const SolvedSweep& found, Proofs proofs) {
  const auto expected = FalsifiedSweep(proofs, 0, 0, {}).solve();
  EXPECT_TRUE(found.failures.empty());
  ASSERT_EQ(found.segments.size(), 1U);
  ASSERT_EQ(found.segments[0].trackedLines.size(), 1U);
  EXPECT_EQ(found.segments[0].trackedLines[0].branches.count,
            expected.segments[0].trackedLines[0].branches.count);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto list = listOf(found.segments[0].points[i]),
               other = listOf(expected.segments[0].points[i]);
    ASSERT_EQ(list.size(), other.size());
    // Both are exact within -flutter_tolerance.
    for (std::size_t k = 0; k < list.size(); ++k)
      EXPECT_LE(std::abs(list[k] - other[k]), 2e-8 * std::abs(other[k]));
  }
}

TEST_P(WrongLists, AreSolvedAgain) {
  FalsifiedSweep sweep(GetParam(), 1, 1, falsify);
  const auto found = sweep.solve();
  EXPECT_EQ(sweep.solved, (std::map<std::size_t, int>{{0, 1}, {1, 2}, {2, 1}}));
  EXPECT_TRUE(found.segments[0].points[1].listIsProved());
  expectRight(found, GetParam());
}

// Equal eigenvalues have no discs of their own, so that none is proved to be missing.
TEST_P(WrongLists, RegainOneOfTwoEqualEigenvalues) {
  FalsifiedSweep sweep(GetParam(), 0, 1, takeOneOfTwo);
  const auto found = sweep.solve();
  EXPECT_EQ(sweep.solved, (std::map<std::size_t, int>{{0, 2}, {1, 1}, {2, 1}}));
  expectRight(found, GetParam());
}

TEST_P(WrongLists, AreReportedIfTheyRemainWrong) {
  FalsifiedSweep sweep(GetParam(), 1, 2, falsify);
  const auto found = sweep.solve();
  EXPECT_EQ(sweep.solved[1], 2);
  EXPECT_EQ(found.failures, (std::vector<std::string>{
                                "friction 0.2: the list lacks 2 eigenvalues of the full problem",
                                "friction 0.2: 1 values of the list are not eigenvalues of the "
                                "full problem"}));
  EXPECT_FALSE(found.segments[0].points[1].listIsProved());
  EXPECT_TRUE(found.segments[0].points[2].listIsProved());
}

INSTANTIATE_TEST_SUITE_P(Proofs, WrongLists, testing::Values(Proofs::together, Proofs::singly));

}  // namespace
}  // namespace squeal::test
