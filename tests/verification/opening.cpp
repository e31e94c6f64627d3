// SPDX-License-Identifier: BSD-2-Clause
// Contact that opens along one end, on all shapes of cells of second order, with meshes that match
// and with meshes that do not: equilibrium, and convergence to a fine mesh of quad9 cells.
#include <gtest/gtest.h>

#include <cmath>

#include "model/contact/coupled.hpp"
#include "steady/condensed/condensed_problem.hpp"
#include "steady/steady/steady.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

// A pad with free ends, guided along x at its top, which a pressure P loads, is dragged along x by
// friction on the disc, or on a rigid plate, at a distance H below. Statics gives the centre of
// pressure, L/2 − f H. Where it is beyond a sixth of the length, the trailing end opens.
constexpr double friction = 0.35;

/// The pad on a disc, or a block under a plate, in the plane or as slabs held along z.
struct Block {
  std::string plane, slabs, options;
  std::string pad;         ///< body that opens
  double height, surface;  ///< H; y of the contact
};

const Block onDisc{"meshes/two_layers.geo -mesh_set Lx=1,h_disc=0.5,h_pad=0.8,",
                   "meshes/two_slabs.geo -constraint_disc_clamped z -constraint_pad_clamped z"
                   " -mesh_set Lx=1,h_disc=0.5,h_pad=0.8,",
                   " -motion_disc_velocity 1,0,0 -constraint_disc_bottom_clamped xy"
                   " -constraint_pad_top_clamped x -load_pad_top_pressure 0.01"
                   " -contact_interface_pad pad_face -contact_interface_disc disc_face" +
                       material("disc", "1", "0.3", "1") + material("pad", "0.4", "0.25", "0.6"),
                   "pad",
                   0.8,
                   0};

const Block underPlate{
    "meshes/layer.geo -mesh_set Lx=1,h=1,",
    "meshes/layer_slab.geo -constraint_layer_clamped z -mesh_set Lx=1,h=1,",
    " -constraint_bottom_clamped x -load_bottom_pressure 0.01 -contact_plate_pad top"
    " -contact_plate_obstacle_velocity 1,0,0" +
        material("layer", "1", "0.3", "1"),
    "layer",
    1,
    0};

/// What is compared between meshes. The displacement is that of the pad's trailing edge.
struct Answer {
  double centre = 0, openLength = 0, along = 0, normal = 0;
};

/// Collective. Returns the mean displacement of the nodes of the pad at x = 1 on the contact.
std::array<double, 2> trailingEdge(const Block& block, const Model& model, Vec displacement) {
  const auto& mesh = *model.mesh;
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(displacement, &values));
  double along = 0, normal = 0, count = 0;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    const auto& x = mesh.coordinates[node];
    if (mesh.partName[mesh.nodePart[node]] != block.pad || std::abs(x[0] - 1) > 1e-9 ||
        std::abs(x[1] - block.surface) > 1e-9)
      continue;
    along += values[mesh.dimension * node], normal += values[mesh.dimension * node + 1], ++count;
  }
  check(VecRestoreArrayRead(displacement, &values));
  count = total(count);
  return {total(along) / count, total(normal) / count};
}

/// Collective. `cells` are parameters of the mesh, and options may follow them.
Answer solve(const Block& block, bool slabs, const std::string& cells) {
  setOptions("-mesh_file " + (slabs ? block.slabs : block.plane) + cells + block.options);
  const auto model = buildModel();
  const contact::CoupledSystem system(
      model.bodies, model.contact,
      contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  const steady::Problem problem(*model.mesh, model.bodies, model.contact);
  const auto solution = condensed::CondensedProblem(problem, system).solve({.friction = friction});
  EXPECT_TRUE(solution.converged) << solution.reason;
  EXPECT_LT(solution.imbalance, 1e-8);
  double area = 0, open = 0, force = 0, moment = 0, dragged = 0, tension = 0, overlap = 0;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& node = model.contact.interfaces.nodes[i];
    const auto& state = solution.contact[i];
    area += node.wholeArea, open += solution.closed[i] ? 0 : node.wholeArea;
    force += state.normalForce, moment += state.normalForce * node.position[0];
    dragged += state.frictionForce[0];
    tension = worse(tension, -state.normalForce), overlap = worse(overlap, -state.coefficient);
  }
  force = total(force), area = total(area);
  EXPECT_LT(largest(tension), 1e-10 * force);
  EXPECT_LT(largest(overlap), 1e-12);  // of displacements of 0.06
  EXPECT_NEAR(total(dragged) / force, friction, 1e-9);
  const auto edge = trailingEdge(block, model, solution.displacement);
  const Answer answer{total(moment) / force, total(open) / area, edge[0], edge[1]};
  EXPECT_NEAR(answer.centre, 0.5 - friction * block.height, 1e-8);
  print("%s: %d steps, %d of %d open, centre %.10f, open length %.4f, trailing edge %.8e %.8e\n",
        cells.c_str(), solution.iterations, static_cast<int>(solution.openNodes),
        static_cast<int>(model.contact.interfaces.totalNodes), answer.centre, answer.openLength,
        answer.along, answer.normal);
  return answer;
}

/// `cells` on n cells along x: quadratic ones as high as they are long.
std::string numbered(const Block& block, const std::string& cells, int n) {
  const auto along = std::to_string(n), high = std::to_string(n / 2);
  return "order=2,nx=" + along +
         (block.pad == "pad" ? ",ny_disc=" + high + ",ny_pad=" + high : ",ny=" + along) + cells;
}

/// 64 cells of quad9 in the plane: its trailing edge moves by 2e-5 of the displacement with 128.
Answer fine(const Block& block) { return solve(block, false, numbered(block, "", 64)); }

/// The opening ends at a node, so that errors do not fall smoothly: they stay below bounds that
/// fall with the square of the size of the cells.
void expectConvergence(const Block& block, const Answer& exact, const std::string& cells,
                       const std::string& padAlone = "") {
  for (const int n : {8, 16}) {
    const std::string pad =
        padAlone.empty() ? "" : ",nx_pad=" + std::to_string(3 * n / 2) + ",nz_pad=2" + padAlone;
    const Answer found = solve(block, true, numbered(block, "," + cells + pad, n));
    EXPECT_NEAR(found.openLength, exact.openLength, 1.0 / n);
    EXPECT_NEAR(found.along / exact.along, 1, 0.32 / (n * n));
    EXPECT_NEAR(found.normal / exact.normal, 1, 0.9 / (n * n));
  }
}

// hex20, wedge15 with triangles on the sides or on the contact, and tet10.
TEST(Opening, OnMatchingDisc) {
  const Answer exact = fine(onDisc);
  for (const char* shape :
       {"shape=1,serendipity=1", "shape=2,serendipity=1", "shape=3,serendipity=1", "shape=0"})
    expectConvergence(onDisc, exact, shape);
}

// Two cells of the disc face three of the pad, and one faces two along z.
TEST(Opening, OnDiscMeshedApart) {
  const Answer exact = fine(onDisc);
  const std::string slave = " -contact_interface_slave ";
  expectConvergence(onDisc, exact, "shape=1", slave + "pad");
  expectConvergence(onDisc, exact, "shape=1,serendipity=1", slave + "disc");
  expectConvergence(onDisc, exact, "shape=3,serendipity=1", slave + "pad");
  for (const char* side : {"pad", "disc"})
    expectConvergence(onDisc, exact, "shape=0", slave + side);
}

TEST(Opening, TetrahedraUnderPlate) { expectConvergence(underPlate, fine(underPlate), "shape=0"); }

}  // namespace
}  // namespace squeal::test
