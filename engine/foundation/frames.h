#pragma once
// Linear-algebra aliases and rigid transforms.
// Frames are named by a trailing letter: p_W is a point in the world frame, X_WB maps body-frame points to
// the world (p_W = X_WB * p_B). SI units, radians. Quaternions are unit and print as w, x, y, z. Tested in
// tests/engine/foundation/frames_test.cpp.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/foundation/dot.h"

namespace carom {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// A rigid transform X_AB: a rotation followed by a translation in metres.
struct Pose {
  Quat rotation = Quat::Identity();
  Vec3 position = Vec3::Zero();

  /// Maps a point from frame B to frame A.
  Vec3 operator*(const Vec3& p_B) const { return rotation * p_B + position; }

  /// X_AC = X_AB * X_BC.
  Pose operator*(const Pose& X_BC) const {
    return {rotation * X_BC.rotation, rotation * X_BC.position + position};
  }

  /// X_BA.
  Pose inverse() const {
    const Quat r = rotation.conjugate();
    return {r, -(r * position)};
  }
};

/// The matrix of a cross product: crossMatrix(a) * b = a x b.
inline Mat3 crossMatrix(const Vec3& a) {
  Mat3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// A unit vector perpendicular to unit `n`, and their right-handed third: (n, t1, t2). Deterministic.
struct TangentBasis {
  Vec3 t1;
  Vec3 t2;
};
TangentBasis tangentBasis(const Vec3& n);

}  // namespace carom
