// The wave of stick, slip and separation of an elastic tube on a rotating shaft.
#include <gtest/gtest.h>

#include "support/regime_models.hpp"

namespace squeal {
namespace {

// With a small mismatch δ = 0.02 the tube lifts off. Another program found ω = 4.4363 with 400
// nodes and 4.4351 with 800, and 56 % of it open; this one 4.4401 with 400 and 62 %, with ever
// shorter steps less of it open: impacts of nodes with mass make the error of the first order.
TEST(RegimeSeparation, TubeFindsItsWave) {
  const test::Tube tube = test::tubeOf(1.5, 0.3);
  const test::Wave wave = test::waveOf(tube, 4, 0.4, 4.4136, 0.1714);
  const test::TubeModel model = test::tubeModel(tube, 4, 0.4, 0.02, 400, 5e-4);
  const double period = 2 * M_PI / 4.435;
  const test::Marched result = test::marched(model.model, test::onWave(wave, model.model),
                                             period / 1280, 10 * period, 6 * period);
  EXPECT_NEAR(result.omega, 4.435, 0.006);
  EXPECT_NEAR(result.open, 0.56, 0.07);
}

}  // namespace
}  // namespace squeal
