// A rack of fifteen balls, broken along its axis, scatters as its own mirror image, however near the balls
// are. Within the collision window the whole rack is struck in one instant: which of its collisions comes
// first must not depend on the order of the bodies, nor what supports those that part slowly after them.
// Rounding grows from collision to collision; measured is at most 4e-9 m after half a second (of friction,
// which is solved to a residual) for balls of billiards, 2e-8 m for others (the supports are, too), 0.03 to
// 0.8 m where an instant's collisions came in the pairs' order, and up to 9e-4 m where each was supported by
// itself.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kBilliardBall = 0.0286;

// Gap in m, friction, Hz, radius in m.
class Break : public testing::TestWithParam<std::tuple<double, double, double, double>> {};

TEST_P(Break, AlongTheAxis_ScattersAsItsOwnMirrorImage) {
  const auto [gap_m, friction, rate_hz, radius] = GetParam();
  const double bound = radius != kBilliardBall ? 3e-8 : friction > 0.0 ? 1e-8 : 1e-9;
  constexpr int kRows = 5;
  const double height = radius + restGap(2.0 * radius);
  const double apart = 2.0 * radius + gap_m;
  SmallWorld w(rate_hz);
  w.addPlane(rubbing(friction));
  const auto ball = [&, rubs = friction, r = radius](double x, double y, double speed) {
    return w.add({Solid::ball(r),
                  {Quat::Identity(), Vec3(x, y, height)},
                  Vec3(speed, 0.0, 0.0),
                  Vec3::Zero(),
                  rubbing(rubs, 0.95)});
  };
  const int cue = ball(-0.5, 0.0, 8.0);
  std::vector<std::pair<int, int>> mirrored{{cue, cue}};
  for (int row = 0; row < kRows; ++row) {
    std::vector<int> balls;
    for (int k = 0; k <= row; ++k)
      balls.push_back(ball(row * apart * std::sqrt(0.75), (k - 0.5 * row) * apart, 0.0));
    for (std::size_t k = 0; k < balls.size(); ++k)
      mirrored.emplace_back(balls[k], balls[balls.size() - 1 - k]);
  }
  w.start();
  w.run(0.5);
  for (const auto& [left, right] : mirrored) {
    const Vec3 image = w.position(right).cwiseProduct(Vec3(1.0, -1.0, 1.0));
    EXPECT_NEAR((w.position(left) - image).norm(), 0.0, bound) << left << " and " << right;
  }
  EXPECT_GT(w.position(mirrored.back().first).norm(), 0.5) << "it should have been broken";
}

INSTANTIATE_TEST_SUITE_P(GapsFrictionsAndRates, Break,
                         testing::Combine(testing::Values(1e-4, 3e-4, 1e-3), testing::Values(0.0, 0.2),
                                          testing::Values(60.0, 240.0), testing::Values(kBilliardBall)));

INSTANTIATE_TEST_SUITE_P(OtherBalls, Break,
                         testing::Combine(testing::Values(1e-4, 3e-4, 1e-3), testing::Values(0.0, 0.2),
                                          testing::Values(60.0, 240.0),
                                          testing::Values(0.01, 0.0143, 0.02, 0.05, 0.1)));

}  // namespace
}  // namespace carom::physics
