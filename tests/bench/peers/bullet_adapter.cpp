// Bullet: convex hull shapes without margin, GJK with EPA for the depth. Built in double precision where the
// package has it. Only the bullet_*.cpp of this folder name Bullet.

#include <cmath>

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "tests/bench/peers/library.h"

namespace carom::bench {

Library bulletLibrary();

namespace {

btScalar narrowed(double x) {
  return static_cast<btScalar>(x);
}

btTransform transformOf(const PlainPose& X) {
  const auto& q = X.rotation_wxyz;
  const auto& p = X.position;
  btQuaternion rotation(narrowed(q[1]), narrowed(q[2]), narrowed(q[3]), narrowed(q[0]));
  rotation.normalize();
  return btTransform(rotation, btVector3(narrowed(p[0]), narrowed(p[1]), narrowed(p[2])));
}

class BulletPair : public PairQuery {
 public:
  BulletPair(const Hull& a, const Hull& b) {
    fill(a_, a);
    fill(b_, b);
  }

  void setPoses(std::span<const PosePair> poses) override {
    X_WA_.clear();
    X_WB_.clear();
    for (const PosePair& pair : poses) {
      X_WA_.push_back(transformOf(pair.X_WA));
      X_WB_.push_back(transformOf(pair.X_WB));
    }
  }
  void forget() override {}
  double ask(std::size_t i) override {
    btGjkPairDetector detector(&a_, &b_, &simplex_, &depth_);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = X_WA_[i];
    input.m_transformB = X_WB_[i];
    btPointCollector nearest;
    detector.getClosestPoints(input, nearest, nullptr);
    return nearest.m_hasResult ? double(nearest.m_distance) : std::nan("");
  }

 private:
  static void fill(btConvexHullShape& shape, const Hull& hull) {
    for (const auto& v : hull.vertices)
      shape.addPoint(btVector3(narrowed(v[0]), narrowed(v[1]), narrowed(v[2])), false);
    shape.setMargin(0);
    shape.recalcLocalAabb();
  }

  btConvexHullShape a_, b_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depth_;
  std::vector<btTransform> X_WA_, X_WB_;
};

}  // namespace

Library bulletLibrary() {
  const double tolerance = sizeof(btScalar) == sizeof(double) ? 1e-6 : 1e-4;
  return {"bullet", Gives::kDistance, tolerance,
          [](const Hull& a, const Hull& b) -> std::unique_ptr<PairQuery> {
            return std::make_unique<BulletPair>(a, b);
          }};
}

}  // namespace carom::bench
