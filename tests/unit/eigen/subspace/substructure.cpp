// SPDX-License-Identifier: BSD-2-Clause
// One basis for several active sets: each has constraint modes of its own gaps, and its eigenvalues
// and the number of its free modes are those of a system in which just these gaps are open.
#include "eigen/subspace/substructure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "algebra/linalg/spread.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/concatenation.hpp"
#include "eigen/reduction/reduced.hpp"
#include "problem/terms/terms.hpp"
#include "run/analysis/mesh_sweep.hpp"
#include "support/algebra/blocks.hpp"
#include "support/algebra/dense.hpp"
#include "support/eigen/full_problem.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal {
namespace {

using Nodes = std::vector<unsigned char>;

/// The two layers with 12 contact nodes, of which those at x = 1, 1.25, …, 2 are open in some sets.
struct Fixture : test::Layers {
  std::unique_ptr<contact::CoupledSystem> all;
  std::unique_ptr<reduction::ReducedProblem> reduced;
  std::unique_ptr<pencil::Pencil> terms;
  subspace::Substructure substructure;

  Fixture() : Layers("-modes_count 60 -mesh_set nx=12,ny_disc=4,ny_pad=3") {
    const auto free = modes();
    all = std::make_unique<contact::CoupledSystem>(model.bodies, model.contact,
                                                   contact::ActiveSet{closedBut(0.9, 2.1), {}});
    terms = std::make_unique<pencil::Pencil>(terms::affineTerms(model.contact, *all));
    substructure = analysis::substructureOf(*all, *system);
    reduced = std::make_unique<reduction::ReducedProblem>(
        *terms, *system, free, reduction::Settings::given(pencil::Settings::given()), substructure);
  }

  /// The nodes outside of this range of x.
  Nodes closedBut(double from, double to) const {
    Nodes closed;
    for (const auto& node : model.contact.interfaces.nodes)
      closed.push_back(!(node.position[0] > from && node.position[0] < to));
    return closed;
  }

  /// Returns the friction terms of the nodes that slide if those in this range are open, but not if
  /// all are.
  std::vector<pencil::Term> slidingTerms(double from, double to) const {
    Nodes slides = closedBut(from, to);
    for (std::size_t i = 0; i < slides.size(); ++i) slides[i] = slides[i] && !all->closed()[i];
    return terms::slidingTerms(model.contact, *all, slides);
  }

  /// Returns the boundary unknowns of the set with open nodes in this range.
  Nodes boundaryOf(double from, double to) const {
    const Nodes closed = closedBut(from, to);
    Nodes mine;
    const int dimension = model.mesh->dimension;
    for (const PetscInt k : substructure.boundary)
      for (std::size_t i = 0; i < closed.size(); ++i)
        if (model.contact.interfaces.nodes[i].node == all->transformation().rows[k] / dimension)
          mine.push_back(!closed[i]);
    return concatenated(model.mesh->comm, mine);
  }

  /// Adds the set with open nodes in this range.
  int add(double from, double to, pencil::Pencil& own) {
    own.add(slidingTerms(from, to));
    return reduced->addSet(own, boundaryOf(from, to));
  }

  /// Adds the same set as one that contains no point.
  int addPassed(double from, double to) {
    const Nodes closed = closedBut(from, to);
    Nodes mine;
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (!all->closed()[i]) mine.push_back(closed[i]);
    const Nodes slides = concatenated(model.mesh->comm, mine);
    std::vector<PetscInt> rows;
    for (std::size_t i = 0; i < slides.size(); ++i)
      if (slides[i]) rows.push_back(i);
    return reduced->addPassedSet(
        [=, this] {
          pencil::Pencil own = terms->with({});
          own.add(slidingTerms(from, to));
          return own;
        },
        boundaryOf(from, to), rows);
  }
};

const std::vector<std::pair<double, double>> ranges{{0, 0}, {0.9, 1.6}, {1.6, 2.1}, {0.9, 2.1}};

// Against the problem of all 156 unknowns and more, solved by LAPACK. Corrections stop at 1e-8; the
// estimate includes what is left.
TEST(Substructure, EigenvaluesAreThoseOfEachActiveSet) {
  Fixture f;
  EXPECT_EQ(f.reduced->basis().boundarySize(), 5);
  for (const auto& [from, to] : ranges) {
    pencil::Pencil own = f.terms->with({});
    const int set = f.add(from, to, own);
    std::vector<reduction::PointProblem> batch;
    for (const double friction : {0.0, 0.3, 0.6}) batch.push_back({{friction}, own.with({}), set});
    const auto points = f.reduced->solve(batch, f.all->transformation().trial);
    const contact::CoupledSystem single(f.model.bodies, f.model.contact,
                                        {f.closedBut(from, to), {}});
    const auto whole = terms::affineTerms(f.model.contact, single);
    for (const auto& point : points) {
      std::vector<Complex> exact;
      for (const auto& pair :
           linalg::solveTogether(whole.comm(), test::fullProblem(whole, point.at)))
        if (std::abs(pair.s) <= point.bandTop) exact.push_back(pair.s);
      const auto found = test::eigenvaluesOf(point);
      EXPECT_EQ(found.size(), exact.size());
      const auto match = test::matched(found, exact);
      double worst = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double error = std::abs(found[i] - match[i]) / std::abs(match[i]);
        // LAPACK's rounding grows with the norm of the matrices, some 1e-12 of the lowest s.
        EXPECT_LT(error, 2 * point.eigenvalues[i].errorEstimate() + 1e-11);
        EXPECT_TRUE(point.eigenvalues[i].certified);
        worst = test::worse(worst, error);
      }
      test::print("open from %g to %g, friction %g: %zu eigenvalues to %.1e, estimated %.1e\n",
                  from, to, point.at.friction, found.size(), worst, point.worstErrorEstimate());
    }
  }
}

// A set that contains no point has its friction terms from factors with one row per node.
// Projected, they are those of the matrices, within round-off, before and after the basis grows.
TEST(Substructure, PassedSetsHaveTheFrictionOfTheirNodes) {
  Fixture f;
  Nodes released = f.all->closed();
  for (auto& node : released) node = !node;
  f.reduced->setFactors(terms::frictionFactors(f.model.contact, *f.all, released));
  const sweep::Parameters at{0.7};
  std::vector<std::pair<int, int>> sets;
  std::vector<pencil::Pencil> pencils;
  for (const auto& [from, to] : ranges) {
    pencils.push_back(f.terms->with({}));
    const int ofPoints = f.add(from, to, pencils.back());
    sets.emplace_back(ofPoints, f.addPassed(from, to));
  }
  const auto compare = [&] {
    double friction = 0;
    for (const auto& [ofPoints, passed] : sets) {
      const auto one = f.reduced->project(at, ofPoints), two = f.reduced->project(at, passed);
      ASSERT_EQ(one.order(), two.order());
      for (const auto matrix : {&linalg::DenseProblem::stiffness, &linalg::DenseProblem::mass}) {
        const auto &a = one.*matrix, &b = two.*matrix;
        const double scale = std::sqrt(linalg::squaredLength(a.entries()));
        for (PetscInt j = 0; j < a.columns(); ++j)
          for (PetscInt i = 0; i < a.rows(); ++i) EXPECT_NEAR(a(i, j), b(i, j), 1e-13 * scale);
      }
      friction = std::max(friction, std::abs(one.stiffness(0, 1) - one.stiffness(1, 0)));
    }
    EXPECT_GT(friction, 1e-3);  // the terms are not small beside K0 = 1
  };
  compare();
  const PetscInt before = f.reduced->basisSize();
  std::vector<reduction::PointProblem> batch;
  batch.push_back({at, pencils[1].with({}), sets[1].first});
  f.reduced->solve(batch, f.all->transformation().trial);
  EXPECT_GT(f.reduced->basisSize(), before);
  compare();
}

// Free modes of each set, and their number up to the top of the band, against LAPACK.
TEST(Substructure, FreeModesAreCountedWithoutAnotherFactorisation) {
  Fixture f;
  for (const auto& [from, to] : ranges) {
    pencil::Pencil own = f.terms->with({});
    const int set = f.add(from, to, own);
    const modes::Modes modes = std::move(f.reduced->freeModes({set}, *f.terms).front());
    EXPECT_TRUE(modes.countConfirmed);
    const contact::CoupledSystem single(f.model.bodies, f.model.contact,
                                        {f.closedBut(from, to), {}});
    linalg::DenseMatrix stiffness = test::denseCopy(single.k0()),
                        mass = test::denseCopy(single.m0());
    const auto exact = linalg::symmetricEigen(stiffness, mass);
    ASSERT_LT(modes.lambda.size(), exact.size());
    EXPECT_GT(exact[modes.lambda.size()], std::pow(f.reduced->band().top, 2));
    for (std::size_t i = 0; i < modes.lambda.size(); ++i) {
      EXPECT_NEAR(modes.lambda[i], exact[i], 2e-8 * exact[i]);
      EXPECT_LT(modes.relativeResidual[i], 1e-3);  // its square is the error, in another norm
    }
  }
}

// Below any frequency: a number that is given is right, and it is given except next to a mode,
// where the bounds of what the modes leave out are too wide. The bound that needs no solve is
// wider.
TEST(Substructure, NumberOfModesBelowAnyFrequency) {
  Fixture f;
  const auto free = f.modes();
  ASSERT_TRUE(free.countConfirmed);
  subspace::Basis basis(free, *f.system, f.substructure);
  linalg::Block inertia(basis.localRows());
  linalg::appendProduct(f.all->m0(), basis.columns(), inertia);
  const subspace::ModeCount rough(
      basis, free, linalg::transposedProduct(basis.comm(), basis.columns(), inertia));
  subspace::ModeCount sharp = rough;
  EXPECT_FALSE(rough.isSharp());
  sharp.sharpen(basis, f.all->m0());
  EXPECT_TRUE(sharp.isSharp());
  EXPECT_EQ(basis.solves(), 2 * basis.boundarySize());      // constraint modes, and their responses
  EXPECT_FALSE(sharp.below(1.01 * free.inertiaShift, {}));  // above what is known of the interior
  std::vector<PetscInt> own;
  int known = 0, roughlyKnown = 0, asked = 0;
  for (PetscInt open = 0; open <= basis.boundarySize(); ++open) {
    if (open > 0) own.push_back(open - 1);
    // The unknowns of this set: those of the interior and the gaps in question, in their place.
    const linalg::DenseMatrix allStiffness = test::denseCopy(f.all->k0()),
                              allMass = test::denseCopy(f.all->m0());
    std::vector<PetscInt> first, rows = f.substructure.boundary;
    PetscInt begin = 0;
    check(MatGetOwnershipRange(f.all->k0(), &begin, nullptr));
    for (PetscInt& row : rows) row += begin;
    const auto gaps = concatenated(f.model.mesh->comm, rows);
    for (PetscInt row = 0; row < allMass.rows(); ++row) {
      const auto gap = std::ranges::find(gaps, row) - gaps.begin();
      if (gap >= open) {
        if (gap == std::ssize(gaps)) first.push_back(row);
      } else {
        first.push_back(row);
      }
    }
    const PetscInt n = std::ssize(first);
    linalg::DenseMatrix stiffness(n, n), mass(n, n);
    for (PetscInt j = 0; j < n; ++j)
      for (PetscInt i = 0; i < n; ++i) {
        stiffness(i, j) = allStiffness(first[i], first[j]);
        mass(i, j) = allMass(first[i], first[j]);
      }
    const auto exact = linalg::symmetricEigen(stiffness, mass);
    for (double part = 0.013; part < 0.8; part += 0.013) {
      const double sigma = part * free.inertiaShift;
      const auto exactCount =
          std::ranges::count_if(exact, [&](double value) { return value < sigma; });
      ++asked;
      if (const auto found = rough.below(sigma, own)) {
        ++roughlyKnown;
        EXPECT_EQ(*found, exactCount);
      }
      if (const auto found = sharp.below(sigma, own)) {
        ++known;
        EXPECT_EQ(*found, exactCount);
      }
    }
  }
  test::print("%d of %d numbers known, %d of them without solves\n", known, asked, roughlyKnown);
  EXPECT_GT(known, 0.8 * asked);
  EXPECT_GT(roughlyKnown, 0.4 * asked);
  EXPECT_LT(roughlyKnown, known);
}

}  // namespace
}  // namespace squeal
