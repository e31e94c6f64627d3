// Standing waves across an orthotropic layer whose axes are turned: both wave speeds, and the order
// of convergence.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/coupled.hpp"
#include "modes/modes.hpp"
#include "petsc/text.hpp"
#include "support/case.hpp"
#include "support/model.hpp"

namespace squeal {
namespace {

constexpr double e1 = 3, e2 = 1.3, e3 = 0.8, nu12 = 0.35, nu13 = 0.42, nu23 = 0.27, g12 = 0.9,
                 density = 1.7, angle = 0.5;

/// Motion uniform in x of a layer −1 < y < 0, clamped below, free above: ρ u_tt = Γ u_yy with Γ =
/// [D66 D26; D26 D22] in the axes of the mesh, ω = (2n − 1) π/2 √(γ/ρ) for both eigenvalues γ of Γ.
/// The first `count` of them, sorted.
std::vector<double> exactFrequencies(std::size_t count) {
  const double nu21 = nu12 * e2 / e1, nu31 = nu13 * e3 / e1, nu32 = nu23 * e3 / e2;
  const double delta = 1 - nu12 * nu21 - nu23 * nu32 - nu31 * nu13 - 2 * nu21 * nu32 * nu13;
  const double d11 = e1 * (1 - nu23 * nu32) / delta, d22 = e2 * (1 - nu13 * nu31) / delta,
               d12 = e1 * (nu21 + nu31 * nu23) / delta;
  const double c = std::cos(angle),
               s = std::sin(angle);  // from x to axis 1 (Jones, Mechanics of Composite Materials)
  const double g22 =
      d11 * s * s * s * s + 2 * (d12 + 2 * g12) * s * s * c * c + d22 * c * c * c * c;
  const double g66 =
      (d11 + d22 - 2 * d12 - 2 * g12) * s * s * c * c + g12 * (s * s * s * s + c * c * c * c);
  const double g26 = (d11 - d12 - 2 * g12) * s * s * s * c + (d12 - d22 + 2 * g12) * s * c * c * c;
  const double mean = (g22 + g66) / 2, root = std::hypot((g22 - g66) / 2, g26);
  std::vector<double> list;
  for (int n = 1; n < 10; ++n)
    for (double gamma : {mean - root, mean + root})
      list.push_back((2 * n - 1) * M_PI / 2 * std::sqrt(gamma / density));
  std::sort(list.begin(), list.end());
  list.resize(count);
  return list;
}

/// Largest relative error of the first five frequencies; a column so narrow that no other wave is
/// among them.
double worstError(int cells, int order) {
  test::setOptions(
      formatted("-mesh_file meshes/layer.geo -mesh_set Lx=0.02,h=1,nx=2,ny=%d,order=%d ", cells,
                order) +
      formatted("-material_layer_engineering_constants %g,%g,%g,%g,%g,%g,%g,0.7,0.5 ", e1, e2, e3,
                nu12, nu13, nu23, g12) +
      formatted("-material_layer_orientation %.17g,%.17g,0,%.17g,%.17g,0 ", std::cos(angle),
                std::sin(angle), -std::sin(angle), std::cos(angle)) +
      "-material_layer_density 1.7 -constraint_bottom_clamped xy -constraint_right_image_of left "
      "-modes_count 5");
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  const auto modes = modes::compute(system);
  const auto exact = exactFrequencies(5);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, std::abs(modes.angularFrequency[i] / exact[i] - 1));
  return worst;
}

TEST(Orthotropy, WavesAcrossALayer) {
  for (int order : {1, 2}) {
    const double coarse = worstError(12 / order, order), fine = worstError(24 / order, order),
                 measured = std::log2(coarse / fine);
    test::print("order %d: worst of five frequencies off by %.2e and %.2e, order %.2f\n", order,
                coarse, fine, measured);
    EXPECT_NEAR(measured, 2 * order,
                0.2);  // frequencies converge with twice the order of the elements
    // The fifth frequency is the third of the slower wave, k = 5π/2: leading terms of the error of
    // bars of h = 1/24 and 1/12.
    const double kh = 5 * M_PI / 2 * order / 24,
                 leading = order == 1 ? kh * kh / 24 : std::pow(kh, 4) / 1440;
    EXPECT_NEAR(fine, leading, 0.05 * leading);
  }
}

}  // namespace
}  // namespace squeal
