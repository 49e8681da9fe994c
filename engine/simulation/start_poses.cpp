#include "engine/simulation/start_poses.h"

#include <algorithm>

namespace carom {
namespace {

constexpr int kPasses = 400;
// Bodies are brought this far above the floor, so that the first step has room.
constexpr double kRoom = 1.5;
// Deeper than this, relative to the smaller body, bodies overlap; less is rounding of poses that touch.
constexpr double kOverlap = 1e-9;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double overlapDepth(const ShapePair& pair) {
  const double scale = pair.window.rest / tolerance::kRestGap;
  return pair.closest.distance_m < -kOverlap * scale ? -pair.closest.distance_m : 0.0;
}

// Which of the pair gives way: the one that can, or the one farther up.
Body& yielding(std::vector<Body>& bodies, const ShapePair& pair, const Vec3& gravity, double& direction) {
  Body& a = bodies[at(pair.body_a)];
  Body& b = bodies[at(pair.body_b)];
  const bool b_above = gravity.dot(b.X_WB.position) <= gravity.dot(a.X_WB.position);
  const bool move_b = a.is_static || (!b.is_static && b_above);
  direction = move_b ? 1.0 : -1.0;
  return move_b ? b : a;
}

}  // namespace

std::vector<Overlap> separateTouching(std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                                      PairTable& table, const Vec3& gravity) {
  StepCounters counters;
  std::vector<Overlap> overlaps;
  for (const ShapePair& pair : table.pairs())
    if (const double depth = overlapDepth(pair); depth > 0.0)
      overlaps.push_back({pair.body_a, pair.body_b, depth});
  std::sort(overlaps.begin(), overlaps.end(),
            [](const Overlap& x, const Overlap& y) { return x.depth_m > y.depth_m; });
  if (!overlaps.empty()) return overlaps;

  bool changed = true;
  for (int pass = 0; changed && pass < kPasses; ++pass) {
    changed = false;
    for (ShapePair& pair : table.pairs()) {
      pair.closest =
          closestFeatures(*shapes[at(pair.shapes.a)].part, bodies[at(pair.body_a)].X_WB,
                          *shapes[at(pair.shapes.b)].part, bodies[at(pair.body_b)].X_WB, pair.tracked);
      const double missing = pair.window.floor - pair.closest.distance_m;
      if (missing <= 0.0) continue;
      double direction = 1.0;
      Body& body = yielding(bodies, pair, gravity, direction);
      body.X_WB.position += direction * (missing + (kRoom - 1.0) * pair.window.floor) * pair.closest.n_W;
      body.path.X_WB = body.X_WB;
      changed = true;
    }
  }
  Crew alone;
  table.requery(bodies, shapes, alone, counters);
  for (const ShapePair& pair : table.pairs())
    if (pair.closest.distance_m <= 0.0)
      overlaps.push_back({pair.body_a, pair.body_b, -pair.closest.distance_m});
  return overlaps;
}

}  // namespace carom
