// SPDX-License-Identifier: BSD-2-Clause
// Shares of bodies, springs and masses in the energies of free modes, against the exact modes of a
// bar.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// Two bars in a line, the first held at its left end; a mass and a spring are at the right end.
const char* const geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1.8, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3};
Transfinite Curve{1} = 21; Transfinite Curve{2} = 17;
a[] = Extrude{0, 0.05, 0}{ Curve{1}; Layers{1}; Recombine; };
b[] = Extrude{0, 0.05, 0}{ Curve{2}; Layers{1}; Recombine; };
Physical Surface("inner") = {a[1]};
Physical Surface("outer") = {b[1]};
Physical Curve("sides") = {1, 2, a[0], b[0]};
Physical Curve("held") = {a[3]};
Physical Curve("end") = {b[2]};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
)";

constexpr double width = 0.05;
constexpr double inner = 1, innerModulus = 1, innerDensity = 1;  // length, …
constexpr double outer = 0.8, outerModulus = 3, outerDensity = 2;
constexpr double stiffness = 0.7, mass = 0.4;  // of the spring and the mass, per cross-section

/// The mode with the angular frequency w is u = sin(a x) in the inner bar and, with y = x − 1,
/// u = A cos(b y) + B sin(b y) in the outer one.
struct Mode {
  explicit Mode(double frequency) : w(frequency) {
    a = w * std::sqrt(innerDensity / innerModulus);
    b = w * std::sqrt(outerDensity / outerModulus);
    A = std::sin(a * inner);
    B = innerModulus * a * std::cos(a * inner) / (outerModulus * b);
  }
  double end() const { return A * std::cos(b * outer) + B * std::sin(b * outer); }
  /// The force that is left at the end of the bars; it vanishes at an eigenfrequency.
  double unbalanced() const {
    const double slope = b * (B * std::cos(b * outer) - A * std::sin(b * outer));
    return outerModulus * slope + (stiffness - mass * w * w) * end();
  }
  /// Returns ∫ (P cos b y + Q sin b y)² dy over a length.
  static double square(double P, double Q, double b, double length) {
    const double c = std::sin(2 * b * length) / (4 * b), s = std::sin(b * length);
    return P * P * (length / 2 + c) + Q * Q * (length / 2 - c) + P * Q * s * s / b;
  }
  /// Returns twice the strain energy and the kinetic energy of each component, per cross-section.
  std::map<std::string, std::pair<double, double>> energies() const {
    return {{"inner",
             {innerModulus * a * a * square(1, 0, a, inner),
              innerDensity * w * w * square(0, 1, a, inner)}},
            {"outer",
             {outerModulus * b * b * square(B, -A, b, outer),
              outerDensity * w * w * square(A, B, b, outer)}},
            {"bushing tip", {stiffness * end() * end(), 0}},
            {"mass tip", {0, mass * w * w * end() * end()}}};
  }
  double w, a, b, A, B;
};

/// Returns the frequencies of the first modes, found by bisection between signs of the force.
std::vector<double> frequencies(std::size_t count) {
  std::vector<double> found;
  constexpr double step = 1e-2;
  for (double low = step; found.size() < count; low += step) {
    double from = low, to = low + step;
    if ((Mode(from).unbalanced() > 0) == (Mode(to).unbalanced() > 0)) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = (from + to) / 2;
      ((Mode(middle).unbalanced() > 0) == (Mode(from).unbalanced() > 0) ? from : to) = middle;
    }
    found.push_back((from + to) / 2);
  }
  return found;
}

// The end moves as a whole, so that the motion is that of bars. With quadratic cells of length h,
// the relative error of a squared frequency is (a h)^4 / 720, 2e-5 in the fourth mode with a h =
// 0.33; shares of energies have a few times this error.
TEST(Shares, OfABarWithSpringAndMass) {
  const std::string total = std::to_string(stiffness * width);
  const analysis::Analysis analysis = runOptions(
      "-mesh_file " + writeFile("bars.geo", geometry) + material("inner", "1", "0", "1") +
      material("outer", "3", "0", "2") +
      "-constraint_sides_clamped y -constraint_held_clamped x -reference_tip_position 1.8,0.025 "
      "-coupling_tip_nodes end -coupling_tip_reference tip -coupling_tip_components x "
      "-constraint_tip_clamped y -constraint_tip_clamped_rotation z -bushing_tip_from tip "
      "-bushing_tip_stiffness " +
      total + ",0,0 -mass_tip_total " + std::to_string(mass * width) +
      " -modes_count 6 -flutter_friction 0 -flutter_band 1.3");
  const auto& segment = analysis.flutter.segments.at(0);
  ASSERT_GE(segment.components.size(), 4u);
  const auto exact = frequencies(4);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(segment.modes.angularFrequency[i], exact[i], 1e-5 * exact[i]);
    const auto energies = Mode(exact[i]).energies();
    double strain = 0, kinetic = 0;
    for (const auto& [name, energy] : energies) strain += energy.first, kinetic += energy.second;
    EXPECT_NEAR(strain, kinetic, 1e-12 * strain);
    ASSERT_EQ(segment.components[i].size(), energies.size());
    for (const auto& found : segment.components[i]) {
      const std::string name = found.kind == "body" ? found.name : found.kind + " " + found.name;
      ASSERT_TRUE(energies.contains(name)) << name;
      EXPECT_NEAR(found.strain, energies.at(name).first / strain, 5e-5) << name;
      EXPECT_NEAR(found.kinetic, energies.at(name).second / kinetic, 5e-5) << name;
    }
  }
}

}  // namespace
}  // namespace squeal::test
