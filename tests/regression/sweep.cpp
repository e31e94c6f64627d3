// SPDX-License-Identifier: BSD-2-Clause
// A point of a sweep over four parameters is what a run with these values in the options gives.
#include <gtest/gtest.h>

#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep/sweep.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// The coarse disc brake with all that the parameters act on: convective terms and centrifugal
/// load, a friction law and friction-induced damping, and every kind of damping of the bodies.
analysis::Analysis run(double speed, double pressure, double damping, const std::string& swept) {
  return runCase(
      "disc_brake_map",
      "-friction_law exponential -friction_static_ratio 1.4 -friction_decay_speed 5 "
      "-flutter_friction 0.2,0.5 "
      "-flutter_accuracy 1e-10 -flutter_band 2000 -modes_count 30 -steady_uniqueness off " +
          formatted("-motion_disc_rpm %.17g -motion_hat_rpm %.17g -load_pressed_pressure %.17g ",
                    100 * speed, 100 * speed, 1e6 * pressure) +
          formatted("-material_disc_loss_factor %.17g -material_hat_loss_factor 0 "
                    "-material_back_plate_loss_factor 0 "
                    "-material_lining_loss_factor 0 -material_lining_rayleigh_stiffness %.17g "
                    "-ground_guide_leading_damping %.17g,0,0 -flutter_modal_damping %.17g ",
                    0.004 * damping, 1e-6 * damping, 50 * damping, 0.001 * damping) +
          swept);
}

/// Largest difference of an eigenvalue in the band from that of the other run, relative.
double difference(const pencil::ComplexModes& one, const pencil::ComplexModes& other) {
  const auto band = eigenvaluesOf(one);
  EXPECT_GT(band.size(), 4U);
  return worst(errors(band, eigenvaluesOf(other)).relative);
}

TEST(Sweep, PointsOfTheGridAreRunsOfTheirOwn) {
  const analysis::Analysis grid =
      run(1, 1, 1, "-flutter_speed 1,3 -flutter_pressure 1,2 -flutter_damping 1,2");
  EXPECT_EQ(grid.steady.solutions.size(), 8U);  // damping does not change them
  const auto points = grid.sweep.points();
  ASSERT_EQ(points.size(), 16U);
  for (const auto& at : points) ASSERT_NE(grid.pointAt(at), nullptr) << sweep::parameterText(at);
  const analysis::Analysis single =
      run(3, 2, 2, "-flutter_speed 1 -flutter_pressure 1 -flutter_damping 1");
  for (const double friction : {0.2, 0.5}) {
    const sweep::Parameters at{friction, 3, 2, 2};
    const auto& wanted = *single.pointAt({friction, 1, 1, 1});
    const double same = difference(wanted, *grid.pointAt(at));
    print("%s: eigenvalues differ by %.1e\n", sweep::parameterText(at).c_str(), same);
    EXPECT_LT(same,
              1e-7);  // backward errors of 1e-10, times conditions of some tens: 6e-9 measured
    EXPECT_EQ(wanted.unstableCount(), grid.pointAt(at)->unstableCount());
    for (const auto& parameter : sweep::allParameters) {
      if (parameter.value == &sweep::Parameters::friction) continue;
      sweep::Parameters without = at;
      without.*parameter.value = 1;
      const double other = difference(wanted, *grid.pointAt(without));
      print("  without the factor on the %s by %.1e\n", parameter.name, other);
      EXPECT_GT(other, 1e-5);
    }
  }
}

}  // namespace
}  // namespace squeal::test
