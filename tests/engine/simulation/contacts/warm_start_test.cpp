// What a pair's rows start from: every point from what it carried, whatever it is called now.

#include "engine/simulation/contacts/warm_start.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

// A box on a floor at the corners of an octagon's halves; points of B about its centre, metres.
ShapePair pairWith(const std::vector<std::pair<std::uint64_t, Vec3>>& points,
                   const std::vector<Vec3>& impulses) {
  ShapePair pair;
  pair.window.rest = 1e-3;
  for (std::size_t i = 0; i < points.size(); ++i) {
    RememberedImpulse remembered;
    remembered.id = points[i].first;
    remembered.arm_b = points[i].second;
    remembered.impulse_W = impulses[i];
    pair.remembered.push_back(remembered);
  }
  return pair;
}

std::vector<SourcedRow> rowsAt(const std::vector<std::pair<std::uint64_t, Vec3>>& points) {
  std::vector<SourcedRow> rows;
  for (const auto& [id, arm] : points) {
    SourcedRow sourced;
    sourced.id = id;
    sourced.row.r_b = arm;
    sourced.row.t1 = Vec3::UnitX();
    sourced.row.t2 = Vec3::UnitY();
    rows.push_back(sourced);
  }
  return rows;
}

struct Wrench {
  Vec3 impulse = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};

Wrench wrenchOf(const std::vector<SourcedRow>& rows) {
  Wrench w;
  for (const SourcedRow& sourced : rows) {
    const Vec3 impulse_W = rowImpulse(sourced.row, sourced.row.impulse);
    w.impulse += impulse_W;
    w.moment += sourced.row.r_b.cross(impulse_W);
  }
  return w;
}

const Vec3 kFirst(0.3, 0.1, -0.25), kSecond(-0.3, 0.2, -0.25);

TEST(WarmStart, KnowsAPointByItsNameWhereverItIs) {
  const ShapePair pair = pairWith({{7, kFirst}, {8, kSecond}}, {Vec3(0.1, 0.2, 3.0), Vec3(0.0, 0.0, 4.0)});
  std::vector<SourcedRow> rows = rowsAt({{8, kFirst}, {7, kSecond}});
  warmStart(pair, false, rows);
  EXPECT_EQ(rows[0].row.impulse, Vec3(4.0, 0.0, 0.0));
  EXPECT_EQ(rows[1].row.impulse, Vec3(3.0, 0.1, 0.2));
}

TEST(WarmStart, KnowsARenamedPointByItsPlaceAndGivesNothingTwice) {
  const ShapePair pair = pairWith({{7, kFirst}}, {Vec3(0.0, 0.0, 3.0)});
  std::vector<SourcedRow> rows =
      rowsAt({{20, kFirst + Vec3(0.005, 0, 0)}, {21, kFirst}, {22, kFirst + Vec3(0.02, 0, 0)}});
  warmStart(pair, false, rows);
  EXPECT_EQ(rows[0].row.impulse.x() + rows[1].row.impulse.x(), 3.0);
  EXPECT_EQ(rows[2].row.impulse.x(), 0.0) << "ten rest gaps are too far";
}

TEST(WarmStart, OfBodiesThatLieStill_HandsTheWrenchToWhicheverCornersAreChosen) {
  std::vector<std::pair<std::uint64_t, Vec3>> even, odd;
  std::vector<Vec3> impulses;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::numbers::pi * i;
    (i % 2 == 0 ? even : odd)
        .emplace_back(100 + i, Vec3(0.3 * std::cos(angle), 0.3 * std::sin(angle), -0.25));
  }
  for (int i = 0; i < 4; ++i) impulses.emplace_back(0.02 * i, -0.1, 1.0 + 0.1 * i);
  const ShapePair pair = pairWith(even, impulses);
  std::vector<SourcedRow> same = rowsAt(even), others = rowsAt(odd);
  warmStart(pair, true, same);
  warmStart(pair, true, others);
  const Wrench was = wrenchOf(same), is = wrenchOf(others);
  EXPECT_LT((is.impulse - was.impulse).norm(), 1e-12);
  EXPECT_LT((is.moment - was.moment).norm(), 1e-12);
  EXPECT_GT(was.impulse.z(), 4.0);

  std::vector<SourcedRow> moving = rowsAt(odd);
  warmStart(pair, false, moving);
  EXPECT_TRUE(wrenchOf(moving).impulse.isZero(0.0)) << "what moves has lost those points";
}

TEST(WarmStart, NeverPulls) {
  const ShapePair pair = pairWith({{7, kFirst}, {8, kSecond}}, {Vec3(0, 0, 5.0), Vec3::Zero()});
  // One point far inside of the other: the least impulses with that moment would pull there.
  std::vector<SourcedRow> rows = rowsAt({{9, Vec3(0.1, 0.1, -0.25)}, {10, Vec3(-0.3, 0.1, -0.25)}});
  warmStart(pair, true, rows);
  for (const SourcedRow& sourced : rows) EXPECT_GE(sourced.row.impulse.x(), 0.0);
}

TEST(WarmStart, OfAPairThatRemembersNothing_IsNothing) {
  std::vector<SourcedRow> rows = rowsAt({{7, kFirst}});
  warmStart(ShapePair{}, true, rows);
  EXPECT_TRUE(rows[0].row.impulse.isZero(0.0));
}

}  // namespace
}  // namespace carom
