// SPDX-License-Identifier: BSD-2-Clause
// Layers in motion whose meshes do not match on the sliding surface, with the finer side and with
// the coarser one as slave: convergence of frequencies and growth rates to the exact waves, with
// convective terms and with friction damping.
#include <gtest/gtest.h>

#include "support/run/nonmatching_layers.hpp"

namespace squeal::test {
namespace {

/// The lowest waves of the moving layers in the plane at f = 0.5, on all unknowns.
void expectMovingOrder(double least, const std::string& slave, double ratio,
                       const std::string& coarse, const std::string& fine) {
  const auto found = [&](const std::string& mesh) {
    return nonMatchingErrors("two_layers_moving",
                             "-mesh_set " + mesh + " -contact_interface_slave " + slave +
                                 " -elasticity_mass consistent -flutter_friction 0.5"
                                 " -flutter_method direct -flutter_direct_count 24",
                             exactValues(exact::moving_layers::friction05, 12));
  };
  expectOrder(least, ratio, found(coarse), found(fine));
}

// Cells 2:3 and 7:5.
TEST(NonMatchingMovingLayers, SecondOrderWithQuad4) {
  for (const char* slave : {"pad", "disc"})
    expectMovingOrder(1.9, slave, 1.5, "order=1,nx=24,nx_pad=36,ny_disc=8,ny_pad=6",
                      "order=1,nx=36,nx_pad=54,ny_disc=12,ny_pad=9");
}

TEST(NonMatchingMovingLayers, FourthOrderWithQuad9) {
  for (const char* slave : {"pad", "disc"})
    expectMovingOrder(3.5, slave, 1.5, "order=2,nx=14,nx_pad=10,ny_disc=6,ny_pad=4",
                      "order=2,nx=21,nx_pad=15,ny_disc=9,ny_pad=6");
}

TEST(NonMatchingMovingSlabs, SecondOrderWithHex8) {
  for (const char* slave : {"pad", "disc"})
    expectSlabOrder(1.9, slave, true, "order=1,nx=16,nx_pad=24,ny_disc=6,ny_pad=6,nz=1,nz_pad=2",
                    "order=1,nx=24,nx_pad=36,ny_disc=9,ny_pad=9,nz=2,nz_pad=3");
}

// Faces with triangles: wedges of 18 nodes and tetrahedra of 10. Damping alone comes first.
TEST(NonMatchingMovingSlabs, FourthOrderWithTriangles) {
  expectFourthOrderOnSlabs("pad", false, "shape=3");
  expectFourthOrderOnSlabs("disc", true, "shape=0");
}

}  // namespace
}  // namespace squeal::test
