// The poses of the benchmarks' motions.

#include "tests/bench/peers/pose_loop.h"

#include <algorithm>
#include <numbers>

#include "tests/bench/peers/carom_query.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {
namespace {

using oracle::Random;

constexpr double kSize_m = 1.0;
constexpr double kTurn_rad = std::numbers::pi / 180;

struct GapRange {
  double least_m;
  double most_m;
};

GapRange gapRange(Motion motion) {
  if (motion == Motion::kCoherentShallow) return {-0.10 * kSize_m, -0.01 * kSize_m};
  if (motion == Motion::kCoherentDeep) return {-0.50 * kSize_m, -0.20 * kSize_m};
  return {0.05 * kSize_m, 1.0 * kSize_m};
}

// Where B must stand along `u` from A for about the wanted gap: the least distance at which no direction
// tried shows a larger one. Tried are u and, of hulls with few features, the normals of faces and the common
// perpendiculars of edges; other hulls are so round that u comes close. No library is asked, so the poses
// favour none.
class GapAlong {
 public:
  GapAlong(const ConvexPart& part, const Pose& X_WA, const Quat& R_WB, const Vec3& u)
      : core_(part.core), X_WA_(X_WA), R_WB_(R_WB), u_(u) {}

  Vec3 positionAt(double gap_m) {
    constexpr int kFewFaces = 128, kFewEdges = 32;
    between_m_ = 4.0 * kSize_m;
    consider(u_, gap_m);
    for (int f = 0; core_.faceCount() <= kFewFaces && f < core_.faceCount(); ++f) {
      consider(X_WA_.rotation * core_.plane(f).normal, gap_m);
      consider(-(R_WB_ * core_.plane(f).normal), gap_m);
    }
    for (int i = 0; core_.edgeCount() <= kFewEdges && i < core_.edgeCount(); ++i)
      for (int j = 0; j < core_.edgeCount(); ++j) {
        const Vec3 n = (X_WA_.rotation * core_.edge(i).direction).cross(R_WB_ * core_.edge(j).direction);
        if (n.norm() > 1e-6) consider(n.dot(u_) > 0.0 ? n.normalized() : -n.normalized(), gap_m);
      }
    return X_WA_.position + between_m_ * u_;
  }

 private:
  void consider(const Vec3& n_W, double gap_m) {
    const double along = n_W.dot(u_);
    if (along <= 0.0) return;
    const Vec3 n_A = X_WA_.rotation.conjugate() * n_W, n_B = R_WB_.conjugate() * n_W;
    const double reach_a = n_A.dot(core_.vertex(core_.support(n_A)));
    const double reach_b = -n_B.dot(core_.vertex(core_.support(-n_B)));
    between_m_ = std::min(between_m_, (gap_m + reach_a + reach_b) / along);
  }

  const ConvexPolyhedron& core_;
  const Pose& X_WA_;
  const Quat& R_WB_;
  const Vec3& u_;
  double between_m_ = 0.0;
};

// A unit vector that wanders.
void wander(Vec3& axis, Random& random) {
  axis = (axis + 0.1 * random.direction()).normalized();
}

std::vector<PosePair> coherentLap(Motion motion, const ConvexPart& part, Random& random) {
  constexpr int kHalf = kLap / 2, kSwings = 3;
  const GapRange range = gapRange(motion);
  Pose X_WA = random.pose(0.5), X_WB = random.pose(0.5);
  Vec3 axis_a = random.direction(), axis_b = random.direction(), axis_u = random.direction();
  Vec3 u = random.direction(), course = random.direction();
  std::vector<PosePair> lap;
  for (int i = 0; i < kHalf; ++i) {
    for (Vec3* axis : {&axis_a, &axis_b, &axis_u, &course}) wander(*axis, random);
    X_WA.rotation = (oracle::turned(axis_a, kTurn_rad) * X_WA.rotation).normalized();
    X_WB.rotation = (oracle::turned(axis_b, kTurn_rad) * X_WB.rotation).normalized();
    X_WA.position += 0.002 * kSize_m * course;
    u = (oracle::turned(axis_u, 0.25 * kTurn_rad) * u).normalized();
    const double phase = 2.0 * std::numbers::pi * kSwings * i / kHalf;
    const double gap_m = range.least_m + (range.most_m - range.least_m) * 0.5 * (1.0 - std::cos(phase));
    X_WB.position = GapAlong(part, X_WA, X_WB.rotation, u).positionAt(gap_m);
    lap.push_back({plain(X_WA), plain(X_WB)});
  }
  for (int i = kHalf - 1; i >= 0; --i) lap.push_back(lap[static_cast<std::size_t>(i)]);
  return lap;
}

std::vector<PosePair> randomLap(const ConvexPart& part, Random& random) {
  const GapRange range = gapRange(Motion::kRandomSeparated);
  std::vector<PosePair> lap;
  for (int i = 0; i < kLap; ++i) {
    const Pose X_WA = random.pose(0.5);
    Pose X_WB{random.rotation(), Vec3::Zero()};
    const double gap_m = random.uniform(range.least_m, range.most_m);
    const Vec3 u = random.direction();
    X_WB.position = GapAlong(part, X_WA, X_WB.rotation, u).positionAt(gap_m);
    lap.push_back({plain(X_WA), plain(X_WB)});
  }
  return lap;
}

// A spiral of equal areas from pole to pole, each point moved by up to a tenth of their spacing.
std::vector<Vec3> spreadPoints(int n) {
  Random random(static_cast<std::uint64_t>(n));
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double jitter = 0.1 * std::sqrt(4.0 * std::numbers::pi / n);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / n;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 p(r * std::cos(golden * i), r * std::sin(golden * i), z);
    points.push_back((p + jitter * random.direction()).normalized());
  }
  return points;
}

}  // namespace

const char* motionName(Motion motion) {
  static const char* names[] = {"CoherentSeparated", "RandomSeparated", "CoherentShallow", "CoherentDeep"};
  return names[static_cast<std::size_t>(motion)];
}

ConvexPart benchPart(int n) {
  if (n == 8) return {boxPolyhedron(Vec3(1.0, 0.8, 0.6) / std::sqrt(2.0)), 0.0};  // 1 + 0.64 + 0.36 = 2
  std::vector<Vec3> points = n == 20 ? oracle::dodecahedronPoints() : spreadPoints(n);
  for (Vec3& p : points) p = 0.5 * kSize_m * p.normalized();
  return {convexHull(points).polyhedron, 0.0};
}

std::vector<PosePair> poseLoop(Motion motion, const ConvexPart& part, std::uint64_t seed) {
  Random random(seed);
  return motion == Motion::kRandomSeparated ? randomLap(part, random) : coherentLap(motion, part, random);
}

}  // namespace carom::bench
