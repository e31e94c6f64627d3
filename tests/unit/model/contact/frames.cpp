// SPDX-License-Identifier: BSD-2-Clause
// Frames of the contact nodes, their areas and the directions of slip.
#include <gtest/gtest.h>

#include <cmath>

#include "model/contact/build.hpp"
#include "model/contact/coupled.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/contact_cases.hpp"
#include "support/model/coupled_contact.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::contains;
using test::Coupled;
using test::coupled;
using test::errorOf;
using test::contact_cases::ballInShell;
using test::contact_cases::cylinders;
using test::contact_cases::layers;
using test::contact_cases::setLayers;

mesh::Point gapColumn(const std::vector<double>& block, int dimension) {
  mesh::Point column{};
  for (int i = 0; i < dimension; ++i) column[i] = block[i * dimension + dimension - 1];
  return column;
}

/// Rows of the kinematic matrix A at a pad node: its tangents and normal are the columns of the
/// diagonal block. On tri6 faces that of the gap of a middle node has the factor 1 − 2α = 0.6.
void orthonormalFrames(const Coupled& c, double tolerance) {
  const auto& model = c.model;
  const int dimension = c.dimension();
  for (const auto& node : model.contact.interfaces.nodes) {
    std::vector<PetscInt> places;
    for (int d = 0; d < dimension; ++d) places.push_back(dimension * node.globalNode + d);
    std::vector<double> frame(static_cast<std::size_t>(dimension * dimension));
    check(MatGetValues(model.contact.kinematics.matrix, dimension, places.data(), dimension,
                       places.data(), frame.data()));
    const double factor = std::abs(test::dot(node.normal, gapColumn(frame, dimension)));
    EXPECT_NEAR(factor, factor < 0.8 ? 0.6 : 1, 1e-13);
    for (int i = 0; i < dimension; ++i) frame[i * dimension + dimension - 1] /= factor;
    for (int a = 0; a < dimension; ++a)
      for (int b = 0; b < dimension; ++b) {
        double sum = 0;
        for (int i = 0; i < dimension; ++i)
          sum += frame[i * dimension + a] * frame[i * dimension + b];
        EXPECT_NEAR(sum, a == b, tolerance);
      }
    for (int i = 0; i < dimension; ++i)
      EXPECT_NEAR(frame[i * dimension + dimension - 1], node.normal[i], 1e-14);
  }
}

// Disc inside, pad outside: n is radial. On straight edges the mean of two neighbours is, by
// symmetry; parabolas meet smoothly to h³.
TEST(Frame, IsOrthonormalAndRadialOnACircle) {
  for (const int order : {1, 2}) {
    test::setOptions(cylinders +
                     "-mesh_set n_inner=2,n_outer=2,n_theta=16,order=" + std::to_string(order));
    const auto c = coupled();
    EXPECT_EQ(c.nodes.size(), order == 1 ? 16u : 32u);
    orthonormalFrames(c, 1e-8);  // where x or y is held it is a tangent exactly, the normal as far
                                 // as gmsh's 10 digits go
    double length = 0;
    for (const auto& node : c.nodes) {
      const double r = std::hypot(node.position[0], node.position[1]);
      EXPECT_NEAR(test::dot(node.normal, node.position) / r, 1, 1e-9);
      length += node.area;
    }
    // Perimeter of the polygon; parabolas over an angle θ = 2π/16 fall short of their arcs by
    // θ⁴/960 = 2.5e-5.
    EXPECT_NEAR(length,
                order == 1 ? 32 * 0.08 * std::sin(M_PI / 16) : (1 - 2.48e-5) * 2 * M_PI * 0.08,
                order == 1 ? 1e-10 : 1e-6);
  }
}

TEST(Frame, IsOrthonormalAndRadialOnASphere) {
  for (const int order : {1, 2}) {
    test::setOptions(ballInShell(order));
    const auto c = coupled();
    ASSERT_GT(c.nodes.size(), 20u);
    orthonormalFrames(c, 1e-14);
    double area = 0, least = 1;
    for (const auto& node : c.nodes) {
      least = -test::worse(-least, -test::dot(node.normal, node.position));
      area += node.area;
    }
    test::print("sphere, order %d: %d contact nodes, least n·r %.5f, area / 4 pi %.5f\n", order,
                static_cast<int>(c.nodes.size()), least, area / (4 * M_PI));
    EXPECT_GT(least, order == 1 ? 0.95 : 0.995);  // facets of 35 degrees, uneven around a node
    EXPECT_NEAR(area / (4 * M_PI), 1, order == 1 ? 0.12 : 0.01);
  }
}

void requireSlip(const contact::Contact& contact) {
  contact::requireSlip(contact, contact.slip(1, nullptr),
                       std::vector<unsigned char>(contact.interfaces.nodes.size(), 1), 0.4);
}

// Vω = ω k × r, w = −V: τ against the rotation, |w| = |ω| r, for both senses.
TEST(Slip, FollowsTheRotation) {
  for (const double speed : {2.0, -5.0}) {
    test::setOptions(cylinders +
                     "-mesh_set n_inner=2,n_outer=2,n_theta=16,order=2 -motion_inner_speed " +
                     std::to_string(speed));
    const auto c = coupled();
    EXPECT_EQ(c.nodes.size(), 32u);
    for (const auto& node : c.nodes) {
      const double r = std::hypot(node.position[0], node.position[1]), sign = speed > 0 ? -1 : 1;
      EXPECT_NEAR(node.slip[0], sign * -node.position[1] / r, 1e-9);
      EXPECT_NEAR(node.slip[1], sign * node.position[0] / r, 1e-9);
      EXPECT_NEAR(node.slipSpeed, std::abs(speed) * r, 1e-9);
    }
    EXPECT_EQ(errorOf([&] { requireSlip(c.model.contact); }), "");
  }
  setLayers();
  const auto nodes = coupled().nodes;
  EXPECT_EQ(nodes.size(), 6u);
  for (const auto& node : nodes) {  // V along +x
    EXPECT_NEAR(node.slip[0], -1, 1e-14);
    EXPECT_NEAR(node.slipSpeed, 1, 1e-14);
  }
}

TEST(Slip, WithoutDirectionIsAnError) {
  test::setOptions(ballInShell(1));  // the poles are on the axis
  auto model = test::buildModel();
  auto message = errorOf([&] { requireSlip(model.contact); });
  EXPECT_TRUE(contains(message, "|w| = 0") && contains(message, "1) of interface 'ring'"))
      << message;
  for (const std::string velocity : {"0,0,0", "0,1,0"}) {  // at rest; along the normal
    test::setCase("two_layers", layers + " -motion_disc_velocity " + velocity);
    model = test::buildModel();
    message = errorOf([&] { requireSlip(model.contact); });
    EXPECT_TRUE(contains(message, "|w| = 0") && contains(message, "-motion_<body>_velocity") &&
                contains(message, "'interface'"))
        << message;
  }
}

}  // namespace
}  // namespace squeal
