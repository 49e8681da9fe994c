// V-regions: which neighbour a direction asks for, and which directions lead inwards.

#include "engine/closest_features/pair/v_region.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

Vec3 inner(const ConvexPolyhedron& p, Feature f) {
  if (f.kind == FeatureKind::kVertex) return p.vertex(f.index);
  if (f.kind == FeatureKind::kEdge)
    return 0.5 * (p.vertex(p.edge(f.index).tail) + p.vertex(p.edge(f.index).head));
  Vec3 center = Vec3::Zero();
  for (int v : p.faceVertices(f.index))
    center += p.vertex(v) / static_cast<double>(p.faceVertices(f.index).size());
  return center;
}

// Directions in the cone of the normals around a feature, and their opposites.
template <typename Check>
void forDirectionsAt(const ConvexPolyhedron& p, Check&& check) {
  Random random(51);
  const auto mixOf = [&](const std::vector<int>& faces) {
    Vec3 sum = Vec3::Zero();
    for (int f : faces) sum += random.uniform(0.05, 1.0) * p.plane(f).normal;
    return sum;
  };
  for (int v = 0; v < p.vertexCount(); ++v) {
    std::vector<int> faces;
    for (const Spoke& spoke : p.spokes(v)) {
      const Edge& edge = p.edge(spoke.edge);
      faces.push_back(edge.tail == v ? edge.left : edge.right);
    }
    check(vertexFeature(v), mixOf(faces));
  }
  for (int e = 0; e < p.edgeCount(); ++e) check(edgeFeature(e), mixOf({p.edge(e).left, p.edge(e).right}));
  for (int f = 0; f < p.faceCount(); ++f) check(faceFeature(f), p.plane(f).normal);
}

TEST(VRegion, HoldsTheConeOfTheNormalsAroundItsFeature) {
  for (const ConvexPolyhedron& p :
       {boxPolyhedron({1, 2, 3}), oracle::dodecahedron(), oracle::prism(60, 1, 2)})
    forDirectionsAt(p, [&](Feature feature, const Vec3& direction) {
      EXPECT_LE(steepestWayOff(p, feature, direction).slope, 1e-15 * direction.norm());
      EXPECT_FALSE(pointsInward(p, feature, direction));
    });
}

TEST(VRegion, NamesANeighbourThatIsCloserToWhatTheDirectionPointsAt) {
  Random random(52);
  const ConvexPolyhedron p = oracle::dodecahedron();
  int asked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Feature feature = i % 2 ? vertexFeature(random.integer(0, 19)) : edgeFeature(random.integer(0, 29));
    const Vec3 direction = random.direction();
    const WayOff way = steepestWayOff(p, feature, direction);
    if (way.slope <= 0.0) continue;
    const Feature next = way.neighbour;
    ++asked;
    EXPECT_EQ(static_cast<int>(next.kind), static_cast<int>(feature.kind) + 1) << "one dimension up";
    const Vec3 from = inner(p, feature), step = 1e-6 * (inner(p, next) - from);
    // Towards the neighbour's middle, less the part along the feature itself, the target comes nearer.
    Vec3 off = step;
    if (feature.kind == FeatureKind::kEdge)
      off -= off.dot(p.edge(feature.index).direction) * p.edge(feature.index).direction;
    EXPECT_LT((direction - off).norm(), direction.norm());
  }
  EXPECT_GT(asked, 1000);
}

TEST(VRegion, ScaleOfTheDirectionDoesNotMatter) {
  Random random(53);
  const ConvexPolyhedron p = oracle::icosahedron();
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction = random.direction();
    const Feature feature = vertexFeature(random.integer(0, 11));
    EXPECT_EQ(steepestWayOff(p, feature, direction).neighbour,
              steepestWayOff(p, feature, 0x1p-40 * direction).neighbour);
  }
}

// The edge across a face of two triangles has V-planes that the inward normal passes as well as the outward
// one.
TEST(PointsInward, TellsOutFromInAtTheFlatEdgesOfCoplanarFaces) {
  const ConvexPolyhedron box = oracle::triangulatedBox({1, 1, 1});
  int flat = 0;
  for (int e = 0; e < box.edgeCount(); ++e) {
    const Vec3& n = box.plane(box.edge(e).left).normal;
    if ((n - box.plane(box.edge(e).right).normal).norm() > 1e-9) continue;
    ++flat;
    EXPECT_LE(steepestWayOff(box, edgeFeature(e), -n).slope, 1e-15);
    EXPECT_TRUE(pointsInward(box, edgeFeature(e), -n));
    EXPECT_FALSE(pointsInward(box, edgeFeature(e), n));
  }
  EXPECT_EQ(flat, 6);
}

TEST(PointsInward, IsNeverSoForAPointOrASegment) {
  EXPECT_FALSE(pointsInward(ConvexPolyhedron::point({0, 0, 0}), vertexFeature(0), {1, 2, 3}));
  const ConvexPolyhedron segment = ConvexPolyhedron::segment({0, 0, 0}, {1, 0, 0});
  EXPECT_FALSE(pointsInward(segment, edgeFeature(0), {0, 2, 3}));
  EXPECT_FALSE(pointsInward(segment, vertexFeature(1), {1, 2, 3}));
}

TEST(VRegion, OfASegmentIsTheSlabBetweenItsEnds) {
  const ConvexPolyhedron segment = ConvexPolyhedron::segment({0, 0, 0}, {2, 0, 0});
  EXPECT_LE(steepestWayOff(segment, edgeFeature(0), {0, 1, 1}).slope, 1e-15);
  EXPECT_LE(steepestWayOff(segment, vertexFeature(1), {1, 1, 0}).slope, 1e-15);
  EXPECT_EQ(steepestWayOff(segment, vertexFeature(1), {-0.1, 1, 0}).neighbour, edgeFeature(0));
}

}  // namespace
}  // namespace carom
