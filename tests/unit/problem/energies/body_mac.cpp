// SPDX-License-Identifier: BSD-2-Clause
// The MAC of bodies in known motions.
#include "problem/energies/body_mac.hpp"

#include <gtest/gtest.h>

#include "base/petsc/arrays.hpp"
#include "problem/energies/own_modes.hpp"
#include "support/model/model.hpp"

namespace squeal::test {
namespace {

using mesh::Point;

// Motions along x and along y are orthogonal in each body. A complex motion x + 2i y has 1/5 of its
// energy along x and 4/5 along y, whatever the scale and the sign of the free mode; a motion that
// leaves the body at rest has no MAC.
TEST(BodyMac, ComparesEachBodyByItself) {
  setOptions("-mesh_file meshes/two_layers.geo -mesh_set nx=4,ny_disc=2,ny_pad=2" +
             material("disc", "1", "0.3", "1") + material("pad", "2", "0.3", "3"));
  const mesh::Mesh mesh = readMesh();
  const elasticity::Bodies bodies = assembleBodies(mesh);
  ASSERT_EQ(mesh.bodies.size(), 2u);
  const energies::BodyMac mac(mesh, bodies, energies::nodesOfBodies(mesh));
  const OwnedVec x = nodalField(mesh,
                                [](const Point&) {
                                  return Point{1, 0, 0};
                                }),
                 y = nodalField(mesh,
                                [](const Point&) {
                                  return Point{0, 2, 0};
                                }),
                 opposite = nodalField(mesh, [](const Point&) {
                   return Point{-3, 0, 0};
                 });
  const OwnedVec none = nodalField(mesh, [](const Point&) { return Point{0, 0, 0}; });
  const ReadArray ofX(x), ofY(y), ofOpposite(opposite), ofNone(none);
  const auto all = mac.of(
      {ofX.data(), ofY.data()},
      {std::span(ofX.begin(), ofX.end()), std::span(ofY.begin(), ofY.end()),
       std::span(ofOpposite.begin(), ofOpposite.end()), std::span(ofNone.begin(), ofNone.end())});
  for (std::size_t body = 0; body < 2; ++body) {
    EXPECT_NEAR(all[0][body], 0.2, 1e-14);
    EXPECT_NEAR(all[1][body], 0.8, 1e-14);
    EXPECT_NEAR(all[2][body], 0.2, 1e-14);
    EXPECT_EQ(all[3][body], 0);
  }
}

}  // namespace
}  // namespace squeal::test
