#include "engine/simulation/contacts/carried_path.h"

#include <algorithm>
#include <atomic>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kDipShare = 0.05;      // of the room below a gap
constexpr double kSlidingNoise = 1e-6;  // of the rest gap: what rounding and solvers may do to what slides

}  // namespace

void driveEvenly(Body& body, const CarriedStretch& stretch) {
  const double dt = stretch.rest_of_step_s;
  body.momentum_velocity = stretch.begin;
  body.acceleration = stretch.gain.linear / dt;
  body.torque = angularMomentum(body.inertia, stretch.R_WB, stretch.gain.angular) / dt;
  body.solved_spin_B = stretch.R_WB.conjugate() * stretch.spin;
  body.turning_B = stretch.R_WB.conjugate() * stretch.gain.angular / dt;
}

void carryAlong(Body& body, const Velocity& mean, double rest_of_step_s, bool bends) {
  body.path.acceleration = bends ? body.acceleration : Vec3(Vec3::Zero());
  body.path.velocity = mean.linear - (0.5 * rest_of_step_s) * body.path.acceleration;
  body.path.turnAt(mean.angular);
  body.opening_W = 0.0;
}

OpeningPower openingPower(const ContactPlace& contact, double force_N, const PairMotions& motions,
                          double noise_mps) {
  if (!(force_N > 0.0)) return {};
  const double led_a =
      dot(contact.n_W, motions.momentum_a.at(contact.arm_a) - motions.path_a.at(contact.arm_a));
  const double led_b =
      dot(contact.n_W, motions.path_b.at(contact.arm_b) - motions.momentum_b.at(contact.arm_b));
  const double own_mps =
      dot(contact.n_W, motions.momentum_b.at(contact.arm_b) - motions.momentum_a.at(contact.arm_a));
  const double opened_mps = led_a + led_b + std::min(0.0, own_mps);
  if (!(opened_mps > noise_mps)) return {};
  const double by_a = std::max(0.0, led_a), by_b = std::max(0.0, led_b);
  const double each = force_N * opened_mps / (by_a + by_b);
  return {each * by_a, each * by_b};
}

double openingNoise(const CollisionWindow& window, double rest_of_step_s) {
  return kSlidingNoise * window.rest / rest_of_step_s;
}

void straightenDips(const ContactRow& row, double gap_m, const CollisionWindow& window, double rest_of_step_s,
                    std::span<const Vec3> accelerations, std::span<char> bends) {
  // A parabola lies below its chord by up to an eighth of the acceleration times the time squared.
  const double share = 0.125 * rest_of_step_s * rest_of_step_s;
  const double room = std::min(gap_m, window.rest) - window.floor;
  const double dip = std::max(kDipShare * room, kSlidingNoise * window.rest);
  const auto straighten = [&](int i) { std::atomic_ref(bends[at(i)]).store(0, std::memory_order_relaxed); };
  if (-share * dot(row.n, accelerations[at(row.a)]) > dip) straighten(row.a);
  if (share * dot(row.n, accelerations[at(row.b)]) > dip) straighten(row.b);
}

}  // namespace carom
