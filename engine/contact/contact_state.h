#pragma once
// The four contact states of paper §2.1 (V-V, V-E, V-F, E-E; figs. 2-5) and their conversion to the common
// one: a point and a normal. Tested in tests/engine/contact/contact_state_test.cpp.

#include "engine/closest_features/vclip.h"

namespace carom {

enum class ContactState : std::uint8_t { kVertexVertex, kVertexEdge, kVertexFace, kEdgeEdge };
const char* contactStateName(ContactState state);
ContactState contactStateOf(const FeaturePair& features);

/// A point of contact: where, along which unit normal (A to B), and how far the bodies are apart there.
struct ContactPoint {
  Vec3 p_W = Vec3::Zero();  ///< Halfway between the two bodies.
  Vec3 n_W = Vec3::UnitZ();
  double gap_m = 0.0;
};

/// V-F: the vertex and the face's normal (§2.1.1). V-V: the line of the two vertices (§2.1.2). V-E: from the
/// closest point X on the edge to the vertex (§2.1.3; DEVIATES: the paper prints n = X - E). E-E: the product
/// of the edges' directions, turned outwards by the faces at the base edge (§2.1.4).
ContactPoint contactPoint(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                          const ConvexPart& b, const Pose& X_WB);

}  // namespace carom
