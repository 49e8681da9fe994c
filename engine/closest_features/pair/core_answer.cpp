#include "engine/closest_features/pair/core_answer.h"

namespace carom {
namespace {

inline Vec3 acrossEdge(const Vec3& direction, const Vec3& w) {
  return w - dot(direction, w) * direction;
}

inline Across ofLength(const Vec3& w) {
  return {w, w.norm(), false};
}

}  // namespace

Across acrossOf(const PolyhedronPair& pair, const FeatureDistance& d) {
  const auto [a, b] = d.features;
  if (a.kind == FeatureKind::kFace) return {pair.a.plane(a.index).normal, 1.0, true};
  if (b.kind == FeatureKind::kFace) return {-pair.directionToA(pair.b.plane(b.index).normal), 1.0, true};
  const Vec3 between = d.p_b - d.p_a;
  if (a.kind == FeatureKind::kVertex && b.kind == FeatureKind::kVertex) return {between, d.distance(), false};
  // Across an edge to the last bit: of a short way rounding would leave a slope along it.
  if (a.kind == FeatureKind::kVertex)
    return ofLength(acrossEdge(pair.directionToA(pair.b.edge(b.index).direction), between));
  const Vec3& along_a = pair.a.edge(a.index).direction;
  if (b.kind == FeatureKind::kVertex) return ofLength(acrossEdge(along_a, between));
  const Vec3 along_b = pair.directionToA(pair.b.edge(b.index).direction);
  const Vec3 common = along_a.cross(along_b);
  const double sine = common.norm();
  if (sine > kCrossingSine) return {dot(common, between) > 0.0 ? common : -common, sine, true};
  return ofLength(acrossEdge(along_b, acrossEdge(along_a, between)));
}

CoreAnswer answerFrom(const PolyhedronPair& pair, const FeatureDistance& found) {
  return {found.distance(), acrossOf(pair, found).unit(), found.p_a, found.p_b, found.features};
}

}  // namespace carom
