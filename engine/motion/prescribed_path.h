#pragma once
// The path of a kinematic body, known for all times before the world begins: constant velocity and spin, or
// legs between keyframes. Every leg is one or two pieces of a Trajectory, so that pose and velocity at any
// time are exact and nothing drifts: they are reckoned from the piece's beginning, not from step to step.
// Tested in tests/engine/motion/prescribed_path_test.cpp.

#include <span>
#include <vector>

#include "engine/motion/trajectory.h"

namespace carom {

/// Where a body is to be at a time.
struct Keyframe {
  double time_s = 0.0;
  Pose X_WB;
};

/// How a body goes from one keyframe to the next.
enum class Interpolation : std::uint8_t {
  kLinear,  ///< At one velocity and one spin, the shorter way round; they jump at keyframes.
  kSmooth   ///< From rest to rest: it speeds up evenly for half of the time, and brakes evenly.
};

class PrescribedPath {
 public:
  /// For ever at these velocities, m/s and rad/s, world frame.
  static PrescribedPath steady(const Pose& X_WB, const Vec3& velocity, const Vec3& spin);
  /// Through keyframes whose times rise; before the first and after the last it lies still. `repeats`: from
  /// the last on everything comes again, for ever; it must end as it begins.
  static PrescribedPath through(std::span<const Keyframe> keyframes, Interpolation interpolation,
                                bool repeats);

  /// The piece on which the body is at `time_s` and just after, or will be within `same_s` seconds; its
  /// times are counted from `time_s`, where it starts.
  struct Piece {
    Trajectory path;
    double end_s = 0.0;  ///< When the next begins; +infinity: never.
  };
  Piece pieceAt(double time_s, double same_s) const;
  Pose poseAt(double time_s) const;

 private:
  struct Leg {
    double start_s = 0.0;
    Trajectory path;  ///< `start_s` of it is the leg's.
  };
  void add(double start_s, const Trajectory& path);
  void addLeg(const Keyframe& from, const Keyframe& to, Interpolation interpolation);
  /// The time within the first round, and when that round began.
  double roundStart(double time_s) const;

  std::vector<Leg> legs_;
  double first_s_ = 0.0;
  double period_s_ = 0.0;  ///< 0: it does not repeat.
};

}  // namespace carom
