// SPDX-License-Identifier: BSD-2-Clause
// Frequencies under tension, through the whole program: a stretched string.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

constexpr double young = 2, density = 1.7;

/// The first `count` angular frequencies.
std::vector<double> frequencies(const std::string& options, std::size_t count) {
  const auto analysis =
      test::runOptions(options + " -flutter_friction 0 -modes_count " + std::to_string(count));
  return analysis.flutter.segments.at(0).modes.angularFrequency;
}

// A strip between guides that hold u_x, stretched by 1 %, on a spring too soft to count. The
// deflection is cos(kx), k = nπ/L, exactly, as the guides are planes of symmetry. The tension S is
// uniform and K_σ = S ∫ ∂φᵢ/∂x ∂φⱼ/∂x, for such modes S k²/ρ times M: a string on top of a beam,
//   ω² = S k²/ρ + ω0²
// with the frequency ω0 without tension, that of a Timoshenko beam: X = ρ ω0²/E and a = h²/12
// satisfy
//   X² a E/κG − X (1 + a k² (1 + E/κG)) + a k⁴ = 0,  κ = 5 (1 + ν) / (6 + 5 ν).
TEST(Prestress, StretchedString) {
  constexpr double length = 20, height = 0.5, strain = 0.01, mass = density * length * height;
  const std::string strip =
      formatted(
          "-mesh_file meshes/layer.geo -mesh_set Lx=%g,h=%g,nx=40,ny=3,order=2,serendipity=1 ",
          length, height) +
      formatted("-material_layer_young %g -material_layer_poisson 0.3 -material_layer_density %g ",
                young, density) +
      "-elasticity_plane stress -constraint_left_clamped x -constraint_right_clamped x "
      "-ground_bottom_stiffness 0,1e-8 ";
  const auto slack = frequencies(strip, 4);
  const auto taut =
      frequencies(strip + formatted("-constraint_right_displacement %g,0 -elasticity_prestress on",
                                    strain * length),
                  4);
  constexpr double a = height * height / 12, overShear = 2 * 1.3 * 7.5 / 6.5;  // E / κG
  for (int n = 1; n <= 3; ++n) {
    const double k = n * M_PI / length, middle = 1 + a * k * k * (1 + overShear);
    const double bending =
        young / density * 2 * a * std::pow(k, 4) /
        (middle + std::sqrt(middle * middle - 4 * a * a * overShear * std::pow(k, 4)));
    const double tension = young * strain * k * k / density;
    const auto i = static_cast<std::size_t>(n);
    test::print("string, n = %d: %.6f with tension (theory %.6f), %.6f without (%.6f)\n", n,
                taut[i], std::sqrt(tension + bending), slack[i], std::sqrt(bending));
    EXPECT_NEAR(slack[i], std::sqrt(bending),
                5e-4 * slack[i]);  // the beam is a theory of order (k h)⁴ = 0.003
    EXPECT_NEAR(taut[i] * taut[i] - slack[i] * slack[i], tension,
                1e-5 * tension);  // quad8, 13 cells per half wave at least
    EXPECT_NEAR(taut[i], std::sqrt(tension + bending), 2e-4 * taut[i]);
  }
  EXPECT_NEAR(taut[0], std::sqrt(1e-8 / mass),
              1e-3 * std::sqrt(1e-8 / mass));  // the whole strip on its spring
}

}  // namespace
}  // namespace squeal
