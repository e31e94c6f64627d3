// SPDX-License-Identifier: BSD-2-Clause
// The basis of the gaps on faces where nodal forces of a pressure are not positive.
#include "model/interfaces/gap_basis.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/harness/largest_error.hpp"
#include "support/model/contact_cases.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

/// A bar of 0.4 × 0.4 pressed by its end, one cell of 0.2 × 0.2 in four, with triangles of six
/// nodes or quadrilaterals of eight.
test::Model bar(bool triangles) {
  test::setOptions(
      "-mesh_file meshes/beam.geo -mesh_set Lx=1,Ly=0.4,Lz=0.4,nx=2,ny=2,nz=2,order=2," +
      std::string(triangles ? "recombine=0" : "serendipity=1") +
      test::material("beam", "1", "0.3", "1") +
      "-constraint_clamped_clamped xyz -contact_plate_pad tip -contact_plate_obstacle_velocity "
      "0,1,0");
  return test::buildModel();
}

/// The sums over the faces of ∫ φ̃ dA on affine faces of these areas, at the nodes of this rank, by
/// global node: 2/15 and 1/5 of a triangle for corners and middles, 1/20 and 1/5 of a
/// parallelogram.
std::map<PetscInt, double> exactAreas(const mesh::Mesh& mesh) {
  std::vector<double> all(static_cast<std::size_t>(mesh.totalNodes), 0.0);
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const bool triangle = block.nodesPerFace == 6;
      for (int i = 0; i < block.nodesPerFace; ++i)
        all[mesh.globalNode[block.nodesOf(e)[i]]] +=
            triangle ? 0.02 * (i < 3 ? 2.0 / 15 : 0.2) : 0.04 * (i < 4 ? 0.05 : 0.2);
    }
  check(MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM,
                      PETSC_COMM_WORLD));
  std::map<PetscInt, double> mine;
  for (PetscInt i = 0; i < mesh.ownedNodes; ++i) mine[mesh.firstNode + i] = all[mesh.firstNode + i];
  return mine;
}

TEST(GapBasis, IntegralsArePositive) {
  for (const bool triangles : {true, false}) {
    const test::Model model = bar(triangles);
    const auto exact = exactAreas(*model.mesh);
    double sum = 0;
    for (const auto& node : model.contact.interfaces.nodes) {
      EXPECT_NEAR(node.area, exact.at(node.globalNode), 1e-12);  // gmsh places nodes to 1e-11
      sum += node.area;
    }
    EXPECT_NEAR(test::total(sum), 0.16, 1e-12);
    EXPECT_EQ(model.contact.interfaces.totalNodes, triangles ? 25 : 21);
  }
}

// A linear gap is that of its coefficients, and E⁻¹ is the inverse of E. Forces at the nodes do the
// work of those of the coefficients.
TEST(GapBasis, LinearGapsAndForces) {
  for (const bool triangles : {true, false}) {
    const test::Model model = bar(triangles);
    const auto& contact = model.contact;
    std::vector<double> linear, any, force;
    for (const auto& node : contact.interfaces.nodes) {
      linear.push_back(0.3 + 0.7 * node.position[1] - 1.1 * node.position[2]);
      any.push_back(std::sin(40 * node.position[1] + 70 * node.position[2]));
      force.push_back(std::cos(30 * node.position[1] - 50 * node.position[2]));
    }
    const auto gap = contact.nodalGap(linear), there = contact.nodalGap(any),
               back = contact.gapCoefficients(there), nodal = contact.nodalForce(force);
    double work = 0, nodalWork = 0;
    for (std::size_t i = 0; i < linear.size(); ++i) {
      EXPECT_NEAR(gap[i], linear[i], 1e-10);  // so are the middles of edges placed
      EXPECT_NEAR(back[i], any[i], 1e-14);
      work += force[i] * any[i], nodalWork += nodal[i] * there[i];
    }
    EXPECT_NEAR(test::total(nodalWork), test::total(work), 1e-13);
  }
}

// Linear faces and those with a node in the middle have positive integrals as they are.
TEST(GapBasis, OtherFacesHaveNone) {
  test::contact_cases::setLayers();
  EXPECT_FALSE(test::buildModel().contact.interfaces.gapBasis);
}

}  // namespace
}  // namespace squeal
