// Prescribed paths against their definition: keyframes are met at their times, velocities are the derivatives
// of places, pieces follow each other without a gap, and repeating paths have no seam.

#include "engine/motion/prescribed_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carom {
namespace {

Quat about(const Vec3& axis, double radians) {
  return rotationBy(radians * axis.normalized());
}

const std::vector<Keyframe> kKeys{{0.3, {about(Vec3(1, 2, 3), 0.4), Vec3(1, 2, 3)}},
                                  {1.1, {about(Vec3(-1, 1, 0), 2.0), Vec3(2, 0, 1)}},
                                  {1.7, {about(Vec3(0, 1, 1), -1.0), Vec3(-1, 0.5, 2)}},
                                  {2.9, {about(Vec3(1, 2, 3), 0.4), Vec3(1, 2, 3)}}};

double apart(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() + a.rotation.angularDistance(b.rotation);
}

TEST(PrescribedPath, MeetsItsKeyframes) {
  for (const Interpolation how : {Interpolation::kLinear, Interpolation::kSmooth})
    for (const bool repeats : {false, true}) {
      const PrescribedPath path = PrescribedPath::through(kKeys, how, repeats);
      for (const Keyframe& key : kKeys) {
        EXPECT_LT(apart(path.poseAt(key.time_s), key.X_WB), 1e-14) << key.time_s;
        if (!repeats) continue;
        EXPECT_LT(apart(path.poseAt(key.time_s + 26.0), key.X_WB), 1e-13) << key.time_s;
      }
      EXPECT_EQ(apart(path.poseAt(0.0), kKeys.front().X_WB), 0.0) << "it waits for the first";
      const Pose& late = repeats ? path.poseAt(7.7 + 0.0) : kKeys.back().X_WB;
      EXPECT_LT(apart(path.poseAt(repeats ? 5.1 : 5.0), late), 1e-13) << "it begins again, or stays";
    }
}

TEST(PrescribedPath, HasTheVelocityOfItsPlaces) {
  constexpr double kH = 1e-5;
  for (const Interpolation how : {Interpolation::kLinear, Interpolation::kSmooth}) {
    const PrescribedPath path = PrescribedPath::through(kKeys, how, true);
    for (double t = 0.3 + 0.05; t < 8.0; t += 0.0613) {
      const Trajectory now = path.pieceAt(t, 0.0).path;
      const Pose before = path.poseAt(t - kH), after = path.poseAt(t + kH);
      EXPECT_LT((now.velocity - (after.position - before.position) / (2 * kH)).norm(), 1e-3) << t;
      EXPECT_LT((now.spin - rotationOf(after.rotation * before.rotation.conjugate()) / (2 * kH)).norm(), 1e-3)
          << t;
    }
  }
}

TEST(PrescribedPath, ItsPiecesFollowEachOther) {
  for (const Interpolation how : {Interpolation::kLinear, Interpolation::kSmooth}) {
    const PrescribedPath path = PrescribedPath::through(kKeys, how, true);
    double t = 0.0;
    for (int i = 0; i < 30; ++i) {
      const PrescribedPath::Piece piece = path.pieceAt(t, 1e-12);
      ASSERT_GT(piece.end_s, 0.1);
      const PrescribedPath::Piece next = path.pieceAt(t + piece.end_s, 1e-12);
      EXPECT_LT(apart(piece.path.at(piece.end_s), next.path.X_WB), 1e-13) << t;
      if (how == Interpolation::kSmooth) {
        EXPECT_LT((piece.path.velocityAt(piece.end_s) - next.path.velocity).norm(), 1e-12) << t;
      }
      EXPECT_LE(piece.path.angularVelocityAt(0.5 * piece.end_s).norm(), piece.path.fastestSpin() + 1e-12);
      t += piece.end_s;
    }
  }
}

TEST(SteadyPath, IsExactAtAnyTime) {
  const Pose X{about(Vec3(1, 2, 3), 0.4), Vec3(1, 2, 3)};
  const PrescribedPath path = PrescribedPath::steady(X, Vec3(1, 0, -2), Vec3(0.5, 3, 1));
  const Pose later = path.poseAt(1234.5);
  EXPECT_EQ(later.position, X.position + 1234.5 * Vec3(1, 0, -2));
  EXPECT_LT(later.rotation.angularDistance(rotationBy(1234.5 * Vec3(0.5, 3, 1)) * X.rotation), 1e-12);
  EXPECT_TRUE(std::isinf(path.pieceAt(7.0, 0.0).end_s));
}

}  // namespace
}  // namespace carom
