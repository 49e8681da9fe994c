#include "engine/simulation/contacts/internal_edges.h"

#include <algorithm>

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

PlacedPair placedPair(const ShapePair& pair, const std::vector<Body>& bodies) {
  return {pair, pair.closest, bodies[at(pair.body_a)].X_WB, bodies[at(pair.body_b)].X_WB};
}

// The lowest point of a side by its contact. What is round is held below its core, wherever the edge is.
Vec3 lowestOf(const Side& side, const Vec3& up) {
  return side.witness_W + side.shape.part->radius_m * (side.outwards_W - up);
}

// Whether side b of a contact, or a, meets an edge or a vertex of the other there.
bool meetsEdge(const PlacedPair& contact, bool b) {
  const FeaturePair& features = contact.closest.features;
  return (b ? features.a : features.b).kind != FeatureKind::kFace;
}

// How far a part reaches along a direction.
double reachAlong(const Side& side, const Vec3& direction_W) {
  const ConvexPart& part = *side.shape.part;
  const Vec3 direction = side.X.rotation.conjugate() * direction_W;
  return dot(direction_W, side.X * part.core.vertex(part.core.support(direction))) + part.radius_m;
}

// Whether a point is so near a part, at most; a bound over its edges, exact over faces, balls and capsules.
bool isWithin(double height_m, const Side& side, const Vec3& p_W) {
  const ConvexPart& part = *side.shape.part;
  const ConvexPolyhedron& core = part.core;
  const double height = height_m + part.radius_m;
  const Vec3 p = side.X.rotation.conjugate() * (p_W - side.X.position);
  if (core.faceCount() == 0) {
    Vec3 nearest = core.vertex(0);
    if (core.edgeCount() > 0) {
      const Edge& edge = core.edge(0);
      const Vec3& tail = core.vertex(edge.tail);
      nearest = tail + std::clamp(dot(edge.direction, p - tail), 0.0, edge.length_m) * edge.direction;
    }
    return (p - nearest).norm() <= height;
  }
  for (int f = 0; f < core.faceCount(); ++f)
    if (core.plane(f).signedDistance(p) > height) return false;
  return true;
}

// A contact between `passing` and the edge of `edge` before it, and `other`, which holds the same body on
// `support`.
struct Passage {
  const PlacedPair& contact;
  const Side& passing;
  const Side& edge;
  const PlacedPair& other;
  const Side& support;
  const Vec3& up_W;
};

// What the contacts' points tell of it, where `up` is: that of what passes is above the edge's, and near what
// bears it, which lies below the plane of its own; that is no face's where two edges cross.
bool mayPass(const Side& passing, const Side& edge, const Vec3& up, const Vec3& support_W, double near_m,
             double floor_m) {
  const Vec3 lowest = lowestOf(passing, up);
  return dot(up, lowest - support_W) <= near_m && dot(up, lowest - lowestOf(edge, -up)) >= floor_m;
}

// Whether it is held so that it passes the edge.
bool passes(const Passage& passage, double dt_s, const std::vector<Body>& bodies) {
  const Side& passing = passage.passing;
  const Side& edge = passage.edge;
  const Side& support = passage.support;
  const PlacedPair& other = passage.other;
  if (support.body != edge.body && !bodies[at(passing.body)].moves()) return false;
  const Vec3& up = passage.up_W;
  const double near = other.pair.window.manifold;
  const double floor = passage.contact.pair.window.floor;
  if (!mayPass(passing, edge, up, support.witness_W, near, floor)) return false;
  if (!isWithin(near, support, lowestOf(passing, up))) return false;
  const double bottom = -reachAlong(passing, -up);
  if (bottom - dot(up, lowestOf(edge, -up)) < floor) return false;
  const double height = bottom - reachAlong(edge, up);
  const double held_at = (1.0 - tolerance::kRestBand) * other.pair.window.rest;
  const double sinks = std::max(0.0, other.closest.distance_m - held_at);
  const auto rising = [&](const Side& side) {
    return dot(up, bodies[at(side.body)].velocity.at(passing.witness_W - side.X.position));
  };
  const double closes =
      support.body == edge.body ? 0.0 : std::max(0.0, rising(edge) - rising(support)) * dt_s;
  return height - sinks - closes >= floor;
}

// Whether the direction of a contact is not determined by a face, nor by edges that cross. What is held by
// such a contact is not known to pass anything.
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

// Whether a contact comes obliquely to what holds one of its bodies: where it lies flat, it may lie on both.
bool isOblique(const PlacedPair& contact, const Vec3& up) {
  return contact.closest.n_W.cross(up).norm() > kCrossingSine;
}

}  // namespace

bool passesEdge(const PlacedPair& contact, const PlacedPair& other, double dt_s,
                const std::vector<Body>& bodies, const std::vector<Shape>& shapes) {
  for (const bool b : {false, true}) {
    if (!meetsEdge(contact, b)) continue;
    const Side passing = sideOf(contact, b, shapes);
    for (const bool other_b : {false, true}) {
      const Side held = sideOf(other, other_b, shapes);
      if (held.body != passing.body) continue;
      if (!isOblique(contact, held.outwards_W) && !isAtEdges(contact, shapes)) continue;
      if (isAtEdges(other, shapes)) return false;
      const Side edge = sideOf(contact, !b, shapes);
      const Side support = sideOf(other, !other_b, shapes);
      if (passes({contact, passing, edge, other, support, held.outwards_W}, dt_s, bodies)) return true;
    }
  }
  return false;
}

void BearingContacts::find(const PairTable& table, const PairedWorld& world, std::span<const int> active) {
  of_body_.resize(world.bodies.size());
  const std::size_t few = active.size() * kFewPairs / std::max<std::size_t>(1, table.active().size());
  world.crew.runStretches(active.size(), std::max<std::size_t>(1, few),
                          [&](std::size_t begin, std::size_t end) {
                            for (std::size_t k = begin; k < end; ++k) findOf(active[k], table, world);
                          });
}

void BearingContacts::findOf(int body, const PairTable& table, const PairedWorld& world) {
  std::vector<Bearing>& bearings = of_body_[at(body)];
  bearings.clear();
  if (!world.bodies[at(body)].moves()) return;
  for (const int index : table.pairsOf(body)) {
    const ShapePair& pair = table.pairs()[at(index)];
    if (!pair.lasts(world.settings.step_s) || isAtEdges(placedPair(pair, world.bodies), world.shapes))
      continue;
    const ClosestFeatures& closest = pair.closest;
    if (pair.body_a == body || !world.bodies[at(pair.body_a)].moves())
      bearings.push_back({index, pair.body_a, pair.window.manifold, -closest.n_W, closest.p_B_W});
    if (pair.body_b == body || !world.bodies[at(pair.body_b)].moves())
      bearings.push_back({index, pair.body_b, pair.window.manifold, closest.n_W, closest.p_A_W});
  }
}

bool BearingContacts::isInternal(int index, const PairTable& table, const PairedWorld& world) const {
  const ShapePair& pair = table.pairs()[at(index)];
  const PlacedPair contact = placedPair(pair, world.bodies);
  for (const bool b : {false, true}) {
    if (!meetsEdge(contact, b)) continue;
    const Side passing = sideOf(contact, b, world.shapes);
    const Side edge = sideOf(contact, !b, world.shapes);
    for (const Bearing& bearing :
         of_body_[at(world.bodies[at(passing.body)].moves() ? passing.body : edge.body)]) {
      const Vec3& up = bearing.up_W;
      if (bearing.held != passing.body || bearing.pair == index) continue;
      if (!isOblique(contact, up) && !isAtEdges(contact, world.shapes)) continue;
      // Asked before the bearing pair is looked up, which most need not be.
      if (!mayPass(passing, edge, up, bearing.p_W, bearing.highest_m, pair.window.floor)) continue;
      const PlacedPair other = placedPair(table.pairs()[at(bearing.pair)], world.bodies);
      const Side support = sideOf(other, other.pair.body_a == bearing.held, world.shapes);
      if (passes({contact, passing, edge, other, support, up}, world.settings.step_s, world.bodies))
        return true;
    }
  }
  return false;
}

}  // namespace carom
