// Single moves of the walk, from where it must go through a body.

#include "engine/closest_features/separated/feature_walk.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

// The face of a box that looks away from it is a local minimum that a tip over any other face is behind.
TEST(FeatureWalk, BegunBehindABox_EntersItThroughTheFaceThatTheOtherBodyIsOver) {
  oracle::Random random(3301);
  const ConvexPolyhedron box = boxPolyhedron({1, 2, 3}), tip = oracle::randomHull(random, 8);
  for (int f = 0; f < box.faceCount(); ++f) {
    SCOPED_TRACE(f);
    Vec3 middle = Vec3::Zero();
    for (const int v : box.faceVertices(f)) middle += 0.25 * box.vertex(v);
    const Vec3& n = box.plane(f).normal;
    const Feature lowest = vertexFeature(tip.support(-n));
    const Pose X_WT{Quat::Identity(), middle + 0.1 * n - tip.vertex(lowest.index)};
    int opposite = 0;
    while (box.plane(opposite).normal.dot(n) > -0.9) ++opposite;
    const PolyhedronPair ab(box, Pose(), tip, X_WT), ba(tip, X_WT, box, Pose());
    FeatureWalk walk(ab, {faceFeature(opposite), lowest}, 1.0, 1e-15);
    EXPECT_EQ(walk.next(), Move::kTaken);
    EXPECT_EQ(walk.here().features.a, faceFeature(f));
    EXPECT_NEAR(walk.here().distance(), 0.1, 1e-14);
    FeatureWalk swapped(ba, {lowest, faceFeature(opposite)}, 1.0, 1e-15);
    EXPECT_EQ(swapped.next(), Move::kTaken);
    EXPECT_EQ(swapped.here().features.b, faceFeature(f));
    EXPECT_NEAR(swapped.here().distance(), 0.1, 1e-14);
  }
}

}  // namespace
}  // namespace carom
