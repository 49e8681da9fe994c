// The four contact states of paper §2.1 and the point and normal that each becomes, in general poses.

#include "engine/contact/contact_state.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;
using oracle::turned;

struct Contact {
  ClosestFeatures closest;
  ContactPoint point;
};

Contact contactOf(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB) {
  FeaturePair cold;
  const ClosestFeatures closest = closestFeatures(a, X_WA, b, X_WB, cold);
  return {closest, contactPoint(closest, a, X_WA, b, X_WB)};
}

// Two unit boxes, given in a frame that is then moved as a whole.
class ContactStates : public testing::Test {
 protected:
  Contact contact(const Pose& X_FA, const Pose& X_FB) const {
    return contactOf(box_, X_WF_ * X_FA, box_, X_WF_ * X_FB);
  }
  Vec3 inFrame(const Vec3& v_W) const { return X_WF_.rotation.conjugate() * v_W; }
  Vec3 placeInFrame(const Vec3& p_W) const { return X_WF_.inverse() * p_W; }

  const ConvexPart box_{boxPolyhedron({1, 1, 1}), 0.0};
  const Pose X_WF_{turned({1, -2, 3}, 1.1), Vec3(4, 5, -6)};
  // Standing on a corner, and on an edge along y.
  const Quat corner_down_ = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 0, 1));
  const Quat edge_down_ = turned(Vec3::UnitY(), std::numbers::pi / 4);
};

TEST_F(ContactStates, VertexFace_TakesTheFacesNormal) {
  const double half_diagonal = std::sqrt(3.0) / 2;
  const Contact c =
      contact({Quat::Identity(), Vec3(0, 0, -0.5)}, {corner_down_, Vec3(0.1, -0.2, half_diagonal + 0.01)});
  EXPECT_EQ(contactStateOf(c.closest.features), ContactState::kVertexFace);
  EXPECT_LT((inFrame(c.point.n_W) - Vec3::UnitZ()).norm(), 1e-14);
  EXPECT_NEAR(c.point.gap_m, 0.01, 1e-14);
  EXPECT_LT((placeInFrame(c.point.p_W) - Vec3(0.1, -0.2, 0.005)).norm(), 1e-13) << "halfway across the gap";
}

TEST_F(ContactStates, VertexFace_WithTheFaceOnBPointsOutOfATowardsB) {
  const double half_diagonal = std::sqrt(3.0) / 2;
  const Contact c =
      contact({corner_down_, Vec3(0.1, -0.2, half_diagonal + 0.01)}, {Quat::Identity(), Vec3(0, 0, -0.5)});
  EXPECT_EQ(contactStateOf(c.closest.features), ContactState::kVertexFace);
  EXPECT_LT((inFrame(c.point.n_W) + Vec3::UnitZ()).norm(), 1e-14);
}

TEST_F(ContactStates, VertexVertex_TakesTheLineBetweenThem) {
  const double half_diagonal = std::sqrt(3.0) / 2;
  const Vec3 offset(0.003, -0.002, 0.01);
  const Contact c =
      contact({corner_down_, Vec3(0, 0, -half_diagonal)}, {corner_down_, Vec3(0, 0, half_diagonal) + offset});
  EXPECT_EQ(contactStateOf(c.closest.features), ContactState::kVertexVertex);
  EXPECT_LT((inFrame(c.point.n_W) - offset.normalized()).norm(), 1e-12);
  EXPECT_NEAR(c.point.gap_m, offset.norm(), 1e-14);
}

TEST_F(ContactStates, VertexEdge_PointsFromTheEdgeToTheVertexAcrossTheEdge) {
  const double half_diagonal = std::sqrt(3.0) / 2;
  const Vec3 offset(0.002, 0.2, 0.01);  // along y the edge has no say
  const Contact c =
      contact({edge_down_, Vec3(0, 0, -std::sqrt(0.5))}, {corner_down_, Vec3(0, 0, half_diagonal) + offset});
  EXPECT_EQ(contactStateOf(c.closest.features), ContactState::kVertexEdge);
  EXPECT_LT((inFrame(c.point.n_W) - Vec3(0.002, 0, 0.01).normalized()).norm(), 1e-12);
  EXPECT_NEAR(c.point.gap_m, std::hypot(0.002, 0.01), 1e-14);
}

TEST_F(ContactStates, EdgeEdge_TakesTheProductOfTheEdgesTurnedOutwards) {
  const Quat across = turned(Vec3::UnitZ(), 1.0) * edge_down_;
  const double s = std::sqrt(0.5);
  for (const Vec3& shift : {Vec3(0.2, 0.1, 0.01), Vec3(-0.1, -0.3, 0.02)}) {
    const Contact up = contact({edge_down_, Vec3(0, 0, -s)}, {across, Vec3(0, 0, s) + shift});
    EXPECT_EQ(contactStateOf(up.closest.features), ContactState::kEdgeEdge);
    EXPECT_LT((inFrame(up.point.n_W) - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(up.point.gap_m, shift.z(), 1e-13);
    const Contact down = contact({across, Vec3(0, 0, s) + shift}, {edge_down_, Vec3(0, 0, -s)});
    EXPECT_LT((inFrame(down.point.n_W) + Vec3::UnitZ()).norm(), 1e-12);
  }
}

TEST(ContactPoint, OfAnySeparatedPairSpansTheGapFromAToB) {
  Random random(54);
  int seen[4] = {};
  for (int i = 0; i < 3000; ++i) {
    const ConvexPart a{oracle::randomHull(random, 10), 0.0}, b{oracle::randomHull(random, 8), 0.0};
    const Pose X_WA = random.pose(1), X_WB = {random.rotation(), 2.1 * random.direction()};
    const Contact c = contactOf(a, X_WA, b, X_WB);
    if (c.closest.distance_m < 1e-3) continue;
    ++seen[static_cast<int>(contactStateOf(c.closest.features))];
    ASSERT_NEAR(c.point.n_W.norm(), 1.0, 1e-14) << i;
    // Witnesses in each other's V-regions: face normal and edge product lie along the line between them.
    ASSERT_LT((c.closest.p_A_W + c.point.gap_m * c.point.n_W - c.closest.p_B_W).norm(), 1e-11) << i;
    ASSERT_LT((c.point.p_W - 0.5 * (c.closest.p_A_W + c.closest.p_B_W)).norm(), 1e-15) << i;
  }
  for (int state = 0; state < 4; ++state)
    EXPECT_GT(seen[state], 20) << contactStateName(static_cast<ContactState>(state));
}

TEST(ContactPoint, OfBallsAndCapsulesCountsTheirRoundness) {
  const ConvexPart ball{ConvexPolyhedron::point(Vec3::Zero()), 0.3},
      capsule{ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.2};
  const Contact c = contactOf(capsule, Pose{}, ball, {Quat::Identity(), Vec3(0.6, 0.0, 0.4)});
  EXPECT_EQ(contactStateOf(c.closest.features), ContactState::kVertexEdge);
  EXPECT_NEAR(c.point.gap_m, 0.1, 1e-15);
  EXPECT_LT((c.point.n_W - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((c.point.p_W - Vec3(0.25, 0, 0.4)).norm(), 1e-15);
}

TEST(ContactState, HasANameForEachPairOfFeatures) {
  EXPECT_STREQ(contactStateName(contactStateOf({vertexFeature(0), vertexFeature(0)})), "V-V");
  EXPECT_STREQ(contactStateName(contactStateOf({edgeFeature(0), vertexFeature(0)})), "V-E");
  EXPECT_STREQ(contactStateName(contactStateOf({vertexFeature(0), edgeFeature(0)})), "V-E");
  EXPECT_STREQ(contactStateName(contactStateOf({faceFeature(0), vertexFeature(0)})), "V-F");
  EXPECT_STREQ(contactStateName(contactStateOf({vertexFeature(0), faceFeature(0)})), "V-F");
  EXPECT_STREQ(contactStateName(contactStateOf({edgeFeature(0), edgeFeature(0)})), "E-E");
}

}  // namespace
}  // namespace carom
