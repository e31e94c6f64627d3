// SPDX-License-Identifier: BSD-2-Clause
// Lemke's method against the solutions of steady sliding in all unknowns.
#include "steady/condensed/pivots.hpp"

#include <gtest/gtest.h>

#include <string>

#include "steady/condensed/condensed_problem.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"
#include "support/steady/condensed_contact.hpp"
#include "support/steady/pressed_block.hpp"

namespace squeal::test {
namespace {

void expectTheSolution(const std::string& options, double friction, PetscInt open) {
  Condensed condensed(options);
  std::vector<double> gaps(condensed.model.contact.interfaces.nodes.size(), 0.0);
  ASSERT_TRUE(condensed::pivotGaps(condensed.solver, condensed.model.contact,
                                   condensed.contactCase(friction), gaps));
  const auto full = condensed.problem.solve({friction}, condensed.closed);
  ASSERT_TRUE(full.converged) << full.reason;
  EXPECT_EQ(full.openNodes, open);
  double size = 0, error = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    EXPECT_EQ(gaps[i] > 0, full.closed[i] == 0);
    size = worse(size, full.contact[i].coefficient);
    error = worse(error, std::abs(gaps[i] - full.contact[i].coefficient));
  }
  size = largest(size), error = largest(error);
  print("%d of %d nodes open, gaps to %.1e\n", static_cast<int>(open),
        static_cast<int>(condensed.model.contact.interfaces.totalNodes),
        size > 0 ? error / size : 0);
  EXPECT_LE(error, 1e-9 * size);  // the full solution is accurate to 1e-11 of the loads
}

TEST(Pivots, NodesThatFrictionLifts) { expectTheSolution(pressedBlock, 0.5, 3); }

// The frictionless path of pivots keeps the nodes of an interface that does not separate closed.
TEST(Pivots, NodesThatDoNotSeparateStayClosed) {
  expectTheSolution(floatingPad + " -contact_main_separation off -contact_other_separation off", 0,
                    0);
}

TEST(Pivots, ClosedContactNeedsNone) { expectTheSolution(pressedBlock, 0, 0); }

TEST(Pivots, PadHeldByTheContactAlone) {
  for (double friction : {0.0, 0.3}) expectTheSolution(floatingPad, friction, 3);
}

// The pressure pulls the pad away from the disc. The path goes on for ever.
TEST(Pivots, NoSolutionWhereThePadIsPulledOff) {
  Condensed condensed(floatingPad + " -load_second_y0_part_pressure -8e6");
  std::vector<double> gaps(condensed.model.contact.interfaces.nodes.size(), 0.25);
  EXPECT_FALSE(condensed::pivotGaps(condensed.solver, condensed.model.contact,
                                    condensed.contactCase(0), gaps));
  for (double gap : gaps) EXPECT_EQ(gap, 0.25);
}

}  // namespace
}  // namespace squeal::test
