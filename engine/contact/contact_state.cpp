#include "engine/contact/contact_state.h"

#include <algorithm>

namespace carom {
namespace {

// Edges closer to parallel than this have no usable product; the line between the witnesses serves instead.
constexpr double kNoProductSine = 1e-6;

Vec3 edgeEdgeNormal(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                    const ConvexPart& b, const Pose& X_WB) {
  const Edge& base = a.core.edge(closest.features.a.index);
  const Vec3 product =
      (X_WA.rotation * base.direction).cross(X_WB.rotation * b.core.edge(closest.features.b.index).direction);
  const double sine = product.norm();
  if (sine < kNoProductSine) return closest.n_W;
  const Vec3 n = product / sine;
  if (base.left < 0) return dot(n, closest.n_W) < 0.0 ? Vec3(-n) : n;
  // Less than 90 degrees to both faces at the base edge: outwards (fig. 5).
  const Vec3 outward = X_WA.rotation * (a.core.plane(base.left).normal + a.core.plane(base.right).normal);
  return dot(n, outward) < 0.0 ? Vec3(-n) : n;
}

}  // namespace

const char* contactStateName(ContactState state) {
  switch (state) {
    case ContactState::kVertexVertex:
      return "V-V";
    case ContactState::kVertexEdge:
      return "V-E";
    case ContactState::kVertexFace:
      return "V-F";
    case ContactState::kEdgeEdge:
      return "E-E";
  }
  return "?";
}

ContactState contactStateOf(const FeaturePair& features) {
  const FeatureKind low = std::min(features.a.kind, features.b.kind);
  const FeatureKind high = std::max(features.a.kind, features.b.kind);
  if (high == FeatureKind::kFace) return ContactState::kVertexFace;
  if (low == FeatureKind::kEdge) return ContactState::kEdgeEdge;
  return high == FeatureKind::kEdge ? ContactState::kVertexEdge : ContactState::kVertexVertex;
}

ContactPoint contactPoint(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                          const ConvexPart& b, const Pose& X_WB) {
  ContactPoint point{0.5 * (closest.p_A_W + closest.p_B_W), closest.n_W, closest.distance_m};
  switch (contactStateOf(closest.features)) {
    case ContactState::kVertexFace:
      point.n_W = closest.features.a.kind == FeatureKind::kFace
                      ? Vec3(X_WA.rotation * a.core.plane(closest.features.a.index).normal)
                      : Vec3(-(X_WB.rotation * b.core.plane(closest.features.b.index).normal));
      break;
    case ContactState::kEdgeEdge:
      point.n_W = edgeEdgeNormal(closest, a, X_WA, b, X_WB);
      break;
    case ContactState::kVertexVertex:
    case ContactState::kVertexEdge:
      break;  // the line between the witnesses, which is what the closest features' normal is
  }
  return point;
}

}  // namespace carom
