// SPDX-License-Identifier: BSD-2-Clause
// The speed enters only as the product of -flutter_speed and the motions in the options.
#include <gtest/gtest.h>

#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// The coarse disc brake at ω with all that depends on the speed: convective terms, a friction law,
/// friction-induced damping and centrifugal load.
analysis::Analysis at(double omega, double factor) {
  return runCase(
      "disc_brake",
      "-mesh_set "
      "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_h_ring=2 "
      "-motion_convective on -load_centrifugal on -friction_law exponential -friction_static_ratio "
      "1.4 "
      "-friction_decay_speed 5 -flutter_friction 0.2,0.5 -flutter_accuracy 1e-11 -modes_count 40 "
      "-steady_uniqueness off " +
          formatted("-motion_disc_speed %.17g -motion_hat_speed %.17g -flutter_speed %.17g", omega,
                    omega, factor));
}

/// Largest difference of an eigenvalue in the band from that of the other run, relative.
double difference(const pencil::ComplexModes& one, const pencil::ComplexModes& other) {
  const auto band = eigenvaluesOf(one);
  EXPECT_GT(band.size(), 10u);
  return worst(errors(band, eigenvaluesOf(other)).relative);
}

TEST(Speed, FactorScalesTheMotions) {
  const analysis::Analysis slow = at(10, 1), scaled = at(10, 3), fast = at(30, 1);
  for (const analysis::Analysis* analysis : {&slow, &scaled, &fast}) {
    ASSERT_EQ(analysis->flutter.segments.size(), 1u);
    ASSERT_EQ(analysis->flutter.segments[0].points.size(), 2u);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    double force = 0, forceSize = 0;
    for (std::size_t k = 0; k < fast.model.contact.interfaces.nodes.size(); ++k)
      for (std::size_t d = 0; d < 3; ++d) {
        const double wanted = fast.steady.solutions[i].contact[k].frictionForce[d];
        force = test::worse(
            force, std::abs(scaled.steady.solutions[i].contact[k].frictionForce[d] - wanted));
        forceSize = test::worse(forceSize, std::abs(wanted));
      }
    force = largest(force) / largest(forceSize);
    const auto& wanted = fast.flutter.segments[0].points[i];
    const double same = difference(wanted, scaled.flutter.segments[0].points[i]),
                 other = difference(wanted, slow.flutter.segments[0].points[i]);
    print(
        "friction %g: %d unstable; friction forces differ by %.1e, eigenvalues by %.1e; from those "
        "at a third of the speed by "
        "%.1e\n",
        wanted.at.friction, wanted.unstableCount(), force, same, other);
    EXPECT_LT(force, 1e-10);
    EXPECT_LT(same, 1e-10);
    EXPECT_GT(other, 1e-4);  // the speed matters
    EXPECT_EQ(wanted.unstableCount(), scaled.flutter.segments[0].points[i].unstableCount());
  }
}

}  // namespace
}  // namespace squeal::test
