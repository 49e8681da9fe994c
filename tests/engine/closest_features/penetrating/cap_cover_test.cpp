// What is said to be covered is, against the support by brute force at every facet and in many directions of
// the cap; and where it is not, a lower direction is found. Seeds 7620 and 7621.

#include "engine/closest_features/penetrating/cap_cover.h"

#include <gtest/gtest.h>

#include "engine/closest_features/penetrating/penetration.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Random;

constexpr int kPoses = inThisBuild(300, 20);

double supportAlong(const PolyhedronPair& pair, const Vec3& n) {
  double highest_of_a = -1e300, lowest_of_b = 1e300;
  for (const Vec3& v : pair.a.vertices()) highest_of_a = std::max(highest_of_a, n.dot(v));
  for (const Vec3& v : pair.b.vertices()) lowest_of_b = std::min(lowest_of_b, n.dot(pair.toA(v)));
  return highest_of_a - lowest_of_b;
}

// Every direction that a facet of M can have, and more.
std::vector<Vec3> axes(const PolyhedronPair& pair) {
  std::vector<Vec3> all;
  for (int f = 0; f < pair.a.faceCount(); ++f) all.push_back(pair.a.plane(f).normal);
  for (int f = 0; f < pair.b.faceCount(); ++f) all.push_back(-pair.directionToA(pair.b.plane(f).normal));
  for (int e = 0; e < pair.a.edgeCount(); ++e)
    for (int g = 0; g < pair.b.edgeCount(); ++g) {
      const Vec3 n = pair.a.edge(e).direction.cross(pair.directionToA(pair.b.edge(g).direction));
      if (n.norm() < 1e-6) continue;
      all.push_back(n.normalized());
      all.push_back(-n.normalized());
    }
  return all;
}

// The mirror image of a direction in the plane of the origin and two points.
Vec3 mirrored(const Vec3& n, const Vec3& p, const Vec3& q) {
  const Vec3 m = p.cross(q).normalized();
  return n - 2.0 * n.dot(m) * m;
}

// A face of A over the vertex of B that is lowest along it: a facet of M.
struct Facet {
  Facet(const PolyhedronPair& pair, int face)
      : normal(pair.a.plane(face).normal),
        loop(pair.a.faceVertices(face)),
        vertex(pair.b.support(-pair.directionToB(normal))),
        depth_m(supportAlong(pair, normal)) {
    for (const int v : loop) corners.push_back(pair.a.vertex(v) - pair.toA(pair.b.vertex(vertex)));
  }
  bool holdsFoot() const {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 along = corners[(i + 1) % corners.size()] - corners[i];
      if (!(normal.cross(along).dot(depth_m * normal - corners[i]) > 1e-6 * along.norm())) return false;
    }
    return depth_m > 1e-6 && corners.size() <= CapCover::kMostCorners;
  }

  Vec3 normal;
  std::span<const int> loop;
  int vertex;
  double depth_m;
  std::vector<Vec3> corners;
};

struct Answer {
  CapCover::Outcome outcome;
  CapCover::Lower lower;
};

Answer cover(const PolyhedronPair& pair, const Facet& facet, const DirectionCap& wanted) {
  CapCover cover(pair, facet.normal, facet.depth_m, 1e-14, wanted);
  for (std::size_t i = 0; i < facet.corners.size(); ++i)
    cover.addCorner(facet.loop[i], facet.vertex,
                    mirrored(facet.normal, facet.corners[i], facet.corners[(i + 1) % facet.corners.size()]));
  const CapCover::Outcome outcome = cover.cover();
  return {outcome, cover.lower()};
}

// The least support over a cap's facets, its rim and directions in it.
double leastSupport(const PolyhedronPair& pair, const DirectionCap& cap, Random& random) {
  double least = std::numeric_limits<double>::infinity();
  const Vec3 middle = cap.point.normalized();
  const double least_cosine = cap.level_m / cap.point.norm();
  for (const Vec3& n : axes(pair))
    if (cap.holds(n)) least = std::min(least, supportAlong(pair, n));
  const TangentBasis across = tangentBasis(middle);
  for (int i = 0; i < 400; ++i) {
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double cosine = i % 2 == 0 ? least_cosine : random.uniform(least_cosine, 1.0);
    const Vec3 aside = std::cos(turn) * across.t1 + std::sin(turn) * across.t2;
    least = std::min(least, supportAlong(pair, cosine * middle + std::sqrt(1.0 - cosine * cosine) * aside));
  }
  return least;
}

std::vector<ConvexPolyhedron> shapes(Random& random) {
  return {boxPolyhedron({1, 1, 1}),
          boxPolyhedron({2, 0.3, 0.6}),
          oracle::octahedron(),
          oracle::dodecahedron(),
          oracle::prism(12, 0.5, 0.3),
          oracle::randomHull(random, 9, Vec3(1, 0.6, 0.05)),
          oracle::randomHull(random, 16),
          oracle::randomHull(random, 40, Vec3(1, 0.8, 0.7)),
          ConvexPolyhedron::point({0, 0, 0})};
}

// Two bodies, a facet of their difference that holds its foot, and a cap that holds its normal.
struct Case {
  PolyhedronPair pair;
  Facet facet;
  DirectionCap wanted;
};

std::optional<Case> randomCase(const std::vector<ConvexPolyhedron>& all, Random& random) {
  const int last = static_cast<int>(all.size()) - 1;
  const ConvexPolyhedron& a = all[static_cast<std::size_t>(random.integer(0, last - 1))];
  const ConvexPolyhedron& b = all[static_cast<std::size_t>(random.integer(0, last))];
  const PolyhedronPair pair(a, Pose{}, b, random.pose(0.4));
  const Facet facet(pair, random.integer(0, a.faceCount() - 1));
  if (!facet.holdsFoot()) return std::nullopt;
  const double opening = random.logUniform(0.02, 2.0);
  const Vec3 middle =
      (facet.normal + 0.9 * std::min(opening, 1.0) * random.uniform(0.0, 1.0) * random.direction())
          .normalized();
  const double length = random.logUniform(0.1, 10.0);
  const DirectionCap wanted{length * middle, length * std::cos(opening)};
  if (!wanted.holds(facet.normal)) return std::nullopt;
  return Case{pair, facet, wanted};
}

TEST(CapCover, WhatItSaysIsCovered_Is) {
  Random random(7620);
  const std::vector<ConvexPolyhedron> all = shapes(random);
  int covered = 0, said = 0, with_help = 0;
  for (int i = 0; i < 100 * kPoses; ++i) {
    const std::optional<Case> c = randomCase(all, random);
    if (!c) continue;
    const double least = leastSupport(c->pair, c->wanted, random);
    const bool truly = least >= c->facet.depth_m - 1e-13;
    const Answer answer = cover(c->pair, c->facet, c->wanted);
    const bool says = answer.outcome == CapCover::Outcome::kCovered;
    ASSERT_TRUE(truly || !says) << i << ": somewhere " << least << " of " << c->facet.depth_m;
    covered += truly;
    said += says;
    with_help += says && !std::ranges::all_of(c->facet.corners, [&](const Vec3& w) {
                   const std::size_t k = static_cast<std::size_t>(&w - c->facet.corners.data());
                   const Vec3& next = c->facet.corners[(k + 1) % c->facet.corners.size()];
                   return !c->wanted.holds(mirrored(c->facet.normal, w, next));
                 });
  }
  EXPECT_GT(covered, 5 * kPoses);
  EXPECT_GT(said, 0.9 * covered) << "it sees too little";
  EXPECT_GT(with_help, kPoses / 2);
}

// The direction that is named is no higher than the depth, and away from the point that has it a little
// lower.
TEST(CapCover, WhereItIsNotCovered_ALowerDirectionIsFound) {
  Random random(7621);
  const std::vector<ConvexPolyhedron> all = shapes(random);
  int lower = 0, found = 0;
  for (int i = 0; i < 100 * kPoses; ++i) {
    const std::optional<Case> c = randomCase(all, random);
    if (!c) continue;
    const double depth = c->facet.depth_m;
    lower += leastSupport(c->pair, c->wanted, random) < depth - 1e-6;
    const Answer answer = cover(c->pair, c->facet, c->wanted);
    if (answer.outcome != CapCover::Outcome::kLower) continue;
    ++found;
    const Vec3& n = answer.lower.direction;
    const Vec3 w = c->pair.a.vertex(answer.lower.a) - c->pair.toA(c->pair.b.vertex(answer.lower.b));
    ASSERT_NEAR(n.norm(), 1.0, 1e-14);
    ASSERT_LE(supportAlong(c->pair, n), depth + 2e-14) << i;
    ASSERT_NEAR(n.dot(w), supportAlong(c->pair, n), 2e-14) << i;
  }
  EXPECT_GT(found, 5 * kPoses);
  EXPECT_GT(found, 0.5 * lower);
}

// Of the unit cube about a point 0.3 from a face and 0.2 from the next one: the corners of the first face
// reach 2 atan(0.2 / 0.3) = 67.4 degrees towards that, whose own normal is at 90 degrees.
TEST(CapCover, OfACube_ReachesUpToTheMirrorImageAndFindsTheLowerFaceBeyond) {
  const ConvexPolyhedron cube = boxPolyhedron({1, 1, 1}), point = ConvexPolyhedron::point({0.2, 0.3, 0.0});
  const PolyhedronPair pair(cube, Pose{}, point, Pose{});
  int face = 0;
  while (cube.plane(face).normal.x() < 0.5) ++face;
  const Facet facet(pair, face);
  ASSERT_NEAR(facet.depth_m, 0.3, 1e-15);
  const auto capOf = [](double degrees) {
    return DirectionCap{Vec3::UnitX(), std::cos(degrees * std::numbers::pi / 180.0)};
  };
  EXPECT_EQ(cover(pair, facet, capOf(67.0)).outcome, CapCover::Outcome::kCovered);
  const Answer wide = cover(pair, facet, capOf(68.0));
  EXPECT_EQ(wide.outcome, CapCover::Outcome::kLower);
  EXPECT_NEAR(std::atan2(wide.lower.direction.y(), wide.lower.direction.x()), 2.0 * std::atan(0.2 / 0.3),
              1e-12);
}

}  // namespace
}  // namespace carom
