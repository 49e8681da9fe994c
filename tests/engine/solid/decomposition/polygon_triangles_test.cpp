#include "engine/solid/decomposition/polygon_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "engine/foundation/index.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

// Corners of all rings one behind the other.
struct Polygon {
  Rings rings;
  std::vector<Vec2> corners;

  void add(const std::vector<Vec2>& ring) {
    rings.emplace_back();
    for (const Vec2& p : ring) {
      rings.back().push_back(static_cast<int>(corners.size()));
      corners.push_back(p);
    }
  }
};

double areaOf(const Polygon& polygon) {
  double area = 0.0;
  for (const std::vector<int>& ring : polygon.rings) area += 0.5 * twiceArea(ring, polygon.corners);
  return area;
}

// Every side in one join, and those of a join at the same two places; no triangle clockwise; areas add up.
void expectFilled(const Polygon& polygon, double area_error = 1e-13) {
  const std::optional<PolygonTriangles> made = polygonTriangles(polygon.rings, polygon.corners, 1e-14);
  ASSERT_TRUE(made);
  double area = 0.0;
  std::map<SideNumber, std::pair<Vec2, Vec2>> sides;
  for (const std::vector<int>& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)  // seen from beyond
      sides[ringSide(ring[i])] = {polygon.corners[static_cast<std::size_t>(ring[(i + 1) % ring.size()])],
                                  polygon.corners[static_cast<std::size_t>(ring[i])]};
  for (std::size_t t = 0; t < made->triangles.size(); ++t) {
    std::vector<int> loop(made->triangles[t].begin(), made->triangles[t].end());
    EXPECT_GE(twiceArea(loop, polygon.corners), -1e-14);
    area += 0.5 * twiceArea(loop, polygon.corners);
    for (std::size_t k = 0; k < 3; ++k)
      sides[static_cast<int>(3 * t + k)] = {polygon.corners[static_cast<std::size_t>(loop[k])],
                                            polygon.corners[static_cast<std::size_t>(loop[(k + 1) % 3])]};
  }
  EXPECT_NEAR(area, areaOf(polygon), area_error);
  for (const auto& [side, other] : made->joins) {
    ASSERT_TRUE(sides.contains(side) && sides.contains(other)) << side << ' ' << other;
    EXPECT_EQ(sides[side].first, sides[other].second);
    EXPECT_EQ(sides[side].second, sides[other].first);
    sides.erase(side);
    sides.erase(other);
  }
  EXPECT_TRUE(sides.empty()) << sides.size() << " sides are in no join";
}

TEST(PolygonTriangles, FillASquareWithCornersInItsSides) {
  Polygon square;
  square.add({{0, 0}, {0.5, 0}, {0.75, 0}, {1, 0}, {1, 1}, {0.3, 1}, {0, 1}, {0, 0.5}});
  expectFilled(square);
}

TEST(PolygonTriangles, FillARingWithTwoHoles) {
  Polygon plate;
  plate.add({{0, 0}, {3, 0}, {3, 1}, {0, 1}});
  plate.add({{0.5, 0.25}, {0.5, 0.75}, {1, 0.75}, {1, 0.25}});
  plate.add({{2, 0.25}, {2.2, 0.75}, {2.5, 0.25}});
  expectFilled(plate);
}

TEST(PolygonTriangles, FillARingThatTouchesItsHole) {
  Polygon touching;
  touching.add({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  touching.add({{0, 0}, {0.5, 1}, {1, 0.5}});
  expectFilled(touching);
}

// Thinner than rounding, they come apart from the bridges to them, whose two sides are left on each other.
TEST(PolygonTriangles, FillARingAroundTwoHolesThatHaveNoArea) {
  Polygon slits;
  slits.add({{0, 0}, {3, 0}, {3, 3}, {0, 3}});
  for (const double y : {1.0, 2.0}) slits.add({{1, y}, {1.125, y + 3e-14}, {1.25, y}});
  expectFilled(slits);
}

// So small a hole would be none to rounding if the polygon reached to the origin.
TEST(PolygonTriangles, FillARingThatTouchesASmallHoleFarFromTheOrigin) {
  const Vec2 corner(0x1p21, -0x1p21);
  const double e = 0x1p-12;
  Polygon touching;
  touching.add({corner, corner + Vec2(1, 0), corner + Vec2(1, 1), corner + Vec2(0, 1)});
  touching.add({corner, corner + Vec2(e, 2 * e), corner + Vec2(2 * e, e)});
  expectFilled(touching);
}

// Two lobes that meet in a corner, as one ring: a triangle across would join what is apart.
TEST(PolygonTriangles, JoinNoLobesThatMeetInACorner) {
  Polygon lobes;
  lobes.add({{0, 0}, {1, -0.5}, {1, 0.5}, {0, 0}, {-1, 0.5}, {-1, -0.5}});
  expectFilled(lobes);
  const std::optional<PolygonTriangles> made = polygonTriangles(lobes.rings, lobes.corners, 1e-14);
  EXPECT_EQ(made->triangles.size(), 2u);
}

// The section of a ring that was cut once: around outside, in along the slit, around inside, out again.
TEST(PolygonTriangles, CloseASlit) {
  Polygon slit;
  slit.add({{2, 0},
            {2, 2},
            {-2, 2},
            {-2, -2},
            {2, -2},
            {2, 0},
            {1, 0},
            {1, -1},
            {-1, -1},
            {-1, 1},
            {1, 1},
            {1, 0}});
  expectFilled(slit);
}

TEST(PolygonTriangles, TakeTheCornersOfASideWithoutLengthForTwo) {
  Polygon square;
  square.add({{0, 0}, {1, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}, {0, 0}});
  expectFilled(square);
}

// Squares in a row that touch in corners, as one ring that goes out below and comes back above; and petals
// that all touch in one point. Nothing joins two of them.
TEST(PolygonTriangles, ComeApartAtAThousandTouches) {
  constexpr int kSquares = 1000, kPetals = 200;
  Polygon row, flower;
  std::vector<Vec2> there, back, petals;
  for (int i = 0; i < kSquares; ++i) {
    there.insert(there.end(), {Vec2(i, 0.0), Vec2(i + 0.5, -0.5)});
    back.insert(back.end(), {Vec2(kSquares - i, 0.0), Vec2(kSquares - i - 0.5, 0.5)});
  }
  there.insert(there.end(), back.begin(), back.end());
  row.add(there);
  expectFilled(row, 1e-10);
  EXPECT_EQ(polygonTriangles(row.rings, row.corners, 1e-12)->triangles.size(), at(2 * kSquares));

  for (int i = 0; i < kPetals; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPetals, wide = 0.3 * std::numbers::pi / kPetals;
    petals.insert(petals.end(), {Vec2::Zero(), Vec2(std::cos(angle - wide), std::sin(angle - wide)),
                                 Vec2(std::cos(angle + wide), std::sin(angle + wide))});
  }
  flower.add(petals);
  expectFilled(flower);
  EXPECT_EQ(polygonTriangles(flower.rings, flower.corners, 1e-14)->triangles.size(), at(kPetals));
}

std::vector<Vec2> spikes(int corners, double least, double most, bool clockwise, oracle::Random& random) {
  std::vector<Vec2> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (clockwise ? -i : i) / corners;
    ring.push_back(random.uniform(least, most) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

// Spikes around the middle and around a hole, so many that most corners are not looked at for an ear.
TEST(PolygonTriangles, FillRingsOfHundredsOfCorners) {
  oracle::Random random(73);
  for (const int corners : {31, 32, 33, 64, 65, 200, 700}) {
    Polygon star, crown;
    star.add(spikes(corners, 0.05, 1.0, false, random));
    expectFilled(star);
    crown.add(spikes(corners, 0.6, 1.0, false, random));
    crown.add(spikes(corners / 2, 0.1, 0.5, true, random));
    expectFilled(crown);
  }
}

// A strip that winds around itself: ears are few, and what is in the way of one is far along the ring.
TEST(PolygonTriangles, FillAStripThatWindsAroundItself) {
  Polygon spiral;
  std::vector<Vec2> ring;
  const auto along = [](double turns, double radius) {
    const double angle = 2.0 * std::numbers::pi * turns;
    return Vec2(radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  for (int i = 0; i <= 400; ++i) ring.push_back(along(i / 80.0, 0.15 + 0.1 * i / 80.0));
  for (int i = 400; i >= 0; --i) ring.push_back(along(i / 80.0, 0.10 + 0.1 * i / 80.0));
  spiral.add(ring);
  expectFilled(spiral);
}

TEST(PolygonTriangles, SayNothingOfARingThatCrossesItself) {
  Polygon crossed;
  crossed.add({{0, 0}, {2, 0}, {0.5, 1}, {2, 2}, {0, 2}, {1.5, 1}});
  EXPECT_FALSE(polygonTriangles(crossed.rings, crossed.corners, 1e-14));
}

// All triangles of some ways to take them apart run counter-clockwise, as those of a region do.
TEST(PolygonTriangles, SayNothingOfSixCornersThatCrossThemselves) {
  for (const std::vector<Vec2>& ring : {std::vector<Vec2>{{0, 5}, {2, 2}, {4, 1}, {6, 5}, {0, 2}, {6, 0}},
                                        std::vector<Vec2>{{2, 6}, {2, 1}, {3, 2}, {4, 4}, {1, 0}, {4, 1}},
                                        std::vector<Vec2>{{0, 5}, {4, 3}, {4, 4}, {2, 6}, {3, 0}, {5, 5}}}) {
    Polygon crossed;
    crossed.add(ring);
    EXPECT_FALSE(polygonTriangles(crossed.rings, crossed.corners, 1e-14));
  }
}

}  // namespace
}  // namespace carom
