// Contacts that will last are struck at the landing gap, wherever in the window a step would have ended.

#include <gtest/gtest.h>

#include <numbers>
#include <cmath>

#include "engine/contact/time_of_impact.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

constexpr double kStep = 1.0 / 240.0;

struct Drop {
  ConvexPart floor = Solid::box({20, 20, 1}).parts()[0];
  ConvexPart box = Solid::box(Vec3::Ones()).parts()[0];
  Trajectory still{0.0, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  Trajectory path;
  CollisionWindow window = collisionWindow(floor, box);

  Drop(double gap_m, double speed_mps) {
    path.X_WB = {oracle::turned(Vec3::UnitZ(), 0.3), Vec3(0, 0, 0.5 + gap_m)};
    path.velocity = Vec3(0.4, -0.2, -speed_mps);
    path.acceleration = Vec3(0, 0, -9.81);
  }
  TimeOfImpact find(bool lands) const {
    const ImpactSearch search{window, 0.1, 0.0, kStep, lands};
    FeaturePair tracked;
    const ClosestFeatures begin = closestFeatures(floor, still.X_WB, box, path.X_WB, tracked);
    return timeOfImpact({&floor, &still, 12.0}, {&box, &path, 0.9}, search, begin, tracked);
  }
  double gapAt(double t) const { return path.at(t).position.z() - 0.5; }
};

TEST(Landing, HappensAtTheLandingGap_WhereverTheStepWouldEnd) {
  for (double speed : {0.2, 0.4, 1.0, 5.0})
    for (double gap = 1.2e-3; gap < 4e-3; gap += 1e-4) {
      SCOPED_TRACE(testing::Message() << "speed " << speed << " gap " << gap);
      const Drop drop(gap, speed);
      const TimeOfImpact found = drop.find(true);
      if (drop.gapAt(kStep) >= drop.window.landing) {
        EXPECT_EQ(found.outcome, TimeOfImpact::Outcome::kClear) << "still above at the step's end";
        continue;
      }
      if (drop.gapAt(kStep) > 0.95 * drop.window.landing) continue;  // either will do
      ASSERT_EQ(found.outcome, TimeOfImpact::Outcome::kImpact);
      EXPECT_NEAR(drop.gapAt(found.time_s), drop.window.landing, 0.05 * drop.window.landing);
    }
}

// Of those that bounce the paper's window holds: struck at once.
TEST(Landing, IsNotForThoseThatBounce) {
  const Drop drop(1.9e-3, 1.0);
  const TimeOfImpact found = drop.find(false);
  EXPECT_EQ(found.outcome, TimeOfImpact::Outcome::kImpact);
  EXPECT_EQ(found.time_s, 0.0);
}

// Two ridges that cross, each turning about the other's direction. With h from a box's middle to its edge and
// the angles a and b that they have turned by, the common normal is (sin a cos b, -cos a sin b, cos a cos b)
// over the root of 1 - sin^2 a sin^2 b.
TEST(Landing, OfCrossingEdgesThatTurn_HappensAtTheLandingGapToo) {
  const double h = std::sqrt(0.5), quarter = 0.25 * std::numbers::pi;
  const ConvexPart box = Solid::box(Vec3::Ones()).parts()[0];
  const CollisionWindow window = collisionWindow(box, box);
  int landed = 0;
  for (const double spin_a : {-10.0, 10.0})
    for (const double spin_b : {-8.0, 8.0})
      for (const double speed : {0.4, 1.0})
        for (double gap = 1.2e-3; gap < 4e-3; gap += 2e-4) {
          SCOPED_TRACE(testing::Message()
                       << "spins " << spin_a << ' ' << spin_b << " speed " << speed << " gap " << gap);
          const Trajectory below{0.0,
                                 {oracle::turned(Vec3::UnitX(), quarter), Vec3::Zero()},
                                 Vec3::Zero(),
                                 Vec3::Zero(),
                                 Vec3(0, spin_a, 0)};
          const Trajectory above{0.0,
                                 {oracle::turned(Vec3::UnitY(), quarter), Vec3(0, 0, 2.0 * h + gap)},
                                 Vec3(0, 0, -speed),
                                 Vec3::Zero(),
                                 Vec3(spin_b, 0, 0)};
          const auto gapAt = [&](double t) {
            const double a = spin_a * t, b = spin_b * t, z = 2.0 * h + gap - speed * t;
            const double sines = std::sin(a) * std::sin(b);
            return (std::cos(a) * std::cos(b) * z - h * (std::cos(a) + std::cos(b))) /
                   std::sqrt(1.0 - sines * sines);
          };
          if (gapAt(kStep) > 0.95 * window.landing) continue;
          const ImpactSearch search{window, 0.1, 0.0, kStep, true};
          FeaturePair tracked;
          const ClosestFeatures begin = closestFeatures(box, below.X_WB, box, above.X_WB, tracked);
          const double reach = box.core.radiusAbout(Vec3::Zero());
          const TimeOfImpact found =
              timeOfImpact({&box, &below, reach}, {&box, &above, reach}, search, begin, tracked);
          ASSERT_EQ(found.outcome, TimeOfImpact::Outcome::kImpact);
          EXPECT_NEAR(found.closest.distance_m, gapAt(found.time_s), 1e-12);
          EXPECT_NEAR(gapAt(found.time_s), window.landing, 0.05 * window.landing + 1e-12);
          ++landed;
        }
  EXPECT_GT(landed, 40);
}

}  // namespace
}  // namespace carom
