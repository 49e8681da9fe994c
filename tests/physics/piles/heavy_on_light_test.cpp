// A thousand kilograms on one (experiments/heavy_on_light.h): the light box carries, and nothing sinks in.
//
// Ten thousand on one stand from 120 steps a second on, at 60 from half a metre on and at 30 from a metre
// on; a hundred thousand at 240 from half a metre on. Below, the light one is squeezed out.

#include "tests/physics/experiments/standing/heavy_on_light.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class HeavyOnLight : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, side

TEST_P(HeavyOnLight, StandsAndDoesNotSinkIn) {
  const auto [rate_hz, side_m] = GetParam();
  for (double ratio : {10.0, 100.0, 1000.0, 10000.0}) {
    if (ratio > 1000.0 && rate_hz < 100.0) continue;
    const HeavyLoad load = loadHeavyOnLight(kCarom, ratio, rate_hz, side_m, 5.0);
    EXPECT_TRUE(load.stands) << ratio;
    EXPECT_LE(load.sunk_m, 0.0) << ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(RatesAndSizes, HeavyOnLight,
                         testing::Combine(testing::Values(30.0, 60.0, 120.0, 240.0),
                                          testing::Values(0.1, 0.5, 1.0)));

}  // namespace
}  // namespace carom::physics
