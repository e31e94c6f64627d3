// Critical frictions of two damped elastic layers: against the problem on all unknowns, and against the exact waves.
#include <gtest/gtest.h>

#include <array>

#include "exact/two_layers.hpp"
#include "support/case.hpp"
#include "support/spectrum.hpp"

namespace squeal::test {
namespace {

namespace two_layers = exact::two_layers;

// Damping α M of both layers: s² + α s stands for s² of the undamped waves, for every mode. Without friction all waves but those with
// k = 0 come in pairs of equal frequency, both damped by α/2; friction parts them at once, and one of each pair may reach the axis.
constexpr double alpha = 0.02;

Analysis run(const std::string& changes) {
  return runCase("two_layers",
                 "-elasticity_mass consistent -material_disc_rayleigh_mass 0.02 -material_pad_rayleigh_mass 0.02 " + changes);
}

struct Found {
  double friction, omega;
};

/// Exact waves of index n that neither grow nor decay: Newton in (f, ω) from the discrete ones.
Found exactNear(Found at, int n) {
  const auto value = [&](double f, double omega) {
    const Complex s(0, omega);
    return two_layers::characteristic({f}, n, std::sqrt(s * s + alpha * s));
  };
  for (int k = 0; k < 30; ++k) {
    constexpr double h = 1e-6;
    const Complex here = value(at.friction, at.omega);
    const Complex df = (value(at.friction + h, at.omega) - value(at.friction - h, at.omega)) / (2 * h),
                  dw = (value(at.friction, at.omega + h) - value(at.friction, at.omega - h)) / (2 * h);
    const double det = df.real() * dw.imag() - df.imag() * dw.real();
    const double stepF = (here.real() * dw.imag() - here.imag() * dw.real()) / det,
                 stepW = (df.real() * here.imag() - df.imag() * here.real()) / det;
    at.friction -= stepF, at.omega -= stepW;
    if (!(std::abs(stepF) + std::abs(stepW) < 1)) return {NAN, NAN};
    if (std::abs(stepF) + std::abs(stepW) < 1e-13) return at;
  }
  return {NAN, NAN};
}

/// The closest of all wave numbers.
Found closest(const Found& found) {
  Found best{NAN, NAN};
  double distance = INFINITY;
  for (int n = -8; n <= 8; ++n) {
    const Found exact = exactNear(found, n);
    const double here = std::abs(exact.friction - found.friction) + std::abs(exact.omega - found.omega) / found.omega;
    if (here < distance) best = exact, distance = here;
  }
  return best;
}

const std::vector<flutter::Critical>& criticals(const Analysis& analysis) {
  return analysis.segments.at(0).followed.at(0).criticals;
}

// As the mesh is refined; bilinear elements, second order.
TEST(Critical, DampedLayersAgainstExactWaves) {
  std::vector<std::vector<double>> errors;
  for (const std::string mesh : {"nx=24,ny_disc=8,ny_pad=6", "nx=48,ny_disc=16,ny_pad=12"}) {
    const Analysis analysis = run("-mesh_set " + mesh + " -flutter_friction 0,0.05,0.1 -flutter_band 0.7 -modes_count 80");
    const auto& followed = analysis.segments.at(0).followed.at(0);
    EXPECT_TRUE(followed.complete()) << followed.statement();
    errors.emplace_back();
    for (const auto& critical : followed.criticals) {
      EXPECT_TRUE(critical.converged);
      EXPECT_EQ(critical.kind, flutter::Event::Kind::crossing);
      const Found exact = closest({critical.friction, critical.angularFrequency});
      print("%s: critical friction %.8f at %.5f Hz, exact %.8f\n", mesh.c_str(), critical.friction,
            critical.angularFrequency / (2 * M_PI), exact.friction);
      errors.back().push_back(std::abs(critical.friction - exact.friction));
    }
  }
  ASSERT_GE(errors[0].size(), 2u);
  ASSERT_EQ(errors[0].size(), errors[1].size());
  expectOrder(2, 0.2, errors[0], errors[1], "critical frictions");
}

// At the critical friction the eigenvalue of the problem on all unknowns is on the axis: its distance over the slope of the growth is
// the error of the friction.
TEST(Critical, IsThatOfAllUnknowns) {
  const std::string mesh = "-mesh_set nx=24,ny_disc=8,ny_pad=6 ";
  const Analysis analysis = run(mesh + "-flutter_friction 0,0.05,0.1 -flutter_band 0.7 -modes_count 60");
  ASSERT_GE(criticals(analysis).size(), 2u);
  for (const auto& critical : criticals(analysis)) {
    char friction[32];
    std::snprintf(friction, sizeof friction, "%.17g", critical.friction);
    const Analysis direct =
        run(mesh + "-flutter_method direct -flutter_direct_count 40 -flutter_friction " + std::string(friction));
    double distance = INFINITY;
    for (const Complex s : eigenvaluesOf(direct.segments.at(0).points.at(0)))
      distance = std::min(distance, std::abs(s - Complex(0, critical.angularFrequency)));
    print("critical friction %.10f: error by all unknowns %.1e, estimated %.1e, backward error %.1e\n", critical.friction,
          distance / critical.slope, critical.errorEstimate, critical.backwardError);
    EXPECT_LT(distance / critical.slope, 1e-8 * critical.friction);
  }
}

}  // namespace
}  // namespace squeal::test
