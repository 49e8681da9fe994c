#include "demos/overlay/v_region_shape.h"

#include <random>

#include <gtest/gtest.h>

#include "engine/closest_features/vclip.h"
#include "engine/solid/convex_hull.h"
#include "tests/support/features.h"

namespace carom::demos {
namespace {

// A wedge-like polyhedron with no two faces parallel or square.
ConvexPolyhedron lump() {
  return ConvexPolyhedron::fromFaces(
      {{-0.5, -0.4, -0.3}, {0.6, -0.45, -0.25}, {0.1, 0.7, -0.35}, {0.05, 0.1, 0.8}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

Feature closestTo(const ConvexPolyhedron& polyhedron, const Vec3& p) {
  const ConvexPart body{polyhedron, 0.0}, point{ConvexPolyhedron::point(Vec3::Zero()), 0.0};
  FeaturePair cold;
  return closestFeatures(body, Pose{}, point, {Quat::Identity(), p}, cold).features.a;
}

// A point inside a side of the region is on its border: a little to either side V-Clip must answer with the
// feature on one, and not on the other.
TEST(RegionShape, EverySideSeparatesTheRegionFromAnother) {
  const ConvexPolyhedron polyhedron = lump();
  int sides = 0;
  for (const Feature& feature : allFeatures(polyhedron))
    for (const std::vector<Vec3>& side : regionShape(polyhedron, feature, 0.5).sides) {
      Vec3 middle = Vec3::Zero();
      for (const Vec3& corner : side) middle += corner / static_cast<double>(side.size());
      const Vec3 normal = (side[1] - side[0]).cross(side[2] - side[0]).normalized();
      for (const Vec3& corner : side) EXPECT_NEAR(normal.dot(corner - side[0]), 0.0, 1e-12) << "plane";
      const bool above = closestTo(polyhedron, middle + 1e-6 * normal) == feature;
      const bool below = closestTo(polyhedron, middle - 1e-6 * normal) == feature;
      EXPECT_NE(above, below) << static_cast<int>(feature.kind) << ' ' << feature.index;
      ++sides;
    }
  EXPECT_EQ(sides, 4 * 3 + 6 * 4 + 4 * 3);
}

TEST(RegionShape, RimsStandAtTheReachFromTheFeature) {
  const ConvexPolyhedron polyhedron = lump();
  const ConvexPart body{polyhedron, 0.0}, point{ConvexPolyhedron::point(Vec3::Zero()), 0.0};
  for (const Feature& feature : allFeatures(polyhedron))
    for (const std::vector<Vec3>& rim : regionShape(polyhedron, feature, 0.5).rims)
      for (const Vec3& p : rim) {
        FeaturePair cold;
        EXPECT_NEAR(closestFeatures(body, Pose{}, point, {Quat::Identity(), p}, cold).distance_m, 0.5, 1e-9);
      }
}

TEST(RegionShape, OfASegmentAreDiscsAtItsEndsAndOfAPointNothing) {
  const ConvexPolyhedron segment = ConvexPolyhedron::segment({0.0, 0.0, -0.4}, {0.0, 0.0, 0.6});
  const RegionShape shape = regionShape(segment, edgeFeature(0), 0.3);
  ASSERT_EQ(shape.sides.size(), 2u);
  for (const Vec3& p : shape.sides[1]) {
    EXPECT_NEAR(p.z(), 0.6, 1e-12);
    EXPECT_NEAR(Vec2(p.x(), p.y()).norm(), 0.3, 1e-12);
  }
  EXPECT_EQ(regionShape(segment, vertexFeature(0), 0.3).sides.size(), 1u);
  EXPECT_TRUE(regionShape(ConvexPolyhedron::point(Vec3::Zero()), vertexFeature(0), 0.3).sides.empty());
}

}  // namespace
}  // namespace carom::demos
