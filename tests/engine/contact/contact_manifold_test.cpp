// Multi-point contact against polygon clipping by brute force, and the special cases of §2.4 one by one.

#include "engine/contact/contact_manifold.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <utility>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;
using oracle::turned;

ContactManifold manifoldOf(const Solid& a, const Pose& X_WA, const Solid& b, const Pose& X_WB) {
  FeaturePair cold;
  const ConvexPart &pa = a.parts()[0], &pb = b.parts()[0];
  const ClosestFeatures closest = closestFeatures(pa, X_WA, pb, X_WB, cold);
  return contactManifold(closest, {pa, X_WA, pb, X_WB}, collisionWindow(pa, pb));
}

template <typename Manifold>
concept ShowsPointsOfATemporary = requires(Manifold m) {
  std::move(m).view();
};
static_assert(!ShowsPointsOfATemporary<ContactManifold>);

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool inside(const std::vector<Vec2>& polygon, const Vec2& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]) < 0) return false;
  return true;
}

// The corners of the common part of two convex polygons (counter-clockwise): corners inside the other, and
// crossings.
std::vector<Vec2> commonCorners(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
  std::vector<Vec2> corners;
  for (const Vec2& c : p)
    if (inside(q, c)) corners.push_back(c);
  for (const Vec2& c : q)
    if (inside(p, c)) corners.push_back(c);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) {
      const Vec2 d = p[(i + 1) % p.size()] - p[i], e = q[(j + 1) % q.size()] - q[j];
      const double area = cross(d, e);
      if (std::abs(area) < 1e-12) continue;
      const double s = cross(q[j] - p[i], e) / area, t = cross(q[j] - p[i], d) / area;
      if (s > 0 && s < 1 && t > 0 && t < 1) corners.push_back(p[i] + s * d);
    }
  return corners;
}

std::vector<Vec2> rectangle(const Vec2& size, const Vec2& center, double angle) {
  std::vector<Vec2> corners;
  for (const auto& [x, y] :
       {std::pair{-0.5, -0.5}, std::pair{0.5, -0.5}, std::pair{0.5, 0.5}, std::pair{-0.5, 0.5}})
    corners.push_back(center + Eigen::Rotation2Dd(angle) * Vec2(x * size.x(), y * size.y()));
  return corners;
}

double quadArea(const ContactManifold& m) {
  double largest = 0.0;  // over the orders in which four points can go round
  const auto p = [&](int i) { return m.points[static_cast<std::size_t>(i)].p_W; };
  for (const auto& o : {std::array{0, 1, 2, 3}, std::array{0, 2, 1, 3}, std::array{0, 1, 3, 2}})
    largest = std::max(largest, 0.5 * ((p(o[2]) - p(o[0])).cross(p(o[3]) - p(o[1]))).norm());
  return largest;
}

// Every point must stand half its gap off both bodies.
void expectPointsBetweenTheFaces(const ContactManifold& m, const Pose& X_WF, double top_of_a,
                                 double bottom_of_b) {
  for (const ManifoldPoint& p : m.view()) {
    const Vec3 on_a = X_WF.inverse() * (p.p_W - 0.5 * p.gap_m * p.n_W),
               on_b = X_WF.inverse() * (p.p_W + 0.5 * p.gap_m * p.n_W);
    EXPECT_NEAR(on_a.z(), top_of_a, 1e-13);
    EXPECT_NEAR(on_b.z(), bottom_of_b, 1e-13);
  }
}

TEST(ContactManifold, OfBoxOnBox_IsTheCommonPartOfTheirFaces) {
  const std::uint64_t seed = 81;
  Random random(seed);
  const double gap = 1e-3;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Pose X_WF = random.pose(5);
    const Vec2 size_a(random.uniform(0.5, 2), random.uniform(0.5, 2)),
        size_b(random.uniform(0.5, 2), random.uniform(0.5, 2));
    const Vec2 shift(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8));
    const double angle = random.uniform(-3, 3);
    const std::vector<Vec2> expected =
        commonCorners(rectangle(size_a, Vec2::Zero(), 0), rectangle(size_b, shift, angle));
    if (expected.size() < 3) continue;
    const Solid a = Solid::box({size_a.x(), size_a.y(), 1}), b = Solid::box({size_b.x(), size_b.y(), 1});
    const ContactManifold m =
        manifoldOf(a, X_WF * Pose{Quat::Identity(), Vec3(0, 0, -0.5)}, b,
                   X_WF * Pose{turned(Vec3::UnitZ(), angle), Vec3(shift.x(), shift.y(), 0.5 + gap)});
    ASSERT_EQ(m.count, std::min<int>(4, static_cast<int>(expected.size())));
    std::set<std::uint64_t> ids;
    for (const ManifoldPoint& p : m.view()) {
      const Vec3 p_F = X_WF.inverse() * p.p_W;
      double nearest = 1e9;
      for (const Vec2& c : expected) nearest = std::min(nearest, (c - p_F.head<2>()).norm());
      EXPECT_LT(nearest, 1e-12);
      EXPECT_NEAR(p.gap_m, gap, 1e-13);
      EXPECT_LT((p.n_W - X_WF.rotation * Vec3::UnitZ()).norm(), 1e-14);
      ids.insert(p.id);
    }
    EXPECT_EQ(static_cast<int>(ids.size()), m.count) << "each point has an id of its own";
    expectPointsBetweenTheFaces(m, X_WF, 0.0, gap);
  }
}

TEST(ContactManifold, OfAnOctagon_KeepsMostOfItsArea) {
  // Unit squares, one turned by 45 degrees: a regular octagon of width 1, area 8 (sqrt 2 - 1) / 4 = 0.828.
  for (double degrees : {30.0, 45.0}) {
    const ContactManifold m =
        manifoldOf(Solid::box({1, 1, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, Solid::box({1, 1, 1}),
                   {turned(Vec3::UnitZ(), degrees * std::numbers::pi / 180), Vec3(0, 0, 0.501)});
    ASSERT_EQ(m.count, 4);
    EXPECT_GT(quadArea(m),
              0.6 * 0.828);  // the largest quadrilateral in a regular octagon has 1 / sqrt 2 of it
  }
}

TEST(ContactManifold, OfATiltedBox_KeepsTheDeepestPointAndTheGapsOfEach) {
  Random random(82);
  for (int i = 0; i < 200; ++i) {
    const Quat tilt =
        turned(random.direction(), random.uniform(0, 1.5e-3)) * turned(Vec3::UnitZ(), random.uniform(0, 3));
    const Solid b = Solid::box({1, 0.8, 0.6});
    double lowest = 0;
    for (const Vec3& v : b.parts()[0].core.vertices()) lowest = std::min(lowest, (tilt * v).z());
    const Pose X_WB{tilt, Vec3(0.1, -0.2, -lowest + 0.5e-3)};
    const ContactManifold m =
        manifoldOf(Solid::box({10, 10, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, b, X_WB);
    ASSERT_GE(m.count, 4) << i;
    double least = 1;
    for (const ManifoldPoint& p : m.view()) {
      least = std::min(least, p.gap_m);
      const Vec3 on_b = X_WB.inverse() * (p.p_W + 0.5 * p.gap_m * p.n_W);
      // The reference is the floor's face or the box's; the other face is within the tilt of it.
      EXPECT_NEAR(std::abs(on_b.z()), 0.3, 1e-5) << i;
    }
    EXPECT_NEAR(least, 0.5e-3, 2e-9) << i;
  }
}

TEST(ContactManifold, OfManyPoints_KeepsTheDeepestAmongTheFour) {
  Random random(85);
  const Solid wheel = Solid::polyhedron(oracle::prism(24, 0.5, 0.3));
  for (int i = 0; i < 200; ++i) {
    const Quat tilt = turned(random.direction(), random.uniform(1e-4, 1.5e-3)) *
                      turned(Vec3::UnitZ(), random.uniform(0, 3));
    double lowest = 0;
    for (const Vec3& v : wheel.parts()[0].core.vertices()) lowest = std::min(lowest, (tilt * v).z());
    const ContactManifold m = manifoldOf(Solid::box({10, 10, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, wheel,
                                         {tilt, Vec3(0.1, -0.2, -lowest + 0.2e-3)});
    ASSERT_GE(m.count, 4) << i;
    double least = 1;
    for (int k = 0; k < 4; ++k) least = std::min(least, m.points[static_cast<std::size_t>(k)].gap_m);
    EXPECT_NEAR(least, 0.2e-3, 2e-9) << i;
    EXPECT_GT(quadArea(m), 0.4) << "a square in the circle of radius 0.5 has 0.5";
  }
}

TEST(ContactManifold, OfABoxTiltedOutOfReach_IsTheEdgeThatIsNear) {
  const Quat tilt = turned(Vec3::UnitY(), 0.05);  // the far edge is 50 mm up, k is 5 mm
  const double lowest = 0.5 * std::sin(0.05) + 0.3 * std::cos(0.05);
  const ContactManifold m = manifoldOf(Solid::box({10, 10, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)},
                                       Solid::box({1, 0.8, 0.6}), {tilt, Vec3(0, 0, lowest + 1e-3)});
  int near = 0;
  for (const ManifoldPoint& p : m.view()) {
    EXPECT_LT(p.gap_m, 5.0001e-3);
    near += std::abs(p.gap_m - 1e-3) < 1e-9;
  }
  EXPECT_EQ(near, 2);
}

// Contacts of a step look so high as a corner could come down from within it: a small part leans below that.
TEST(ContactManifold, OfABoxThatLeansWithAllOfItInReach_IsItsWholeFace) {
  const Solid floor = Solid::box({1.0, 1.0, 0.1}), plate = Solid::box({0.002, 0.0007, 0.0001});
  const Pose X_WA{Quat::Identity(), Vec3(0, 0, -0.05)};
  for (const double degrees : {8.0, 20.0, 40.0}) {
    const double lean = degrees * std::numbers::pi / 180.0;
    const double half = 0.00035 * std::sin(lean) + 0.00005 * std::cos(lean);
    const Pose X_WB{turned(Vec3::UnitX(), lean), Vec3(0, 0, half + 1e-6)};
    FeaturePair cold;
    const ConvexPart &a = floor.parts()[0], &b = plate.parts()[0];
    const ClosestFeatures closest = closestFeatures(a, X_WA, b, X_WB, cold);
    CollisionWindow window = collisionWindow(a, b);
    window.manifold = 0.002;
    EXPECT_EQ(contactManifold(closest, {a, X_WA, b, X_WB}, window).count, 4) << degrees;
    window.manifold = 0.1 * half;
    EXPECT_EQ(contactManifold(closest, {a, X_WA, b, X_WB}, window).count, 2) << degrees;
  }
}

TEST(ContactManifold, OfAnEdgeOnAFace_IsItsTwoEnds) {
  const Quat edge_down = turned(Vec3::UnitZ(), 0.3) * turned(Vec3::UnitY(), std::numbers::pi / 4);
  const ContactManifold m =
      manifoldOf(Solid::box({10, 10, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, Solid::box({1, 0.8, 1}),
                 {edge_down, Vec3(0.2, 0.1, std::sqrt(0.5) + 1e-3)});
  ASSERT_EQ(m.count, 2);
  const Vec3 half = turned(Vec3::UnitZ(), 0.3) * Vec3(0, 0.4, 0);
  for (const ManifoldPoint& p : m.view()) {
    EXPECT_NEAR(p.gap_m, 1e-3, 1e-14);
    const Vec3 r = p.p_W - Vec3(0.2, 0.1, 0.5e-3);
    EXPECT_LT(std::min((r - half).norm(), (r + half).norm()), 1e-13);
  }
}

TEST(ContactManifold, OfAnEdgeThatReachesBeyondTheFace_IsClippedAtTheRim) {
  const Quat edge_down = turned(Vec3::UnitY(), std::numbers::pi / 4);
  const ContactManifold m =
      manifoldOf(Solid::box({2, 0.5, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, Solid::box({1, 3, 1}),
                 {edge_down, Vec3(0, 0.1, std::sqrt(0.5) + 1e-3)});
  ASSERT_EQ(m.count, 2);
  for (const ManifoldPoint& p : m.view()) EXPECT_NEAR(std::abs(p.p_W.y()), 0.25, 1e-14);
}

TEST(ContactManifold, OfACapsuleLyingOnTheFloor_IsTwoPointsUnderItsEnds) {
  const Quat lying = turned(Vec3::UnitZ(), 0.7) * turned(Vec3::UnitY(), std::numbers::pi / 2);
  const ContactManifold m = manifoldOf(Solid::box({10, 10, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)},
                                       Solid::capsule(0.2, 1.0), {lying, Vec3(0, 0, 0.2 + 1e-4)});
  ASSERT_EQ(m.count, 2);
  const Vec3 half = turned(Vec3::UnitZ(), 0.7) * Vec3(0.5, 0, 0);
  for (const ManifoldPoint& p : m.view()) {
    EXPECT_NEAR(p.gap_m, 1e-4, 1e-14);
    EXPECT_LT((p.n_W - Vec3::UnitZ()).norm(), 1e-14);
    const Vec3 r = p.p_W - Vec3(0, 0, 0.5e-4);
    EXPECT_LT(std::min((r - half).norm(), (r + half).norm()), 1e-13);
  }
}

TEST(ContactManifold, OfParallelCapsules_IsTheStretchTheyShare) {
  const Pose X_WF{turned({1, 2, 3}, 0.9), Vec3(1, 2, 3)};
  const ContactManifold m = manifoldOf(Solid::capsule(0.2, 1.0), X_WF, Solid::capsule(0.3, 1.0),
                                       X_WF * Pose{Quat::Identity(), Vec3(0.501, 0, 0.4)});
  ASSERT_EQ(m.count, 2);
  double low = 1e9, high = -1e9;
  for (const ManifoldPoint& p : m.view()) {
    EXPECT_NEAR(p.gap_m, 1e-3, 1e-13);
    EXPECT_LT((p.n_W - X_WF.rotation * Vec3::UnitX()).norm(), 1e-13);
    low = std::min(low, (X_WF.inverse() * p.p_W).z());
    high = std::max(high, (X_WF.inverse() * p.p_W).z());
  }
  EXPECT_NEAR(low, -0.1, 1e-13);
  EXPECT_NEAR(high, 0.5, 1e-13);
}

TEST(ContactManifold, OfWhatMeetsInAPoint_IsThatPoint) {
  const Quat corner_down = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 0, 1));
  const double half_diagonal = std::sqrt(3.0) / 2;
  const Solid box = Solid::box({1, 1, 1}), ground = Solid::box({10, 10, 1});
  const Pose under{Quat::Identity(), Vec3(0, 0, -0.5)};
  EXPECT_EQ(manifoldOf(ground, under, box, {corner_down, Vec3(0, 0, half_diagonal + 1e-3)}).count, 1)
      << "corner on face";
  EXPECT_EQ(manifoldOf(ground, under, Solid::ball(0.5), {Quat::Identity(), Vec3(0, 0, 0.501)}).count, 1)
      << "ball on face";
  EXPECT_EQ(manifoldOf(box, {corner_down, Vec3(0, 0, -half_diagonal)}, box,
                       {corner_down, Vec3(0, 0, half_diagonal + 1e-3)})
                .count,
            1)
      << "corner on corner";
  const Quat edge_down = turned(Vec3::UnitY(), std::numbers::pi / 4);
  const ContactManifold crossed =
      manifoldOf(box, {edge_down, Vec3(0, 0, -std::sqrt(0.5))}, box,
                 {turned(Vec3::UnitZ(), 1.2) * edge_down, Vec3(0, 0, std::sqrt(0.5) + 1e-3)});
  ASSERT_EQ(crossed.count, 1) << "crossed edges";
  EXPECT_LT((crossed.points[0].p_W - Vec3(0, 0, 0.5e-3)).norm(), 1e-13);
  EXPECT_EQ(manifoldOf(Solid::capsule(0.2, 1), Pose{}, Solid::capsule(0.2, 1),
                       {turned(Vec3::UnitX(), 1.0), Vec3(0.401, 0, 0)})
                .count,
            1);
}

TEST(ContactManifold, AlwaysHoldsTheClosestDistance) {
  const std::uint64_t seed = 83;
  Random random(seed);
  for (int i = 0; i < 2000; ++i) {
    const Solid a = Solid::polyhedron(oracle::randomHull(random, random.integer(4, 12)));
    const Solid b = i % 2 ? Solid::box({1, 0.5, 0.8}) : Solid::polyhedron(oracle::randomHull(random, 8));
    const Pose X_WA{random.rotation(), Vec3::Zero()};
    Pose X_WB{random.rotation(), 5 * random.direction()};
    FeaturePair cold;
    ClosestFeatures closest = closestFeatures(a.parts()[0], X_WA, b.parts()[0], X_WB, cold);
    X_WB.position -= (closest.distance_m - 1e-3) * closest.n_W;
    cold = {};
    closest = closestFeatures(a.parts()[0], X_WA, b.parts()[0], X_WB, cold);
    const ContactManifold m = contactManifold(closest, {a.parts()[0], X_WA, b.parts()[0], X_WB},
                                              collisionWindow(a.parts()[0], b.parts()[0]));
    ASSERT_GE(m.count, 1);
    ASSERT_LE(m.count, ContactManifold::kMaxPoints);
    double least = 1;
    for (const ManifoldPoint& p : m.view()) {
      least = std::min(least, p.gap_m);
      ASSERT_NEAR(p.n_W.norm(), 1.0, 1e-12);
      ASSERT_GT(p.n_W.dot(closest.n_W), 0.99) << "seed " << seed << " case " << i;
    }
    ASSERT_LE(least, closest.distance_m + 1e-6) << "seed " << seed << " case " << i;
    ASSERT_GE(least, closest.distance_m - 1e-12) << "no point is nearer than the bodies are";
  }
}

// A box that lies across another, turned by an eighth, has eight corners of contact. Which four are chosen
// depends on how it leans, but those that were chosen before stay, and the closest point is there besides.
TEST(ContactManifold, OfManyCorners_KeepsTheFormerFourAndTheClosestPoint) {
  const Solid box = Solid::box({1, 1, 1});
  const ConvexPart& part = box.parts()[0];
  const Pose X_WA{Quat::Identity(), Vec3(0, 0, -0.5)};
  const auto leaning = [](const Vec3& axis) {
    return Pose{turned(axis, 1e-5) * turned(Vec3::UnitZ(), std::numbers::pi / 4), Vec3(0, 0, 0.501)};
  };
  const auto idsOf = [](const ContactManifold& m) {
    std::set<std::uint64_t> ids;
    for (const ManifoldPoint& p : m.view()) ids.insert(p.id);
    return ids;
  };
  const ContactManifold before = manifoldOf(box, X_WA, box, leaning(Vec3::UnitX()));
  const Vec3 elsewhere = Vec3(0.38, 0.92, 0).normalized();
  const Pose X_WB = leaning(elsewhere);
  FeaturePair cold;
  const ClosestFeatures closest = closestFeatures(part, X_WA, part, X_WB, cold);
  const CollisionWindow window = collisionWindow(part, part);
  std::vector<std::uint64_t> former;
  for (const ManifoldPoint& p : before.view()) former.push_back(p.id);
  ASSERT_EQ(former.size(), 4u);
  const ContactManifold fresh = contactManifold(closest, {part, X_WA, part, X_WB}, window);
  const ContactManifold now = contactManifold(closest, {part, X_WA, part, X_WB}, window, former);
  ASSERT_NE(idsOf(fresh), idsOf(before)) << "nothing would change";
  double least = 1.0;
  for (const ManifoldPoint& p : now.view()) least = std::min(least, p.gap_m);
  EXPECT_NEAR(least, closest.distance_m, 1e-9);
  const std::set<std::uint64_t> ids = idsOf(now);
  for (const std::uint64_t id : former) EXPECT_TRUE(ids.contains(id)) << id;
  EXPECT_EQ(now.count, 5);
  // What leans beyond the band in which gaps are alike is another contact.
  const Pose X_WTilted{turned(elsewhere, 1e-3) * turned(Vec3::UnitZ(), std::numbers::pi / 4),
                       Vec3(0, 0, 0.5015)};
  const ClosestFeatures tilted = closestFeatures(part, X_WA, part, X_WTilted, cold);
  EXPECT_EQ(idsOf(contactManifold(tilted, {part, X_WA, part, X_WTilted}, window, former)),
            idsOf(contactManifold(tilted, {part, X_WA, part, X_WTilted}, window)));
}

TEST(ContactManifold, IdsStayWhenTheBodiesMoveALittle) {
  Random random(84);
  const Solid a = Solid::box({2, 2, 1}), b = Solid::box({1, 0.7, 0.5});
  const Pose X_WA{Quat::Identity(), Vec3(0, 0, -0.5)};
  const auto idsAt = [&](const Pose& X_WB) {
    std::set<std::uint64_t> ids;
    for (const ManifoldPoint& p : manifoldOf(a, X_WA, b, X_WB)) ids.insert(p.id);
    return ids;
  };
  // Hanging over the rim by a third, so that two corners are cut by the face's sides.
  const Pose X_WB{turned(Vec3::UnitZ(), 0.1), Vec3(0.8, 0.1, 0.251)};
  const std::set<std::uint64_t> ids = idsAt(X_WB);
  EXPECT_EQ(ids.size(), 4u);
  for (int i = 0; i < 100; ++i) {
    Pose moved = X_WB;
    moved.position += 1e-3 * random.direction().cwiseProduct(Vec3(1, 1, 0.1));
    moved.rotation = turned(Vec3::UnitZ(), random.uniform(-1e-3, 1e-3)) * turned(random.direction(), 1e-6) *
                     moved.rotation;
    EXPECT_EQ(idsAt(moved), ids) << i;
  }
}

}  // namespace
}  // namespace carom
