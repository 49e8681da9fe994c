// What the scenes of mechanisms and hollow bodies promise (assets/make_mechanisms.py), by closed forms:
// ratios of gears, the radius that friction holds on a turntable, energy in a bowl, and links that stay
// linked. That nothing ever overlaps is tested for every shipped scene in scene_motion_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/demos/support/played.h"

namespace carom::demos {
namespace {

TEST(TurntableScene, HoldsWhatIsWithinTheRadiusOfItsFriction) {
  Played played("turntable");
  const auto radius = [&](const char* name) { return played.state(name).X_WB.position.head<2>().norm(); };
  const double held[] = {radius("stays"), radius("at 0.8 of the radius"), radius("at 0.97 of the radius")};
  played.run(played.scene.duration_s);
  EXPECT_NEAR(radius("stays"), held[0], 1e-4);
  EXPECT_NEAR(radius("at 0.8 of the radius"), held[1], 1e-4);
  EXPECT_NEAR(radius("at 0.97 of the radius"), held[2], 1e-4);
  for (const char* name : {"at 1.03 of the radius", "at 1.2 of the radius", "at 1.4 of the radius"})
    EXPECT_GT(radius(name), 1.0) << "on the floor beside it";
}

TEST(GearScene, TurnsAtTheRatiosOfItsTeeth) {
  Played played("gears");
  played.run(1.0);
  Vec3 turned = Vec3::Zero();  // driver, idler, driven
  const char* const names[] = {"driver", "idler", "driven"};
  while (played.made.world.time() < played.scene.duration_s) {
    played.made.world.step();
    for (int i = 0; i < 3; ++i)
      turned[i] += played.state(names[i]).angular_velocity.z() * played.made.world.settings().step_s;
  }
  EXPECT_NEAR(turned[1] / turned[0], -18.0 / 27.0, 0.01 * 18.0 / 27.0);
  EXPECT_NEAR(turned[2] / turned[0], 1.0, 0.01);
  const Audit audit = played.made.world.audit();
  EXPECT_EQ(audit.kinematic_late_s, 0.0);
  // What the others move with is the driver's work, less what impacts and friction of their teeth took.
  EXPECT_LT(audit.kinetic_energy_J, audit.work_J);
}

TEST(BowlScene, KeepsTheEnergyOfItsBall) {
  Played played("ball-in-a-bowl");
  const double start = played.energy();
  const double kinetic = played.made.world.audit().kinetic_energy_J;
  double least = start, most = start;
  while (played.made.world.time() < played.scene.duration_s) {
    played.made.world.step();
    least = std::min(least, played.energy());
    most = std::max(most, played.energy());
  }
  EXPECT_LT((most - least) / kinetic, 1e-6);
  EXPECT_LT(played.state("ball").X_WB.position.head<2>().norm(), 1.0);
}

TEST(FunnelScene, LetsEveryMarbleFallIntoTheCup) {
  Played played("marble-in-a-funnel");
  played.run(played.scene.duration_s);
  for (const char* name : {"marble 1", "marble 2", "marble 3"}) {
    const Vec3 p = played.state(name).X_WB.position - played.state("cup").X_WB.position;
    EXPECT_LT(p.head<2>().norm(), 0.3) << name;
    EXPECT_LT(p.z(), 0.3) << name;
  }
}

// What the threads allow: z falls by the pitch over 2 pi times the angle, within their play (a tenth of the
// pitch along the axis), no faster than a body of that much inertia. The threads are of flat facets, whose
// edges it bumps over: they take some of its speed.
TEST(NutScene, TurnsAsItsThreadSaysAndLiesDownOnTheHead) {
  Played played("nut-on-a-bolt");
  const double lead = 0.5 / (2.0 * 3.14159265358979323846);
  const auto found = std::find(played.made.names.begin(), played.made.names.end(), "nut");
  const auto body = static_cast<std::size_t>(found - played.made.names.begin());
  const Solid& nut =
      played.made.world.solids()[static_cast<std::size_t>(played.made.world.bodies()[body].solid)];
  const double gyration2 = nut.unitInertia()(2, 2) / nut.volume();
  const double acceleration = 9.81 / (1.0 + gyration2 / (lead * lead));
  const double start = played.state("nut").X_WB.position.z();
  double turned = 0.0, farthest_off = 0.0;
  double at_two_seconds = 0.0;
  while (played.made.world.time() < played.scene.duration_s) {
    played.made.world.step();
    turned += played.state("nut").angular_velocity.z() * played.made.world.settings().step_s;
    const double fallen = start - played.state("nut").X_WB.position.z();
    if (start - fallen > 0.35 + 0.56 + 0.01)
      farthest_off = std::max(farthest_off, std::abs(fallen - std::abs(turned) * lead));
    if (played.made.world.time() < 2.0) at_two_seconds = std::abs(played.state("nut").angular_velocity.z());
  }
  EXPECT_LT(farthest_off, 0.1 * 0.5);
  EXPECT_LT(at_two_seconds * lead / (2.0 * acceleration), 1.0);
  EXPECT_GT(at_two_seconds * lead / (2.0 * acceleration), 0.75);
  EXPECT_NEAR(played.state("nut").X_WB.position.z(), 0.35 + 0.56, 0.002);
}

TEST(LockScene, ThrowsItsBoltAsFarAsTheBitReaches) {
  Played played("key-in-a-lock");
  const double start = played.state("bolt").X_WB.position.x();
  played.run(played.scene.duration_s);
  const double thrown = played.state("bolt").X_WB.position.x() - start;
  const double reach = std::sqrt(0.3 * 0.3 + 0.05 * 0.05 / 4.0 - 0.22 * 0.22) + 0.02;
  EXPECT_GE(thrown, reach - 0.001);
  EXPECT_LE(thrown, reach + 0.004);
  EXPECT_EQ(played.made.world.audit().kinematic_late_s, 0.0) << "the key comes out again";
}

// The linking number of two closed curves by Gauss' integral over their chords, rounded: +-1 where one goes
// through the other once.
double linking(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 da = a[(i + 1) % a.size()] - a[i], db = b[(j + 1) % b.size()] - b[j];
      const Vec3 r = 0.5 * (a[i] + a[(i + 1) % a.size()] - b[j] - b[(j + 1) % b.size()]);
      sum += r.dot(da.cross(db)) / std::pow(r.norm(), 3);
    }
  return sum / (4.0 * 3.14159265358979323846);
}

// The middle line of a link: two half circles about y with straight pieces along x between them, in short
// chords.
std::vector<Vec3> middleLine(const BodyState& state, double half_length, double radius) {
  std::vector<Vec3> line;
  constexpr int kPoints = 120;
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 3.14159265358979323846 * ((i + 0.5) / kPoints - 0.5);
      line.push_back(state.X_WB *
                     (side * Vec3(half_length + radius * std::cos(angle), radius * std::sin(angle), 0.0)));
    }
    for (int i = 0; i < kPoints && half_length > 0.0; ++i)
      line.push_back(state.X_WB *
                     (side * Vec3(half_length * (1.0 - 2.0 * (i + 0.5) / kPoints), radius, 0.0)));
  }
  return line;
}

TEST(RingScene, StaysLinked) {
  Played played("linked-rings");
  played.run(played.scene.duration_s);
  EXPECT_NEAR(std::abs(linking(middleLine(played.state("upper ring"), 0.0, 0.4),
                               middleLine(played.state("lower ring"), 0.0, 0.4))),
              1.0, 0.05);
}

TEST(ChainScene, StaysLinkedFromTheHookToItsEnd) {
  Played played("chain");
  played.run(played.scene.duration_s);
  for (int k = 1; k < 10; ++k)
    EXPECT_NEAR(std::abs(linking(middleLine(played.state("link " + std::to_string(k)), 0.07, 0.08),
                                 middleLine(played.state("link " + std::to_string(k + 1)), 0.07, 0.08))),
                1.0, 0.05)
        << k;
  EXPECT_GT(played.state("link 1").X_WB.position.z(), 2.8) << "it hangs on the hook";
}

}  // namespace
}  // namespace carom::demos
