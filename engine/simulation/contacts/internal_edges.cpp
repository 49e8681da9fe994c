#include "engine/simulation/contacts/internal_edges.h"

#include <algorithm>
#include <limits>

#include "engine/closest_features/pair/feature_distance.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

// One side of a placed pair.
struct Side {
  int body;
  const Shape& shape;
  const Pose& X;
  const Vec3& witness_W;
  Vec3 outwards_W;  // the contact's direction, away from the other side
};

Side sideOf(const PlacedPair& placed, bool b, const std::vector<Shape>& shapes) {
  const ShapePair& pair = placed.pair;
  if (b)
    return {pair.body_b, shapes[at(pair.shapes.b)], placed.X_WB, placed.closest.p_B_W, placed.closest.n_W};
  return {pair.body_a, shapes[at(pair.shapes.a)], placed.X_WA, placed.closest.p_A_W, -placed.closest.n_W};
}

// How far a part reaches along a direction.
double reachAlong(const Side& side, const Vec3& direction_W) {
  const ConvexPart& part = *side.shape.part;
  const Vec3 direction = side.X.rotation.conjugate() * direction_W;
  return dot(direction_W, side.X * part.core.vertex(part.core.support(direction))) + part.radius_m;
}

// A lower bound of how far a point is from a part; exact over faces, balls and capsules.
double heightOver(const Side& side, const Vec3& p_W) {
  const ConvexPart& part = *side.shape.part;
  const ConvexPolyhedron& core = part.core;
  const Vec3 p = side.X.rotation.conjugate() * (p_W - side.X.position);
  if (core.faceCount() == 0) {
    Vec3 nearest = core.vertex(0);
    if (core.edgeCount() > 0) {
      const Edge& edge = core.edge(0);
      const Vec3& tail = core.vertex(edge.tail);
      nearest = tail + std::clamp(dot(edge.direction, p - tail), 0.0, edge.length_m) * edge.direction;
    }
    return (p - nearest).norm() - part.radius_m;
  }
  double height = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < core.faceCount(); ++f) height = std::max(height, core.plane(f).signedDistance(p));
  return height - part.radius_m;
}

// A contact between `passing` and the edge of `edge` before it, and `other`, which holds the same body on
// `support`.
struct Passage {
  const PlacedPair& contact;
  const Side& passing;
  const Side& edge;
  const PlacedPair& other;
  const Side& held;
  const Side& support;
};

// Whether it is held so that it passes the edge.
bool passes(const Passage& passage, double dt_s, const std::vector<Body>& bodies) {
  const Side& passing = passage.passing;
  const Side& edge = passage.edge;
  const Side& support = passage.support;
  const PlacedPair& other = passage.other;
  if (support.body != edge.body && !bodies[at(passing.body)].moves()) return false;
  // What is round is held below its core, wherever the edge is.
  const Vec3& up = passage.held.outwards_W;
  const Vec3 lowest = passing.witness_W + passing.shape.part->radius_m * (passing.outwards_W - up);
  if (heightOver(support, lowest) > other.pair.window.manifold) return false;
  const double height = -reachAlong(passing, -up) - reachAlong(edge, up);
  const double held_at = (1.0 - tolerance::kRestBand) * other.pair.window.rest;
  const double sinks = std::max(0.0, other.closest.distance_m - held_at);
  const auto rising = [&](const Side& side) {
    return dot(up, bodies[at(side.body)].velocity.at(passing.witness_W - side.X.position));
  };
  const double closes =
      support.body == edge.body ? 0.0 : std::max(0.0, rising(edge) - rising(support)) * dt_s;
  return height - sinks - closes >= passage.contact.pair.window.floor;
}

// Whether a contact comes obliquely to what holds one of its bodies: where it lies flat, it may lie on both.
bool isOblique(const PlacedPair& contact, const Vec3& up) {
  return contact.closest.n_W.cross(up).norm() > kCrossingSine;
}

}  // namespace

bool isAtEdges(const PlacedPair& contact, const std::vector<Shape>& shapes) {
  const FeaturePair& features = contact.closest.features;
  if (features.a.kind == FeatureKind::kFace || features.b.kind == FeatureKind::kFace) return false;
  if (features.a.kind != FeatureKind::kEdge || features.b.kind != FeatureKind::kEdge) return true;
  const auto along = [&](int shape, const Pose& X, int edge) {
    return Vec3(X.rotation * shapes[at(shape)].part->core.edge(edge).direction);
  };
  const Vec3 across = along(contact.pair.shapes.a, contact.X_WA, features.a.index)
                          .cross(along(contact.pair.shapes.b, contact.X_WB, features.b.index));
  return across.norm() < kCrossingSine;
}

// What is asked of most comes first: a body has many contacts, and of each all others are asked.
bool passesEdge(const PlacedPair& contact, const PlacedPair& other, double dt_s,
                const std::vector<Body>& bodies, const std::vector<Shape>& shapes) {
  const FeaturePair& features = contact.closest.features;
  for (const bool b : {false, true}) {
    if ((b ? features.a : features.b).kind == FeatureKind::kFace) continue;  // no edge to pass
    const Side passing = sideOf(contact, b, shapes);
    for (const bool other_b : {false, true}) {
      const Side held = sideOf(other, other_b, shapes);
      if (held.body != passing.body) continue;
      if (!isOblique(contact, held.outwards_W) && !isAtEdges(contact, shapes)) continue;
      if (isAtEdges(other, shapes)) return false;
      const Side edge = sideOf(contact, !b, shapes);
      const Side support = sideOf(other, !other_b, shapes);
      if (passes({contact, passing, edge, other, held, support}, dt_s, bodies)) return true;
    }
  }
  return false;
}

}  // namespace carom
