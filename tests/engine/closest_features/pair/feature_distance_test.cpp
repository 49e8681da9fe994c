// The five states by hand: each pair of closed features, its closest points and the lowest features that hold
// them.

#include "engine/closest_features/pair/feature_distance.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/oracle/test_shapes.h"
#include "tests/oracle/witness_certificate.h"

namespace carom {
namespace {

using oracle::Random;

int vertexAt(const ConvexPolyhedron& p, const Vec3& where) {
  for (int v = 0; v < p.vertexCount(); ++v)
    if ((p.vertex(v) - where).norm() < 1e-12) return v;
  return -1;
}
int edgeBetween(const ConvexPolyhedron& p, const Vec3& a, const Vec3& b) {
  const int va = vertexAt(p, a), vb = vertexAt(p, b);
  for (int e = 0; e < p.edgeCount(); ++e)
    if ((p.edge(e).tail == va && p.edge(e).head == vb) || (p.edge(e).tail == vb && p.edge(e).head == va))
      return e;
  return -1;
}
int faceFacing(const ConvexPolyhedron& p, const Vec3& normal) {
  for (int f = 0; f < p.faceCount(); ++f)
    if ((p.plane(f).normal - normal).norm() < 1e-12) return f;
  return -1;
}

class FeatureDistanceOfCubes : public testing::Test {
 protected:
  FeatureDistance at(const Vec3& position, Feature a, Feature b, const Quat& rotation = Quat::Identity()) {
    return featureDistance(PolyhedronPair(cube_, Pose{}, cube_, Pose{rotation, position}), {a, b});
  }
  Feature corner(double x, double y, double z) const { return vertexFeature(vertexAt(cube_, {x, y, z})); }
  Feature edge(const Vec3& a, const Vec3& b) const { return edgeFeature(edgeBetween(cube_, a, b)); }
  Feature face(const Vec3& n) const { return faceFeature(faceFacing(cube_, n)); }

  ConvexPolyhedron cube_ = boxPolyhedron({2, 2, 2});
};

TEST_F(FeatureDistanceOfCubes, VertexVertex_IsTheDistanceOfTheTwo) {
  const FeatureDistance d = at({3, 4, 5}, corner(1, 1, 1), corner(-1, -1, -1));
  EXPECT_NEAR(d.distance(), std::sqrt(1.0 + 4 + 9), 1e-15);
  EXPECT_EQ(d.p_a, Vec3(1, 1, 1));
  EXPECT_EQ(d.p_b, Vec3(2, 3, 4));
}

TEST_F(FeatureDistanceOfCubes, VertexEdge_IsThePerpendicularOrAnEnd) {
  const Feature e = edge({1, 1, -1}, {1, 1, 1});
  const FeatureDistance inside = at({5, 4, 1.5}, e, corner(-1, -1, -1));
  EXPECT_NEAR(inside.distance(), std::hypot(3, 2), 1e-15);
  EXPECT_EQ(inside.features.a, e);
  EXPECT_LT((inside.p_a - Vec3(1, 1, 0.5)).norm(), 1e-15);
  const FeatureDistance beyond = at({5, 4, 4}, e, corner(-1, -1, -1));
  EXPECT_NEAR(beyond.distance(), std::sqrt(9.0 + 4 + 4), 1e-15);
  EXPECT_EQ(beyond.features.a, corner(1, 1, 1)) << "reduced to the edge's end";
}

TEST_F(FeatureDistanceOfCubes, VertexFace_IsTheHeightOrASide) {
  const Feature top = face({0, 0, 1});
  const FeatureDistance over = at({1.5, 1.25, 5}, top, corner(-1, -1, -1));
  EXPECT_NEAR(over.distance(), 3, 1e-15);
  EXPECT_EQ(over.features.a, top);
  EXPECT_FALSE(over.behind);
  const FeatureDistance beside = at({4, 1, 4}, top, corner(-1, -1, -1));
  EXPECT_NEAR(beside.distance(), std::hypot(2, 2), 1e-15);
  EXPECT_EQ(beside.features.a, edge({1, -1, 1}, {1, 1, 1})) << "reduced to the face's side";
  const FeatureDistance under = at({1.5, 1.25, 1.5}, top, corner(-1, -1, -1));
  EXPECT_NEAR(under.distance(), 0.5, 1e-15);
  EXPECT_TRUE(under.behind);
}

TEST_F(FeatureDistanceOfCubes, EdgeEdge_IsTheCommonPerpendicularOrAnEnd) {
  const Feature along_x = edge({-1, 1, 1}, {1, 1, 1}), along_y = edge({-1, -1, -1}, {-1, 1, -1});
  const FeatureDistance crossing = at({1.25, 1.5, 4}, along_x, along_y);
  EXPECT_NEAR(crossing.distance(), 2, 1e-15);
  EXPECT_EQ(crossing.features, (FeaturePair{along_x, along_y}));
  EXPECT_LT((crossing.p_a - Vec3(0.25, 1, 1)).norm(), 1e-15);
  const FeatureDistance past = at({4, 1.5, 4}, along_x, along_y);
  EXPECT_NEAR(past.distance(), std::hypot(2, 2), 1e-15);
  EXPECT_EQ(past.features, (FeaturePair{corner(1, 1, 1), along_y}));
}

TEST_F(FeatureDistanceOfCubes, EdgeFace_KnowsWhetherTheEdgePierces) {
  const Feature top = face({0, 0, 1}), upright = edge({-1, -1, -1}, {-1, -1, 1});
  EXPECT_TRUE(at({1.25, 1.5, 1.5}, top, upright).crossing);
  const FeatureDistance above = at({1.25, 1.5, 2.5}, top, upright);
  EXPECT_FALSE(above.crossing);
  EXPECT_NEAR(above.distance(), 0.5, 1e-15);
  EXPECT_EQ(above.features, (FeaturePair{top, corner(-1, -1, -1)}));
  EXPECT_FALSE(at({3.25, 1.5, 1.5}, top, upright).crossing) << "beside the face";
}

TEST_F(FeatureDistanceOfCubes, ParallelEdges_HaveTheirDistanceWhereverTheyOverlap) {
  const Feature upper = edge({-1, 1, 1}, {1, 1, 1}), lower = edge({-1, -1, -1}, {1, -1, -1});
  for (double shift : {-2.5, -1.0, 0.0, 0.7, 2.0, 2.5}) {
    const double beyond = std::max(std::abs(shift) - 2.0, 0.0);
    EXPECT_NEAR(at({shift, 2, 5}, upper, lower).distance(), std::hypot(3, beyond), 1e-15) << shift;
  }
}

TEST_F(FeatureDistanceOfCubes, AFacePairIsABug) {
  EXPECT_THROW(at({0, 0, 5}, face({0, 0, 1}), face({0, 0, -1})), ContractViolation);
}

// Against the oracle, in general poses and with the roles swapped.
TEST(FeatureDistance, AgreesWithTheOracleForAllEdgesAndIsSymmetric) {
  Random random(41);
  const ConvexPolyhedron p = oracle::randomHull(random, 9), q = oracle::randomHull(random, 12);
  for (int i = 0; i < 20; ++i) {
    const Pose X_WA = random.pose(1), X_WB = random.pose(3);
    const PolyhedronPair pair(p, X_WA, q, X_WB);
    const oracle::PlacedConvex a = oracle::place({p, 0.0}, X_WA), b = oracle::place({q, 0.0}, X_WB);
    for (int e = 0; e < p.edgeCount(); ++e)
      for (int g = 0; g < q.edgeCount(); ++g) {
        const FeaturePair features{edgeFeature(e), edgeFeature(g)};
        const auto& s = a.edges[static_cast<std::size_t>(e)];
        const auto& t = b.edges[static_cast<std::size_t>(g)];
        const double want = static_cast<double>(std::sqrt(oracle::segmentSegmentSquared(
            a.vertices[s[0]], a.vertices[s[1]], b.vertices[t[0]], b.vertices[t[1]])));
        ASSERT_NEAR(featureDistance(pair, features).distance(), want, 1e-14);
        ASSERT_NEAR(featureDistance(pair.swapped(), {features.b, features.a}).distance(), want, 1e-14);
      }
  }
}

}  // namespace
}  // namespace carom
