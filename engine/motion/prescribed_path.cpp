#include "engine/motion/prescribed_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/foundation/contract.h"

namespace carom {

void PrescribedPath::add(double start_s, const Trajectory& path) {
  legs_.push_back({start_s, path});
  legs_.back().path.start_s = start_s;
}

PrescribedPath PrescribedPath::steady(const Pose& X_WB, const Vec3& velocity, const Vec3& spin) {
  PrescribedPath path;
  path.add(0.0, {0.0, X_WB, velocity, Vec3::Zero(), spin});
  return path;
}

void PrescribedPath::addLeg(const Keyframe& from, const Keyframe& to, Interpolation interpolation) {
  const double dt = to.time_s - from.time_s;
  const Vec3 way = to.X_WB.position - from.X_WB.position;
  Quat turn = to.X_WB.rotation * from.X_WB.rotation.conjugate();
  if (turn.w() < 0.0) turn.coeffs() *= -1.0;
  const Vec3 turned = rotationOf(turn);
  if (interpolation == Interpolation::kLinear) {
    add(from.time_s, {0.0, from.X_WB, way / dt, Vec3::Zero(), turned / dt});
    return;
  }
  // x'' = 4 x / dt^2 in the first half, its opposite in the second; the fastest is twice the mean.
  const double half = 0.5 * dt;
  const double share = 4.0 / (dt * dt);
  Trajectory rising{0.0, from.X_WB, Vec3::Zero(), share * way, Vec3::Zero()};
  rising.spin_change = {share * turned, 2.0 * turned.norm() / dt};
  const Pose middle{rising.at(half).rotation, from.X_WB.position + 0.5 * way};
  Trajectory braking{0.0, middle, 2.0 / dt * way, -share * way, 2.0 / dt * turned};
  braking.spin_change = {-share * turned, 2.0 * turned.norm() / dt};
  add(from.time_s, rising);
  add(from.time_s + half, braking);
}

PrescribedPath PrescribedPath::through(std::span<const Keyframe> keyframes, Interpolation interpolation,
                                       bool repeats) {
  REQUIRE(!keyframes.empty());
  PrescribedPath path;
  path.first_s_ = keyframes.front().time_s;
  for (std::size_t k = 0; k + 1 < keyframes.size(); ++k) {
    REQUIRE(keyframes[k].time_s < keyframes[k + 1].time_s, keyframes[k].time_s, keyframes[k + 1].time_s);
    path.addLeg(keyframes[k], keyframes[k + 1], interpolation);
  }
  const Keyframe& last = keyframes.back();
  if (repeats && keyframes.size() > 1)
    path.period_s_ = last.time_s - path.first_s_;
  else
    path.add(last.time_s, {0.0, last.X_WB, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  return path;
}

double PrescribedPath::roundStart(double time_s) const {
  if (!(period_s_ > 0.0) || time_s < first_s_) return 0.0;
  return std::floor((time_s - first_s_) / period_s_) * period_s_;
}

PrescribedPath::Piece PrescribedPath::pieceAt(double time_s, double same_s) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double soon_s = time_s + same_s;
  const double round_s = roundStart(soon_s);
  const auto after = std::find_if(legs_.begin(), legs_.end(),
                                  [&](const Leg& leg) { return leg.start_s + round_s > soon_s; });
  if (after == legs_.begin()) {
    Trajectory waiting;
    waiting.X_WB = legs_.front().path.X_WB;
    return {waiting, legs_.front().start_s - time_s};
  }
  const Trajectory& leg = std::prev(after)->path;
  const double t = time_s - round_s;
  Trajectory path{0.0, leg.at(t), leg.velocityAt(t), leg.acceleration, leg.angularVelocityAt(t)};
  path.spin_change = leg.spin_change;
  const double end_s = after != legs_.end() ? after->start_s + round_s - time_s
                       : period_s_ > 0.0    ? first_s_ + period_s_ + round_s - time_s
                                            : kNever;
  return {path, end_s};
}

Pose PrescribedPath::poseAt(double time_s) const {
  return pieceAt(time_s, 0.0).path.X_WB;
}

}  // namespace carom
