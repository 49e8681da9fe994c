// One pass opens a tower from its foot to its top: every row ends at its bound, what is below stays as it is,
// and no impulse is left in the rows.

#include "engine/response/sweeps/ordered_pass.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

constexpr int kHeight = 40;

struct Tower {
  std::vector<ImpulseBody> bodies;
  std::vector<ContactRow> rows;
};

// Cubes of 1 m, four rows between two of them, moving at random; the lowest stands on body 0, which cannot
// move. Every row asks for another speed. The rows are in no order.
Tower randomTower(Random& random) {
  Tower tower;
  tower.bodies.emplace_back();
  for (int i = 1; i <= kHeight; ++i) {
    ImpulseBody body;
    body.center = Vec3(0.0, 0.0, i - 0.5);
    body.inverse_mass = random.uniform(0.5, 2.0);
    body.inverse_tensor = 6.0 * body.inverse_mass * Mat3::Identity();
    body.velocity = {0.1 * random.direction(), 0.1 * random.direction()};
    tower.bodies.push_back(body);
    const double wanted = random.uniform(-0.05, 0.05);
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        ContactRow row;
        const bool turned = random.uniform(0.0, 1.0) < 0.5;  // either body may be the row's first
        row.a = turned ? i : i - 1;
        row.b = turned ? i - 1 : i;
        row.n = turned ? Vec3(-Vec3::UnitZ()) : Vec3(Vec3::UnitZ());
        const Vec3 p(x, y, i - 1.0);
        row.r_a = p - tower.bodies[static_cast<std::size_t>(row.a)].center;
        row.r_b = p - tower.bodies[static_cast<std::size_t>(row.b)].center;
        row.lowest_speed = wanted;
        prepareRow(row, tower.bodies);
        tower.rows.push_back(row);
      }
  }
  for (std::size_t i = tower.rows.size(); i > 1; --i)
    std::swap(tower.rows[i - 1],
              tower.rows[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
  return tower;
}

void passUpwards(Tower& tower, const Vec3& up) {
  UpwardPass pass;
  UpwardPass::Scratch scratch;
  pass.order(tower.rows, tower.bodies, up, scratch);
  pass.make(tower.rows, tower.bodies, nullptr);
}

TEST(PassUpwards, OpensATowerInOnePass) {
  Random random(77);
  for (int i = 0; i < 50; ++i) {
    Tower tower = randomTower(random);
    passUpwards(tower, Vec3(0.0, 0.0, 9.81));
    for (const ContactRow& row : tower.rows) {
      EXPECT_GT(rowVelocity(row, tower.bodies).x(), row.lowest_speed - 2e-3);
      EXPECT_TRUE(row.impulse.isZero(0.0));
    }
  }
}

// The top is on a rail: nothing that presses it upwards moves it.
TEST(PassUpwards, LeavesWhatLockedAxesHold) {
  Random random(79);
  Tower tower = randomTower(random);
  ImpulseBody& top = tower.bodies.back();
  top.free_axes = Vec3(1.0, 1.0, 0.0);
  top.inverse_tensor.setZero();
  top.has_locks = true;
  const Velocity before = top.velocity;
  for (ContactRow& row : tower.rows) row.lowest_speed = 1.0;
  passUpwards(tower, Vec3::UnitZ());
  EXPECT_EQ(tower.bodies.back().velocity.linear, before.linear);
  EXPECT_EQ(tower.bodies.back().velocity.angular, before.angular);
}

TEST(PassUpwards, LeavesWhatIsBelowAsItIs) {
  Random random(78);
  Tower tower = randomTower(random);
  const std::vector<ImpulseBody> before = tower.bodies;
  for (ContactRow& row : tower.rows)
    if (std::max(row.a, row.b) < kHeight)
      row.lowest_speed = -1.0;  // of all but the top: they ask for nothing
  passUpwards(tower, Vec3::UnitZ());
  for (std::size_t i = 0; i < kHeight; ++i) {
    EXPECT_EQ(tower.bodies[i].velocity.linear, before[i].velocity.linear);
    EXPECT_EQ(tower.bodies[i].velocity.angular, before[i].velocity.angular);
  }
  EXPECT_NE(tower.bodies.back().velocity.linear, before.back().velocity.linear);
}

// Towers side by side that bear each other across: of several threads, each body as by one.
TEST(PassUpwards, HasTheBitsOfOneThread) {
  Random random(80);
  Tower towers;
  for (int k = 0; k < 30; ++k) {
    const Tower tower = randomTower(random);
    const int shift = static_cast<int>(towers.bodies.size());
    for (ImpulseBody body : tower.bodies) {
      body.center += Vec3(2.0 * k, 0.0, random.uniform(-0.3, 0.3));
      towers.bodies.push_back(body);
    }
    for (ContactRow row : tower.rows) {
      row.a += shift;
      row.b += shift;
      towers.rows.push_back(row);
      if (k == 0 || random.uniform(0.0, 1.0) < 0.5) continue;
      row.a -= kHeight + 1;  // lies on the tower before as well
      prepareRow(row, towers.bodies);
      towers.rows.push_back(row);
    }
  }
  Tower shared = towers;
  UpwardPass pass;
  UpwardPass::Scratch scratch;
  pass.order(towers.rows, towers.bodies, Vec3::UnitZ(), scratch);
  pass.make(towers.rows, towers.bodies, nullptr);
  pass.order(shared.rows, shared.bodies, Vec3::UnitZ(), scratch);
  Crew crew(3);
  pass.make(shared.rows, shared.bodies, &crew);
  for (std::size_t i = 0; i < shared.bodies.size(); ++i) {
    EXPECT_EQ(shared.bodies[i].velocity.linear, towers.bodies[i].velocity.linear);
    EXPECT_EQ(shared.bodies[i].velocity.angular, towers.bodies[i].velocity.angular);
  }
}

// Nothing bears the tower: moved body by body, its centre of mass would go where no momentum takes it.
TEST(PassUpwards, DoesNothingWhereNothingStands) {
  Random random(81);
  Tower tower = randomTower(random);
  tower.bodies.front().inverse_mass = 1.0;
  const std::vector<ImpulseBody> before = tower.bodies;
  passUpwards(tower, Vec3::UnitZ());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(tower.bodies[i].velocity.linear, before[i].velocity.linear);
}

TEST(PassUpwards, DoesNothingWhereNothingIsAbove) {
  Random random(79);
  Tower tower = randomTower(random);
  const std::vector<ImpulseBody> before = tower.bodies;
  passUpwards(tower, Vec3::Zero());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(tower.bodies[i].velocity.linear, before[i].velocity.linear);
}

}  // namespace
}  // namespace carom
