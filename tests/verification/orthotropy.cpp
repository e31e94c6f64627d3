// SPDX-License-Identifier: BSD-2-Clause
// Standing waves across an orthotropic layer whose axes are turned: both wave speeds, and the order
// of convergence.
#include <gtest/gtest.h>

#include <cmath>

#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "exact/orthotropic.hpp"
#include "model/contact/coupled.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

constexpr double density = 1.7, angle = 0.5;

/// Largest relative error of the first five frequencies; a column so narrow that no other wave is
/// among them.
double worstError(int cells, int order) {
  test::setOptions(
      formatted("-mesh_file meshes/layer.geo -mesh_set Lx=0.02,h=1,nx=2,ny=%d,order=%d ", cells,
                order) +
      "-material_layer_engineering_constants " + exact::orthotropic::constants +
      formatted(" -material_layer_orientation %.17g,%.17g,0,%.17g,%.17g,0 ", std::cos(angle),
                std::sin(angle), -std::sin(angle), std::cos(angle)) +
      "-material_layer_density 1.7 -constraint_bottom_clamped xy -constraint_right_image_of left "
      "-modes_count 5");
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  const auto modes = modes::compute(system, modes::Settings::given());
  const auto exact = exact::orthotropic::layerFrequencies(angle, density, 5);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = test::worse(worst, std::abs(modes.angularFrequency[i] / exact[i] - 1));
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
