// SPDX-License-Identifier: BSD-2-Clause
// Names of motions, for displacement fields of known diameters and circles.
#include "problem/energies/body_motions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/model/model.hpp"

namespace squeal::test {
namespace {

using energies::NamedMotion;
using mesh::Point;

/// A mesh with one body, and the namer of its motions.
struct Named {
  mesh::Mesh mesh;
  elasticity::Bodies bodies;
  energies::BodyMotions motions;

  explicit Named(const std::string& options)
      : mesh((setOptions(options), readMesh())),
        bodies(assembleBodies(mesh)),
        motions(mesh, bodies, {ownNodes(mesh)}) {}
  static std::vector<PetscInt> ownNodes(const mesh::Mesh& mesh) {
    std::vector<PetscInt> nodes;
    for (PetscInt node = 0; node < mesh.ownedNodes; ++node) nodes.push_back(node);
    return nodes;
  }
  template <class Field>
  NamedMotion name(const Field& field) const {
    const OwnedVec u = nodalField(mesh, field);
    return motions.names({ReadArray(u).data()}).at(0);
  }
};

/// The motion with these components in cylindrical axes about z.
template <class Components>
auto cylindrical(const Components& components) {
  return [=](const Point& x) {
    const double angle = std::atan2(x[1], x[0]);
    const Point c = components(std::hypot(x[0], x[1]), angle, x[2]);
    return Point{c[0] * std::cos(angle) - c[1] * std::sin(angle),
                 c[0] * std::sin(angle) + c[1] * std::cos(angle), c[2]};
  };
}

const std::string ring =
    "-mesh_file meshes/ring.geo -material_ring_young 1 -material_ring_poisson 0.3 "
    "-material_ring_density 1 -mesh_set thickness=0.04,order=2,";

// The body at rest finds its own axis. On two meshes: names do not depend on them.
TEST(BodyMotions, HaveDiametersAndCircles) {
  for (const std::string fineness : {"n_theta=20,n_r=2", "n_theta=32,n_r=4"}) {
    const Named ring(test::ring + fineness);
    for (int n = 2; n <= 6; ++n)
      for (const double phase : {0.0, 0.3}) {
        const auto plate = [&](double, double angle, double) {
          return Point{0, 0, std::cos(n * angle + phase)};
        };
        EXPECT_EQ(ring.name(cylindrical(plate)).name, "(0," + std::to_string(n) + ") out of plane");
        // A thin ring bends without stretch: u_θ' = −u_r.
        const auto bending = [&](double, double angle, double) {
          return Point{std::cos(n * angle + phase), -std::sin(n * angle + phase) / n, 0};
        };
        const auto found = ring.name(cylindrical(bending));
        EXPECT_EQ(found.name, "in plane, radial, n = " + std::to_string(n));
        EXPECT_NEAR(found.share, 1, 1e-6);  // round-off of the fit
        // A nodal circle in the middle of the ring, at r = 0.1.
        const auto tilted = [&](double r, double angle, double) {
          return Point{0, 0, (r - 0.1) * std::cos(n * angle + phase)};
        };
        EXPECT_EQ(ring.name(cylindrical(tilted)).name,
                  "(1," + std::to_string(n) + ") out of plane");
      }
    const auto sum = [&](double, double angle, double) {
      return Point{0, 0, std::cos(2 * angle) + std::cos(3 * angle)};
    };
    EXPECT_EQ(ring.name(cylindrical(sum)).name, "");  // half of the energy each
  }
}

TEST(BodyMotions, AreRigid) {
  const Named ring(test::ring + "n_theta=20");
  // Across its axis the motions of a body of revolution come in pairs of one name.
  for (const double phase : {0.0, 0.4, M_PI / 2}) {
    const Point across{std::cos(phase), std::sin(phase), 0};
    EXPECT_EQ(ring.name([&](const Point&) { return across; }).name, "rigid along a diameter");
    const auto turned = ring.name([&](const Point& x) { return mesh::cross(across, x); });
    EXPECT_EQ(turned.name, "rigid about a diameter");
    EXPECT_NEAR(turned.share, 1, 1e-12);
  }
  EXPECT_EQ(ring.name([](const Point&) { return Point{0, 0, 1}; }).name, "rigid along z");
  EXPECT_EQ(ring.name([](const Point& x) {
                  return mesh::cross({0, 0, 1}, x);
                })
                .name,
            "rigid about z");
}

TEST(BodyMotions, OfABlockHaveNoDiameters) {
  const Named block(
      "-mesh_file meshes/layer_slab.geo -mesh_set Lx=1,nx=8,ny=2,nz=2,depth=0.6 "
      "-material_layer_young 1 -material_layer_poisson 0.3 -material_layer_density 1");
  const auto bent = [](const Point& x) { return Point{0, std::cos(2 * M_PI * x[0]), 0}; };
  EXPECT_EQ(block.name(bent).name, "");
  EXPECT_EQ(block.name([](const Point&) { return Point{1, 0, 0}; }).name, "rigid along x");
}

}  // namespace
}  // namespace squeal::test
