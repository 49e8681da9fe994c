#include "renderer/look/surface.h"

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

TEST(Surface, EveryKindHasItsNameAndNoOtherHas) {
  ASSERT_EQ(surfaceNames().size(), static_cast<std::size_t>(kSurfaceKinds));
  ASSERT_EQ(groundNames().size(), static_cast<std::size_t>(kGroundPatterns));
  for (int i = 0; i < kSurfaceKinds; ++i) {
    const auto kind = static_cast<SurfaceKind>(i);
    EXPECT_EQ(surfaceOf(nameOf(kind)), kind);
  }
  for (int i = 0; i < kGroundPatterns; ++i) {
    const auto pattern = static_cast<GroundPattern>(i);
    EXPECT_EQ(groundOf(nameOf(pattern)), pattern);
  }
  EXPECT_FALSE(surfaceOf("checker").has_value());
  EXPECT_FALSE(groundOf("").has_value());
}

// Powers of two up to a metre: the nearest on a scale of ratios.
TEST(Surface, BodiesOfAboutOneSizeHaveOneScale) {
  EXPECT_EQ(usualScale(1.0), 1.0);
  EXPECT_EQ(usualScale(40.0), 1.0);
  EXPECT_EQ(usualScale(0.72), 1.0);
  EXPECT_EQ(usualScale(0.69), 0.5);
  EXPECT_EQ(usualScale(0.26), 0.25);
  EXPECT_EQ(usualScale(0.01), 0.0078125);
}

}  // namespace
}  // namespace carom::renderer
