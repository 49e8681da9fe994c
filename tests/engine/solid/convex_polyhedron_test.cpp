// The neighbourhood invariants of a polyhedron, its support and width against brute force, and what it
// refuses.

#include "engine/solid/convex_polyhedron.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/foundation/contract.h"
#include "engine/solid/convex_hull.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/thrown_message.h"

namespace carom {
namespace {

using oracle::Random;

std::vector<ConvexPolyhedron> population() {
  Random random(31);
  std::vector<ConvexPolyhedron> all{boxPolyhedron({1, 2, 3}),    oracle::triangulatedBox({1, 2, 3}),
                                    oracle::tetrahedron(),       oracle::octahedron(),
                                    oracle::icosahedron(),       oracle::dodecahedron(),
                                    oracle::prism(60, 1.0, 0.2), oracle::prism(200, 0.5, 3.0)};
  for (int n : {4, 5, 8, 20, 62, 252}) all.push_back(oracle::randomHull(random, n));
  all.push_back(oracle::randomHull(random, 40, Vec3(1, 1e-3, 1e-3)));
  return all;
}

TEST(ConvexPolyhedron, SatisfiesEuler) {
  for (const ConvexPolyhedron& p : population())
    EXPECT_EQ(p.vertexCount() - p.edgeCount() + p.faceCount(), 2);
}

TEST(ConvexPolyhedron, EveryEdgeKnowsItsFacesAndTheyKnowIt) {
  for (const ConvexPolyhedron& p : population()) {
    std::vector<int> uses(static_cast<std::size_t>(p.edgeCount()), 0);
    for (int f = 0; f < p.faceCount(); ++f) {
      const std::span<const int> vertices = p.faceVertices(f), edges = p.faceEdges(f);
      ASSERT_EQ(vertices.size(), edges.size());
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& e = p.edge(edges[i]);
        const int from = vertices[i], to = vertices[(i + 1) % vertices.size()];
        ++uses[static_cast<std::size_t>(edges[i])];
        if (e.left == f) {
          EXPECT_EQ(e.tail, from);
          EXPECT_EQ(e.head, to);
        } else {
          EXPECT_EQ(e.right, f);
          EXPECT_EQ(e.head, from);
          EXPECT_EQ(e.tail, to);
        }
        EXPECT_EQ(p.faceAcross(edges[i], f), e.left == f ? e.right : e.left);
      }
    }
    for (int count : uses) EXPECT_EQ(count, 2);
  }
}

TEST(ConvexPolyhedron, EveryVertexKnowsExactlyItsEdgesAndWhereTheyLead) {
  for (const ConvexPolyhedron& p : population()) {
    int listed = 0;
    for (int v = 0; v < p.vertexCount(); ++v)
      for (const Spoke& spoke : p.spokes(v)) {
        const Edge& edge = p.edge(spoke.edge);
        EXPECT_TRUE(edge.tail == v || edge.head == v);
        EXPECT_EQ(spoke.head, edge.tail == v ? edge.head : edge.tail);
        EXPECT_EQ(spoke.direction, edge.tail == v ? edge.direction : -edge.direction);
        ++listed;
      }
    EXPECT_EQ(listed, 2 * p.edgeCount());
  }
}

TEST(ConvexPolyhedron, IntoFaceDirections_PointFromTheEdgeIntoItsFace) {
  for (const ConvexPolyhedron& p : population())
    for (int i = 0; i < p.edgeCount(); ++i)
      for (int f : {p.edge(i).left, p.edge(i).right}) {
        const Vec3& into = p.intoFace(i, f);
        EXPECT_NEAR(into.norm(), 1.0, 1e-14);
        EXPECT_NEAR(into.dot(p.edge(i).direction), 0.0, 1e-14);
        EXPECT_NEAR(into.dot(p.plane(f).normal), 0.0, 1e-14);
        Vec3 center = Vec3::Zero();
        for (int v : p.faceVertices(f)) center += p.vertex(v) / static_cast<double>(p.faceVertices(f).size());
        EXPECT_GT(into.dot(center - p.vertex(p.edge(i).tail)), 0.0);
      }
}

TEST(ConvexPolyhedron, EdgesRunFromTailToHead) {
  for (const ConvexPolyhedron& p : population())
    for (int i = 0; i < p.edgeCount(); ++i) {
      const Edge& e = p.edge(i);
      EXPECT_LT((p.vertex(e.tail) + e.length_m * e.direction - p.vertex(e.head)).norm(), 1e-14);
    }
}

TEST(ConvexPolyhedron, AllOfItLiesBehindEveryFace) {
  for (const ConvexPolyhedron& p : population())
    for (int f = 0; f < p.faceCount(); ++f) {
      EXPECT_NEAR(p.plane(f).normal.norm(), 1.0, 1e-15);
      for (const Vec3& v : p.vertices()) EXPECT_LE(p.plane(f).signedDistance(v), 1e-10);
      for (int v : p.faceVertices(f)) EXPECT_NEAR(p.plane(f).signedDistance(p.vertex(v)), 0.0, 1e-10);
    }
}

double highest(const ConvexPolyhedron& p, const Vec3& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : p.vertices()) most = std::max(most, direction.dot(v));
  return most;
}

TEST(Support, IsTheHighestVertexFromEveryStart) {
  Random random(32);
  for (const ConvexPolyhedron& p : population())
    for (int i = 0; i < 50; ++i) {
      const Vec3 d = random.direction();
      const int start = random.integer(0, p.vertexCount() - 1);
      EXPECT_NEAR(d.dot(p.vertex(p.support(d, start))), highest(p, d), 1e-14 * p.radiusAbout(Vec3::Zero()));
    }
}

TEST(Support, ClimbsAcrossCoplanarFacesAndLevelEdges) {
  for (const ConvexPolyhedron& p : {oracle::triangulatedBox({1, 2, 3}), oracle::prism(200, 1.0, 0.5)})
    for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0), Vec3(0, 1, 1)})
      for (int start = 0; start < p.vertexCount(); ++start)
        EXPECT_NEAR(d.dot(p.vertex(p.support(d, start))), highest(p, d), 1e-14);
}

// Short edges, and directions almost square to them: the difference of two heights along them is all
// rounding, but a climb that stops there misses what lies beyond. Heights within 1e-15 of level may be taken
// as equal.
TEST(Support, ClimbsAlongEdgesFarShorterThanTheSolid) {
  std::vector<Vec3> points = boxPolyhedron({1, 2, 3}).vertices();
  points.pop_back();  // the corner (0.5, 1, 1.5), cut off
  for (int axis = 0; axis < 3; ++axis) points.push_back(Vec3(0.5, 1, 1.5) - 1e-9 * Vec3::Unit(axis));
  const ConvexPolyhedron p = convexHull(points).polyhedron;
  Random random(33);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 d = (Vec3::Unit(i % 3) + random.logUniform(1e-12, 1e-5) * random.direction()).normalized();
    for (int start = 0; start < p.vertexCount(); ++start)
      ASSERT_NEAR(d.dot(p.vertex(p.support(d, start))), highest(p, d), 1e-14) << i;
  }
}

TEST(Width, OfBoxPlateAndTetrahedron) {
  EXPECT_NEAR(boxPolyhedron({1, 0.2, 3}).width(), 0.2, 1e-15);
  EXPECT_NEAR(oracle::tetrahedron().width(), 4 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(ConvexPolyhedron::point({1, 2, 3}).width(), 0.0);
}

TEST(Width, IsTheSmallestOverTheFaceNormals) {
  for (const ConvexPolyhedron& p : population()) {
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < p.faceCount(); ++f)
      least = std::min(least, highest(p, p.plane(f).normal) + highest(p, -p.plane(f).normal));
    EXPECT_NEAR(p.width(), least, 1e-10);
  }
}

TEST(ConvexPolyhedron, TranslationMovesVerticesAndPlanesTogether) {
  const Vec3 shift(1, -2, 3);
  const ConvexPolyhedron p = oracle::dodecahedron(), q = p.translated(shift);
  for (int v = 0; v < p.vertexCount(); ++v) EXPECT_EQ(q.vertex(v), Vec3(p.vertex(v) + shift));
  for (int f = 0; f < p.faceCount(); ++f)
    EXPECT_NEAR(q.plane(f).signedDistance(p.vertex(0) + shift), p.plane(f).signedDistance(p.vertex(0)),
                1e-14);
}

TEST(ConvexPolyhedron, PointAndSegment_AreTheFacelessMembers) {
  const ConvexPolyhedron point = ConvexPolyhedron::point({1, 2, 3});
  EXPECT_EQ(point.vertexCount(), 1);
  EXPECT_EQ(point.spokes(0).size(), 0u);
  const ConvexPolyhedron segment = ConvexPolyhedron::segment({1, 2, 3}, {1, 2, 7});
  EXPECT_EQ(segment.edgeCount(), 1);
  EXPECT_EQ(segment.faceCount(), 0);
  EXPECT_EQ(segment.edge(0).length_m, 4.0);
  EXPECT_EQ(segment.edge(0).direction, Vec3(0, 0, 1));
  EXPECT_EQ(segment.spokes(1).size(), 1u);
  EXPECT_EQ(segment.support({0, 0, 1}), 1);
}

using Loops = std::vector<std::vector<int>>;

void expectRefused(const std::vector<Vec3>& vertices, const Loops& loops, const std::string& reason) {
  const std::string said = thrownMessage<InputError>([&] { ConvexPolyhedron::fromFaces(vertices, loops); });
  EXPECT_NE(said.find(reason), std::string::npos) << "want " << reason << ", got: " << said;
}

TEST(ConvexPolyhedron, RefusesWhatIsNotAClosedConvexSurface) {
  const std::vector<Vec3> v{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Loops good{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_NO_THROW(ConvexPolyhedron::fromFaces(v, good));
  expectRefused(v, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}}, "at least 4");
  expectRefused(v, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 3, 2}}, "orientation");
  expectRefused(v, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, "inside out");
  expectRefused(v, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}}, "does not exist");
  expectRefused(v, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2}}, "at least 3");
  expectRefused(v, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {0, 3, 2}}, "not closed");
  std::vector<Vec3> bad = v;
  bad[2].x() = std::numeric_limits<double>::quiet_NaN();
  expectRefused(bad, good, "not finite");
}

// In the middle of an edge, as files have it where a face was divided.
TEST(ConvexPolyhedron, RefusesAVertexOfTwoEdges) {
  const std::vector<Vec3> v{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}};
  expectRefused(v, {{0, 2, 1, 4}, {0, 4, 1, 3}, {0, 3, 2}, {1, 2, 3}}, "fewer than three edges");
}

TEST(ConvexPolyhedron, RefusesADentAndABentFace) {
  const ConvexPolyhedron box = oracle::triangulatedBox(Vec3::Ones());
  Loops loops;
  for (int f = 0; f < box.faceCount(); ++f)
    loops.emplace_back(box.faceVertices(f).begin(), box.faceVertices(f).end());
  std::vector<Vec3> dented = box.vertices();
  dented[7] = Vec3(0.1, 0.1, 0.1);
  expectRefused(dented, loops, "");
  const ConvexPolyhedron plain = boxPolyhedron(Vec3::Ones());
  Loops quads;
  for (int f = 0; f < plain.faceCount(); ++f)
    quads.emplace_back(plain.faceVertices(f).begin(), plain.faceVertices(f).end());
  std::vector<Vec3> bent = plain.vertices();
  bent[7] += Vec3(0, 0, 0.01);
  expectRefused(bent, quads, "not planar");
}

TEST(ConvexPolyhedron, RefusesCoincidentSegmentEndsAndNonFinitePoints) {
  EXPECT_THROW(ConvexPolyhedron::segment({1, 1, 1}, {1, 1, 1}), InputError);
  EXPECT_THROW(ConvexPolyhedron::point({0, 0, std::numeric_limits<double>::infinity()}), InputError);
}

// From a vertex in the middle of a face cut into coplanar pieces all edges are level, seen from the far side
// too.
TEST(ConvexPolyhedron, ItsSupportIsFoundFromTheMiddleOfTheFarFace) {
  const ConvexPolyhedron grid = oracle::coplanarGrid(3, {1, 2, 3});
  for (int f = 0; f < grid.faceCount(); ++f)
    for (const double sign : {1.0, -1.0}) {
      const Vec3 n = sign * grid.plane(f).normal;
      double highest = -1e300;
      for (const Vec3& v : grid.vertices()) highest = std::max(highest, n.dot(v));
      for (int start = 0; start < grid.vertexCount(); ++start)
        ASSERT_NEAR(n.dot(grid.vertex(grid.support(n, start))), highest, 1e-14) << f << " from " << start;
      ASSERT_NEAR(n.dot(grid.vertex(grid.support(n))), highest, 1e-14) << f;
    }
}

TEST(ConvexPolyhedron, ItsInnerBallIsWithinAllFacesAndTouchesOne) {
  for (const ConvexPolyhedron& p : population())
    for (const ConvexPolyhedron& shape : {p, p.translated(Vec3(3, -2, 1))}) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int f = 0; f < shape.faceCount(); ++f)
        nearest = std::min(nearest, -shape.plane(f).signedDistance(shape.innerBall().center));
      EXPECT_EQ(shape.innerBall().radius_m, nearest);
      EXPECT_GT(nearest, 0.0);
    }
}

TEST(ConvexPolyhedron, TheInnerBallOfACubeIsTheInscribedOne) {
  const InnerBall ball = boxPolyhedron({1, 1, 1}).innerBall();
  EXPECT_NEAR(ball.radius_m, 0.5, 1e-15);
  EXPECT_LT(ball.center.norm(), 1e-15);
}

// The corner of a cube, cut off: the middle of its bounding box is outside, the mean of its vertices has room
// for 0.144, and the ball that touches all four faces has a radius of 1 / (3 + root 3).
TEST(ConvexPolyhedron, TheInnerBallOfACornerThatIsCutOffTouchesAllItsFaces) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const InnerBall ball = convexHull(corners).polyhedron.innerBall();
  const double inscribed = 1.0 / (3.0 + std::sqrt(3.0));
  EXPECT_LT((ball.center - Vec3::Constant(inscribed)).norm(), 2e-3);
  EXPECT_NEAR(ball.radius_m, inscribed, 1e-3 * inscribed);
}

TEST(ConvexPolyhedron, TheFingerprintIsThatOfTheSameVerticesAndFaces) {
  const ConvexPolyhedron box = boxPolyhedron({1, 2, 3});
  EXPECT_EQ(box.fingerprint(), boxPolyhedron({1, 2, 3}).fingerprint());
  EXPECT_NE(box.fingerprint(), boxPolyhedron({1, 2, std::nextafter(3.0, 4.0)}).fingerprint());
  EXPECT_NE(box.fingerprint(), box.translated({0, 0, 1e-3}).fingerprint());
  EXPECT_EQ(box.translated({1, 2, 3}).translated({-1, -2, -3}).fingerprint(), box.fingerprint());
  const std::vector<std::vector<int>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const std::vector<std::vector<int>> turned{{2, 1, 0}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NE(ConvexPolyhedron::fromFaces(corners, faces).fingerprint(),
            ConvexPolyhedron::fromFaces(corners, turned).fingerprint());
}

TEST(ConvexPolyhedron, APointOrSegmentHasNoRoomForABall) {
  EXPECT_EQ(ConvexPolyhedron::point({1, 2, 3}).innerBall().radius_m, 0.0);
  EXPECT_EQ(ConvexPolyhedron::segment({1, 2, 3}, {3, 2, 1}).innerBall().radius_m, 0.0);
}

}  // namespace
}  // namespace carom
