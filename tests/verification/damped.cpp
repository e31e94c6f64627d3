// SPDX-License-Identifier: BSD-2-Clause
// Damped, rotating and unsymmetric problems: the reduced problem with all modes against the direct
// solve; structural damping against closed forms; the speed sweep.
#include <gtest/gtest.h>

#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// A coarse slab with everything: friction damping, convective terms, Rayleigh damping of one body.
const std::string full =
    "-mesh_set nx=12,ny_disc=4,ny_pad=3,order=1 -motion_convective on -flutter_friction 0.3 "
    "-material_pad_rayleigh_stiffness 0.01 "
    "-material_pad_rayleigh_mass 0.002 ";

std::vector<Complex> lowest(const pencil::ComplexModes& point, double top) {
  std::vector<Complex> list;
  for (const auto& e : point.eigenvalues)
    if (std::abs(e.s) < top) list.push_back(e.s);
  return list;
}

// Two ways that share the matrices and nothing else: TOAR on all unknowns (too many for LAPACK to
// take its place), and QR on the projection of them all. Eigenvalues of these small matrices are
// hardly sensitive: the backward errors of both, 1e-13, leave 1e-8 room.
TEST(Damped, DirectIsTheReducedProblemWithAllModes) {
  const analysis::Analysis direct =
      runCase("two_layers_antiplane", full + "-flutter_method direct -flutter_direct_count 40");
  const auto unknowns = direct.flutter.segments.at(0).unknowns;
  const analysis::Analysis reduced =
      runCase("two_layers_antiplane",
              full + "-flutter_basis modal -modes_count " + std::to_string(unknowns));
  const auto& found = direct.flutter.segments[0].points.at(0);
  double top = 0;
  for (const auto& e : found.eigenvalues) top = worse(top, std::abs(e.s));
  top *= 1 - 1e-6;
  const auto a = lowest(found, top), b = lowest(reduced.flutter.segments.at(0).points.at(0), top);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 30U);
  const double worst = test::worst(errors(b, a).relative);
  print("direct against all %d modes, %zu eigenvalues: %.1e; backward error %.1e\n",
        static_cast<int>(unknowns), a.size(), worst, found.worstBackwardError());
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(found.worstBackwardError(), 1e-10);
}

// C = α M + β K: s² + (α + β ω²) s + ω² = 0 for every undamped frequency ω.
TEST(Damped, RayleighDampingHasAClosedForm) {
  const double alpha = 0.02, beta = 0.015;
  const std::string mesh = "-mesh_set nx=8,ny=4 -flutter_friction 0 ";
  const std::string damping = "-material_layer_rayleigh_mass " + std::to_string(alpha) +
                              " -material_layer_rayleigh_stiffness " + std::to_string(beta);
  const analysis::Analysis undamped = runCase("layer", mesh + "-modes_count 40"),
                           damped = runCase("layer", mesh + "-modes_count 40 " + damping);
  const auto& point = damped.flutter.segments.at(0).points.at(0);
  std::vector<Complex> expected;
  for (double w : undamped.flutter.segments.at(0).modes.angularFrequency)
    if (const double c = alpha + beta * w * w; w <= point.bandTop)
      expected.push_back({-c / 2, std::sqrt(w * w - c * c / 4)});
  ASSERT_GT(expected.size(), 12U);
  EXPECT_LT(worst(errors(expected, eigenvaluesOf(point)).relative),
            1e-8);  // square roots of the double modes' rounding
}

// The loss factor is met exactly at its frequency: −2 Re s/|s| = η there, and in proportion to the
// frequency elsewhere.
TEST(Damped, LossFactorHoldsAtItsFrequency) {
  const double eta = 0.03;
  const std::string mesh = "-mesh_set nx=8,ny=4 -flutter_friction 0 -modes_count 40 ";
  const analysis::Analysis undamped = runCase("layer", mesh);
  const double w = undamped.flutter.segments.at(0).modes.angularFrequency[4];
  const analysis::Analysis damped =
      runCase("layer", mesh + "-material_layer_loss_factor 0.03 -material_layer_loss_frequency " +
                           shortest(w / (2 * M_PI)));
  const auto& eigenvalues = damped.flutter.segments.at(0).points.at(0).eigenvalues;
  EXPECT_GT(eigenvalues.size(), 12U);
  for (const auto& e : eigenvalues)
    EXPECT_NEAR(-2 * e.s.real() / std::abs(e.s), eta * std::abs(e.s) / w, 1e-8);
}

// Modal damping: each mode has its ratio, the last one given holds for the rest.
TEST(Damped, ModalRatios) {
  const analysis::Analysis analysis =
      runCase("layer",
              "-mesh_set nx=8,ny=4 -flutter_friction 0 -modes_count 40 -flutter_modal_damping "
              "0.01,0.03,0.002");
  const auto& point = analysis.flutter.segments.at(0).points.at(0);
  const auto& modes = analysis.flutter.segments[0].modes.angularFrequency;
  std::vector<Complex> expected;
  for (std::size_t i = 0; i < modes.size() && modes[i] <= point.bandTop; ++i) {
    const double zeta = i == 0 ? 0.01 : i == 1 ? 0.03 : 0.002;
    expected.push_back(modes[i] * Complex(-zeta, std::sqrt(1 - zeta * zeta)));
  }
  ASSERT_GT(expected.size(), 12U);
  EXPECT_LT(worst(errors(expected, eigenvaluesOf(point)).relative), 1e-8);
}

// At vanishing speed friction damping c = f p/|w| holds the surfaces together across the sliding
// direction: growth rates are those of bonded anti-plane motion, none, and the strongly damped
// eigenvalues go as c. Between two speeds, both small, the damping of the anti-plane modes that
// remain falls in proportion to the speed.
TEST(Damped, FrictionDampingDominatesAtVanishingSpeed) {
  const analysis::Analysis analysis =
      runCase("two_layers_antiplane",
              "-mesh_set nx=6,ny_disc=3,ny_pad=2,order=2 -modes_count 60 -flutter_friction 0.3 "
              "-flutter_speed 0.001,0.002");
  ASSERT_EQ(analysis.flutter.segments.size(), 1U);
  // The lowest anti-plane mode with k = 0: layers of modulus μ, joined.
  const auto growthNear = [&](std::size_t index, double frequency) {
    double distance = INFINITY, growth = 0;
    for (const auto& e : analysis.flutter.segments[0].points.at(index).eigenvalues)
      if (std::abs(e.s.imag() - frequency) < distance)
        distance = std::abs(e.s.imag() - frequency), growth = e.s.real();
    EXPECT_LT(distance, 0.01);
    return growth;
  };
  // √(μρ) cot(ω h/c) of the two layers sums to zero.
  const double muDisc = 1 / 2.6, muPad = 0.4 / 2.5, cDisc = std::sqrt(muDisc),
               cPad = std::sqrt(muPad / 0.6);
  double low = 0.5, high = 1.8;
  const auto joined = [&](double w) {
    return muDisc / cDisc / std::tan(w / cDisc) + muPad / cPad / std::tan(0.6 * w / cPad);
  };
  for (int i = 0; i < 60; ++i) (joined((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  const double slow = growthNear(0, low), faster = growthNear(1, low);
  print("anti-plane mode at %.4f: growth %.3e and %.3e at twice the speed\n", low, slow, faster);
  EXPECT_LT(slow, 0);
  EXPECT_NEAR(faster / slow, 2,
              1e-3);  // relative corrections (impedance / c)² are of the order of 1e-4
}

// The modes contain the stress at the first friction of a sweep; its change at the others is in
// separate terms. Each friction of a sweep therefore gives the same as in a run of its own. The
// pressing strain of a percent moves frequencies by about as much.
TEST(Prestress, OfASweepIsThatOfEachFriction) {
  const std::string options =
      "-mesh_set nx=8,ny_disc=4,ny_pad=3 -modes_count 40 -elasticity_prestress on "
      "-flutter_accuracy 1e-11 ";
  const analysis::Analysis sweep = runCase("two_layers", options + "-flutter_friction 0.1,0.5"),
                           single = runCase("two_layers", options + "-flutter_friction 0.5"),
                           slack =
                               runCase("two_layers",
                                       options + "-elasticity_prestress off -flutter_friction 0.5");
  const auto inBand = [](const pencil::ComplexModes& point) {
    std::vector<Complex> list;
    for (const auto& e : point.eigenvalues)
      if (std::abs(e.s) < 3.5) list.push_back(e.s);
    return list;
  };
  const auto& points = sweep.flutter.segments.at(0).points;
  const auto one = inBand(single.flutter.segments.at(0).points.at(0)), other = inBand(points.at(1));
  ASSERT_GT(points[1].bandTop, 3.5);
  ASSERT_EQ(one.size(), other.size());
  EXPECT_GT(one.size(), 10U);
  const double difference = worst(errors(one, other).relative),
               effect = std::abs(slack.flutter.segments.at(0).modes.angularFrequency[5] /
                                     single.flutter.segments[0].modes.angularFrequency[5] -
                                 1);
  print("prestress: sweep against single friction %.1e; effect of the stress %.1e\n", difference,
        effect);
  EXPECT_LT(difference, 1e-8);  // both corrected to 1e-11
  EXPECT_GT(effect, 1e-3);
}

}  // namespace
}  // namespace squeal::test
