// A peg between the walls of a fork, with less room than its gaps rest at: what nothing holds falls with g
// and comes no other way, and what only has to slide comes down. Shares walls, a bottom and a peg of the
// width 1; all lengths are of that.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

struct Fit {
  double clearance = 0.0;  // on either side of the peg
  double width_m = 1.0;
  double rate_hz = 240.0;
};
class TightFit : public testing::TestWithParam<Fit> {};

Solid fork(double w) {
  std::vector<ConvexPart> parts;
  for (const auto& [size, middle] : {std::pair(Vec3(0.2, 1.0, 1.0), Vec3(-0.6, 0.0, 0.0)),
                                     std::pair(Vec3(0.2, 1.0, 1.0), Vec3(0.6, 0.0, 0.0)),
                                     std::pair(Vec3(1.4, 1.0, 0.2), Vec3(0.0, 0.0, -0.8))})
    parts.push_back({Solid::box(w * size).parts()[0].core.translated(w * middle), 0.0});
  return Solid(parts);
}

Solid peg(const Fit& fit) {
  return Solid::box(fit.width_m * Vec3(1.0 - 2.0 * fit.clearance, 0.8, 0.8));
}

// So that the frame that the solid is described in stands at `p`.
int addAt(SmallWorld& w, const Solid& solid, const Vec3& p) {
  return w.add({solid, {Quat::Identity(), p - solid.origin_B()}, Vec3::Zero(), Vec3::Zero(), rubbing(0.0)});
}

TEST_P(TightFit, FallsWithItsFork) {
  const Fit& fit = GetParam();
  SmallWorld w(fit.rate_hz);
  const int around = addAt(w, fork(fit.width_m), Vec3::Zero());
  const int within = addAt(w, peg(fit), Vec3::Zero());
  w.start();
  const Vec3 around_at = w.position(around), within_at = w.position(within);
  int stopped = 0;
  for (int i = 0; i < static_cast<int>(fit.rate_hz); ++i) {
    w.step();
    stopped += w.world().audit().last_step.stopped_bodies;
  }
  const Vec3 fallen(0.0, 0.0, -0.5 * kGravity);
  const Vec3 off_a = w.position(around) - around_at - fallen, off_b = w.position(within) - within_at - fallen;
  const double m_a = fork(fit.width_m).volume(), m_b = peg(fit).volume();
  EXPECT_LT((m_a * off_a + m_b * off_b).norm() / (m_a + m_b), 1e-12);
  EXPECT_LT((off_b - off_a).norm(), 0.1 * fit.clearance * fit.width_m);  // it may find its middle anew
  EXPECT_EQ(stopped, 0);
}

INSTANTIATE_TEST_SUITE_P(Clearances, TightFit,
                         testing::Values(Fit{1e-6}, Fit{5e-5}, Fit{1e-4}, Fit{1.5e-4}, Fit{2e-4}, Fit{3e-4},
                                         Fit{5e-4}, Fit{5e-4, 1.0, 960}, Fit{5e-4, 0.01}, Fit{7e-4},
                                         Fit{7e-4, 0.1, 60}, Fit{1e-3}));

class LoosePeg : public testing::TestWithParam<Fit> {};

// On a floor, let go above: without friction it slides to the bottom, which it lands on; no energy comes of
// it but what a landing's rest gap is worth.
TEST_P(LoosePeg, SlidesToTheBottom) {
  const Fit& fit = GetParam();
  const double width = fit.width_m;
  SmallWorld w(fit.rate_hz);
  w.addPlane(rubbing(0.0));
  addAt(w, fork(width), Vec3(0.0, 0.0, 0.91 * width));
  const int within = addAt(w, peg(fit), Vec3(0.0, 0.0, 1.5 * width));
  w.start();
  const auto energy = [&] {
    return w.world().audit().kinetic_energy_J + w.world().audit().potential_energy_J;
  };
  double least = energy();
  int stopped = 0;
  const double rest_gap_J = 2.0 * 1000.0 * std::pow(width, 3) * kGravity * tolerance::kRestGap * width;
  for (int i = 0; i < static_cast<int>(1.5 * fit.rate_hz); ++i) {
    w.step();
    stopped += w.world().audit().last_step.stopped_bodies;
    ASSERT_LT(energy() - least, rest_gap_J) << "step " << i;
    least = std::min(least, energy());
  }
  const double bottom = 0.91 - 0.7 + 0.4;  // where the peg lies on it, but for what the fork has come down
  EXPECT_NEAR(w.position(within).z() / width, bottom - 0.01, 0.005);
  EXPECT_EQ(stopped, 0);
}

INSTANTIATE_TEST_SUITE_P(Clearances, LoosePeg,
                         testing::Values(Fit{2e-4}, Fit{3e-4}, Fit{5e-4}, Fit{5e-4, 1.0, 960},
                                         Fit{5e-4, 0.01}, Fit{7e-4}, Fit{7e-4, 0.1}, Fit{1e-3}));

}  // namespace
}  // namespace carom::physics
