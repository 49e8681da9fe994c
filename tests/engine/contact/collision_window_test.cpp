// The window's distances: in order, as the paper's fig. 7 draws them, and in proportion to the smaller part.

#include "engine/contact/collision_window.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

CollisionWindow windowOf(const Solid& a, const Solid& b) {
  return collisionWindow(a.parts()[0], b.parts()[0]);
}

TEST(CollisionWindow, IsInOrderForEverySize) {
  for (double size : {1e-3, 0.1, 1.0, 7.0, 100.0}) {
    const CollisionWindow w = windowOf(Solid::box({size, 2 * size, 3 * size}), Solid::ball(50.0));
    EXPECT_GT(w.floor, 0.0);
    EXPECT_LT(w.floor, w.rest);
    EXPECT_LT(w.rest, w.landing);
    EXPECT_LT(w.landing, w.ceiling);
    EXPECT_LT(w.ceiling, w.manifold) << "a tilted face keeps its far points while it settles";
  }
}

TEST(CollisionWindow, OfMetreSizedSolidsIsOneToTwoMillimetres) {
  const CollisionWindow w = windowOf(Solid::box({1, 1, 1}), Solid::box({2, 1, 3}));
  EXPECT_DOUBLE_EQ(w.floor, 0.2e-3);
  EXPECT_DOUBLE_EQ(w.rest, 1e-3);
  EXPECT_DOUBLE_EQ(w.ceiling, 2e-3);
}

TEST(CollisionWindow, ScalesWithTheSmallerWidthUpToAMetre) {
  const CollisionWindow metre = windowOf(Solid::box({1, 1, 1}), Solid::box({1, 1, 1}));
  const CollisionWindow tenth = windowOf(Solid::box({5, 0.1, 3}), Solid::box({1, 1, 1}));
  const CollisionWindow ten = windowOf(Solid::box({10, 10, 10}), Solid::ball(30));
  EXPECT_DOUBLE_EQ(tenth.ceiling, 0.1 * metre.ceiling);
  EXPECT_DOUBLE_EQ(tenth.floor, 0.1 * metre.floor);
  EXPECT_DOUBLE_EQ(ten.ceiling, metre.ceiling);
}

TEST(CollisionWindow, DoesNotDependOnTheOrderOfTheParts) {
  const Solid a = Solid::capsule(0.1, 2.0), b = Solid::box({0.5, 0.4, 3});
  EXPECT_EQ(windowOf(a, b).landing, windowOf(b, a).landing);
  EXPECT_DOUBLE_EQ(windowOf(a, b).rest, 0.2e-3) << "a capsule is as wide as its diameter";
}

}  // namespace
}  // namespace carom
