// SPDX-License-Identifier: BSD-2-Clause
// What the reduced problem is made of: where its band ends, the responses it begins with, the
// projections of its terms.
#include "eigen/reduction/reduced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algebra/linalg/block.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/band.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "problem/terms/terms.hpp"
#include "run/report/stability_table.hpp"
#include "support/algebra/blocks.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/quadratic.hpp"
#include "support/algebra/symmetric.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal {
namespace {

struct Fixture : test::Layers {
  pencil::Pencil pencil;
  modes::Modes free;
  reduction::ReducedProblem reduced;
  explicit Fixture(const std::string& options)
      : Layers(options),
        pencil(terms::affineTerms(model.contact, *system)),
        free(modes()),
        reduced(pencil, *system, free, reduction::Settings::given(pencil::Settings::given())) {}

  std::vector<pencil::ComplexModes> solve(double friction) {
    std::vector<reduction::PointProblem> batch;
    batch.push_back({{friction}, pencil.with({})});
    return reduced.solve(batch, system->transformation().trial);
  }
};

// Modes at 1, 2, … rad/s, some of them double. 2π Hz asked for are cut where the free modes end:
// between the last two that are not double.
TEST(Band, EndsBetweenFreeModes) {
  const auto end = [](const std::string& hertz, const std::vector<double>& w) {
    test::setOptions(hertz.empty() ? "" : "-flutter_band " + hertz);
    return pencil::bandBelow(w, pencil::Settings::given().band.top);
  };
  const std::vector<double> single{1, 2, 3, 4, 5, 6, 7, 8, 9, 10},
      paired{1, 1, 2, 2, 3, 3, 3 + 1e-9, 4, 5, 5};
  EXPECT_EQ(end("", single), 6.5);  // 0.55 of ten is five: between the sixth and the next
  EXPECT_EQ(end("", paired), 3.5 + 5e-10);
  EXPECT_DOUBLE_EQ(end("1", single), 2 * M_PI);
  EXPECT_EQ(end("1.55", single), 9.5);  // 9.74 rad/s: above the middle of the last two
  EXPECT_EQ(end("100", single), 9.5);
  EXPECT_EQ(end("100", paired), 4.5);
  EXPECT_EQ(end("100", {3, 3, 3}), 3 * (1 + 1e-4));
  EXPECT_EQ(end("", {3}), 3 * (1 + 1e-4));
  EXPECT_EQ(end("", {3, 5}), 4);
}

TEST(Band, TheReportSaysThatTheFreeModesEndBelow) {
  const std::string options =
                        "-mesh_set nx=6,ny_disc=2,ny_pad=2 -modes_count 15 -steady_uniqueness off "
                        "-flutter_friction 0.2 ",
                    words = "The free modes end below the 1000 Hz of -flutter_band";
  for (const bool above : {false, true}) {
    const analysis::Analysis analysis =
        test::runCase("two_layers", options + (above ? "-flutter_band 1000" : "-flutter_band 0.3"));
    const auto& point = analysis.flutter.segments.at(0).points.at(0);
    EXPECT_LT(point.bandTop, analysis.flutter.segments.at(0).modes.angularFrequency.back());
    EXPECT_EQ(report::stabilityTable(analysis).find(words) != std::string::npos, above);
  }
}

/// Σ (iω)^power A φ, or Aᵀ φ, over the terms A of friction, for modes φ at their angular
/// frequencies ω; without damping real.
linalg::Block frictionForces(const pencil::Pencil& pencil, const linalg::Block& modes,
                             const std::vector<double>& frequencies, bool transposed) {
  linalg::Block sum(modes.rows(), modes.columns());
  for (const auto& term : pencil.terms()) {
    if (term.frictionExponent == 0) continue;
    EXPECT_NE(term.power, 1);
    const linalg::Block image =
        transposed ? test::timesTransposed(term.matrix, modes) : test::times(term.matrix, modes);
    for (PetscInt j = 0; j < modes.columns(); ++j)
      for (PetscInt i = 0; i < modes.rows(); ++i)
        sum(i, j) += (term.power == 0 ? 1 : -std::pow(frequencies[j], 2)) * image(i, j);
  }
  return sum;
}

// K0⁻¹ r for the forces of friction r = k φ and kᵀφ, of unit length, on the modes of the band: the
// basis holds them except for K0⁻¹ r' with r' of length 0.03 at most, whose energy is that squared
// over the lowest eigenvalue of K0 at most.
TEST(StaticResponses, AreHeldByTheBasis) {
  Fixture f("-modes_count 40 -flutter_rounds 0");
  const linalg::Block before = f.reduced.basis().columns();
  const double top = f.solve(0.5).at(0).bandTop;
  const linalg::Block after = f.reduced.basis().columns();
  const double bound =
      0.03 / std::sqrt(linalg::symmetricEigenvalues(test::denseCopy(f.system->k0())).front());
  linalg::Block modes(before.rows());
  for (PetscInt j = 0; f.free.angularFrequency[j] < top; ++j) modes.append(before.column(j));
  ASSERT_GT(modes.columns(), 20);
  for (const bool transposed : {false, true}) {
    const linalg::Block forces = linalg::unitColumns(
        f.pencil.comm(), frictionForces(f.pencil, modes, f.free.angularFrequency, transposed));
    const double known = test::energyOutside(*f.system, after, forces),
                 unknown = test::energyOutside(*f.system, before, forces);
    test::print("%s: outside of the basis %.2e, of the modes alone %.2e; bound %.2e\n",
                transposed ? "left" : "right", known, unknown, bound);
    EXPECT_LT(known, bound);
    EXPECT_GT(unknown, 2 * bound);  // else the bound says nothing
  }
}

// Springs of 1e16 under the face of the disc, whose own stiffness is of the order of one, determine
// the norm of K and thereby the scale of backward errors. A backward error below 1e-14 then says
// little about the eigenvalue: at some pairs the estimate of the error is more than 1e6 times as
// large, so that it would exceed the tolerance at that backward error. Corrections must go on.
TEST(StiffSprings, DoNotEndTheCorrections) {
  Fixture f("-modes_count 40 -ground_disc_face_stiffness 0,1e16,0");
  const auto points = f.solve(0.5);
  ASSERT_GT(points.at(0).eigenvalues.size(), 20u);
  double worst = 0, ratio = 0;
  for (const auto& e : points.at(0).eigenvalues) {
    worst = std::max(worst, e.errorEstimate());
    ratio = std::max(ratio, e.errorEstimate() / e.backwardError);
    EXPECT_TRUE(e.certified) << e.s;
  }
  test::print("estimates up to %.2e, and up to %.2e times the backward error\n", worst, ratio);
  EXPECT_LE(worst, 1e-8);  // -flutter_tolerance
  EXPECT_GT(ratio, 1e6);   // else the case does not show it
}

// Of a point that has been solved, those who ask again get the eigenvalues of its band, and around
// them others up to 1.3 of its top. In the basis that a second point has made larger, the pairs of
// the band still solve the problem to what the basis has gained, the certified error.
TEST(KnownPairs, AreThoseOfThePoint) {
  Fixture f("-modes_count 40");
  const auto point = f.solve(0.3);
  const auto& first = point.at(0);
  const auto basis = f.reduced.basisSize();
  f.solve(0.6);
  ASSERT_GT(f.reduced.basisSize(), basis);
  auto pairs = f.reduced.watchedPairs({0.3}, 0);
  ASSERT_TRUE(pairs);
  EXPECT_FALSE(f.reduced.watchedPairs({0.4}, 0));
  const auto problem = f.reduced.project({{0.3}, f.pencil.with({})});
  std::size_t inBand = 0;
  for (auto& pair : *pairs) {
    EXPECT_LE(std::abs(pair.s), 1.3 * first.bandTop);
    if (!f.reduced.band().contains(pair.s)) continue;
    EXPECT_EQ(pair.s, first.eigenvalues.at(inBand++).s);
    pair.q.resize(problem.order());
    EXPECT_LT(test::residual(problem, pair), first.accuracy) << pair.s;
  }
  EXPECT_EQ(inBand, first.eigenvalues.size());
  EXPECT_GT(pairs->size(), inBand);
}

// Eighty modes: the projections of symmetric terms are made in two blocks, and half of them by
// symmetry.
TEST(Projection, IsThatOfTheTerms) {
  Fixture f("-modes_count 80 -flutter_rounds 2 -flutter_band 0.5");
  f.solve(0.5);
  const auto& v = f.reduced.basis().columns();
  ASSERT_GT(v.columns(), 80);
  const auto projected = f.reduced.project({{0.5}, f.pencil.with({})});
  for (const int power : {0, 2}) {
    const OwnedMat whole = f.pencil.assembled(power, {0.5});
    const auto wanted = linalg::transposedProduct(f.pencil.comm(), v, test::times(whole, v));
    const auto& found = power == 0 ? projected.stiffness : projected.mass;
    const double worst = test::largestDifference(found, wanted),
                 largest = test::largestEntry(wanted);
    test::print("s^%d: entries differ by %.1e of the largest\n", power, worst / largest);
    EXPECT_LT(worst, 1e-11 * largest);  // rounding of the solves for K0 z where that is known
                                        // without products, otherwise of sums
  }
}

}  // namespace
}  // namespace squeal
