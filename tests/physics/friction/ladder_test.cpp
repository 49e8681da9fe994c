// A ladder stands exactly when the friction of its foot carries the wall's push
// (experiments/standing/ladder.h).

#include "tests/physics/experiments/standing/ladder.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class LadderTest : public testing::TestWithParam<double> {};  // Hz

TEST_P(LadderTest, StandsAThousandthAboveItsFriction_AndSlidesAThousandthBelow) {
  for (const double angle_deg : {35.0, 60.0, 80.0})
    for (const double thickness : {0.02, 0.2})
      for (const double heading : {0.0, 0.8}) {
        const Ladder ladder{
            .rate_hz = GetParam(), .angle = radians(angle_deg), .thickness_m = thickness, .heading = heading};
        SCOPED_TRACE(testing::Message() << angle_deg << " degrees, " << thickness << " m, " << heading);
        EXPECT_LE(ladderSlip(kCarom, ladder, 1.001, 3.0), 2.0 * restGap(thickness)) << "it takes up its gaps";
        EXPECT_GT(ladderSlip(kCarom, ladder, 0.999, 5.0), 0.1);
      }
}

INSTANTIATE_TEST_SUITE_P(Rates, LadderTest, testing::Values(30.0, 60.0, 240.0));

}  // namespace
}  // namespace carom::physics
