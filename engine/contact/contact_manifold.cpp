#include "engine/contact/contact_manifold.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {
namespace {

using tolerance::kLyingSine;

constexpr double kSameCosine = 1e-9;  // normals this close are one direction
constexpr double kSameGap = 1e-3;     // of the window's floor: gaps this close are one gap

struct Corner {
  Vec3 p_W;
  std::uint64_t id;
};

std::uint64_t combineIds(std::uint64_t a, std::uint64_t b) {
  return (a * 0x9E3779B97F4A7C15ull) ^ (b + 0x632BE59BD9B4E019ull);
}

// One of the two parts, with what clipping asks of it in world terms.
struct Placed {
  const ConvexPolyhedron& core;
  Pose X_W;
  double radius_m;

  Vec3 vertex(int v) const { return X_W * core.vertex(v); }
  Vec3 faceNormal(int f) const { return X_W.rotation * core.plane(f).normal; }
  Vec3 edgeDirection(int e) const { return X_W.rotation * core.edge(e).direction; }

  // The faces and edges at a feature, itself included.
  std::vector<int> facesAt(Feature feature) const {
    if (feature.kind == FeatureKind::kFace) return {feature.index};
    std::vector<int> faces;
    for (int e : edgesAt(feature))
      for (int f : {core.edge(e).left, core.edge(e).right})
        if (f >= 0 && std::find(faces.begin(), faces.end(), f) == faces.end()) faces.push_back(f);
    return faces;
  }
  std::vector<int> edgesAt(Feature feature) const {
    if (feature.kind == FeatureKind::kEdge) return {feature.index};
    const std::span<const int> edges = feature.kind == FeatureKind::kVertex ? core.vertexEdges(feature.index)
                                                                            : core.faceEdges(feature.index);
    return {edges.begin(), edges.end()};
  }
};

// The face at the feature whose normal comes nearest to `direction`, if it is within the lying angle of it.
int faceTowards(const Placed& part, Feature feature, const Vec3& direction) {
  int best = -1;
  double most = std::sqrt(1.0 - kLyingSine * kLyingSine);
  for (int f : part.facesAt(feature))
    if (const double c = part.faceNormal(f).dot(direction); c > most) {
      most = c;
      best = f;
    }
  return best;
}

// The edge at the feature that is flattest against `normal`, if it lies within the lying angle.
int edgeAcross(const Placed& part, Feature feature, const Vec3& normal) {
  int best = -1;
  double least = kLyingSine;
  for (int e : part.edgesAt(feature))
    if (const double s = std::abs(part.edgeDirection(e).dot(normal)); s < least) {
      least = s;
      best = e;
    }
  return best;
}

// What of a part lies on a reference plane with this outward normal: a face, an edge, or nothing more than a
// point.
std::vector<Corner> lyingFeature(const Placed& part, Feature feature, const Vec3& normal) {
  std::vector<Corner> corners;
  if (const int f = faceTowards(part, feature, -normal); f >= 0) {
    for (int v : part.core.faceVertices(f))
      corners.push_back({part.vertex(v), static_cast<std::uint64_t>(v)});
  } else if (const int e = edgeAcross(part, feature, normal); e >= 0) {
    for (int v : {part.core.edge(e).tail, part.core.edge(e).head})
      corners.push_back({part.vertex(v), static_cast<std::uint64_t>(v)});
  }
  return corners;
}

// Sutherland-Hodgman: the part of a convex polygon (or of an edge: two corners) with signed distance >= 0.
template <typename Distance>
std::vector<Corner> clip(const std::vector<Corner>& polygon, std::uint64_t side_id, Distance&& distance) {
  std::vector<Corner> kept;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& here = polygon[i];
    const Corner& next = polygon[(i + 1) % n];
    const double h_here = distance(here.p_W);
    const double h_next = distance(next.p_W);
    if (h_here >= 0.0) kept.push_back(here);
    if (n == 2 && i == 1) break;  // an edge has one stretch, not two
    if ((h_here >= 0.0) != (h_next >= 0.0)) {
      const double t = h_here / (h_here - h_next);
      const std::uint64_t stretch = combineIds(std::min(here.id, next.id), std::max(here.id, next.id));
      kept.push_back({here.p_W + t * (next.p_W - here.p_W), combineIds(stretch, side_id + (1ull << 32))});
    }
  }
  return kept;
}

// The points of `incident`'s lying feature over face f of `reference`, gaps measured along the face's normal.
std::vector<ManifoldPoint> clipOverFace(const Placed& reference, int f, const Placed& incident,
                                        Feature feature, double k) {
  const Vec3 normal = reference.faceNormal(f);
  const Vec3 on_face = reference.vertex(reference.core.faceVertices(f)[0]);
  const double radii = reference.radius_m + incident.radius_m;
  std::vector<Corner> polygon = lyingFeature(incident, feature, normal);
  if (polygon.empty()) return {};
  const auto height = [&](const Vec3& p) { return normal.dot(p - on_face) - radii; };
  for (int e : reference.core.faceEdges(f)) {
    const Vec3 into = reference.X_W.rotation * reference.core.intoFace(e, f);
    const Vec3 on_edge = reference.vertex(reference.core.edge(e).tail);
    polygon =
        clip(polygon, static_cast<std::uint64_t>(e), [&](const Vec3& p) { return into.dot(p - on_edge); });
    if (polygon.empty()) return {};
  }
  polygon = clip(polygon, (1ull << 31), [&](const Vec3& p) { return k - height(p); });
  std::vector<ManifoldPoint> points;
  for (const Corner& c : polygon) {
    const double gap = height(c.p_W);
    points.push_back({c.p_W - (incident.radius_m + 0.5 * gap) * normal, normal, gap, c.id});
  }
  return points;
}

// Two edges that run alongside each other without a face to lie on (capsules, roof ridges): the ends of the
// stretch they share.
std::vector<ManifoldPoint> sharedStretch(const Placed& a, int ea, const Placed& b, int eb, const Vec3& n) {
  const Vec3 along = a.edgeDirection(ea);
  if (along.cross(b.edgeDirection(eb)).norm() > kLyingSine) return {};
  const Edge& edge_a = a.core.edge(ea);
  const Edge& edge_b = b.core.edge(eb);
  const Vec3 origin = a.vertex(edge_a.tail);
  const Vec3 b_tail = b.vertex(edge_b.tail);
  const Vec3 b_head = b.vertex(edge_b.head);
  const double t_tail = along.dot(b_tail - origin);
  const double t_head = along.dot(b_head - origin);
  const double low = std::max(0.0, std::min(t_tail, t_head));
  const double high = std::min(edge_a.length_m, std::max(t_tail, t_head));
  if (!(high > low)) return {};
  std::vector<ManifoldPoint> points;
  for (const double t : {low, high}) {
    const Vec3 p_a = origin + t * along + a.radius_m * n;
    const double share = (t - t_tail) / (t_head - t_tail);
    const Vec3 p_b = b_tail + share * (b_head - b_tail) - b.radius_m * n;
    points.push_back({0.5 * (p_a + p_b), n, n.dot(p_b - p_a), t == low ? 1ull : 2ull});
  }
  return points;
}

double triangleArea(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).norm();
}

// Keeps the deepest point, the farthest from it, the farthest from their line, and the one that adds most
// area on the other side.
void reduce(std::vector<ManifoldPoint>& points, const Vec3& n) {
  if (points.size() <= ContactManifold::kFacePoints) return;
  std::vector<ManifoldPoint> kept;
  const auto take = [&](auto&& score) {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const double s = score(points[i]); s > most) {
        most = s;
        best = i;
      }
    kept.push_back(points[best]);
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(best));
  };
  double least = points[0].gap_m;
  for (const ManifoldPoint& p : points) least = std::min(least, p.gap_m);
  take([&](const ManifoldPoint& p) { return p.gap_m == least ? 1.0 : 0.0; });
  take([&](const ManifoldPoint& p) { return (p.p_W - kept[0].p_W).squaredNorm(); });
  take([&](const ManifoldPoint& p) { return triangleArea(kept[0].p_W, kept[1].p_W, p.p_W); });
  const Vec3 c0 = kept[0].p_W, c1 = kept[1].p_W, c2 = kept[2].p_W;
  const double turn = n.dot((c1 - c0).cross(c2 - c0)) < 0.0 ? -1.0 : 1.0;
  take([&](const ManifoldPoint& p) {
    double added = 0.0;  // what p adds beyond the triangle's sides
    for (const auto& [u, v] : {std::pair{c0, c1}, std::pair{c1, c2}, std::pair{c2, c0}})
      added = std::max(added, -turn * n.dot((v - u).cross(p.p_W - u)));
    return added;
  });
  points = std::move(kept);
}

}  // namespace

ContactManifold contactManifold(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                                const ConvexPart& b, const Pose& X_WB, const CollisionWindow& window) {
  const ContactPoint single = contactPoint(closest, a, X_WA, b, X_WB);
  const Placed on_a{a.core, X_WA, a.radius_m};
  const Placed on_b{b.core, X_WB, b.radius_m};

  // The reference is the face that comes nearest to the contact's normal.
  const int face_a = faceTowards(on_a, closest.features.a, single.n_W);
  const int face_b = faceTowards(on_b, closest.features.b, -single.n_W);
  const double c_a = face_a >= 0 ? on_a.faceNormal(face_a).dot(single.n_W) : -1.0;
  const double c_b = face_b >= 0 ? -on_b.faceNormal(face_b).dot(single.n_W) : -1.0;
  std::vector<ManifoldPoint> points;
  std::uint64_t reference_id = 0;
  if (face_a >= 0 && c_a >= c_b - kSameCosine) {
    points = clipOverFace(on_a, face_a, on_b, closest.features.b, window.manifold);
    reference_id = 2 * static_cast<std::uint64_t>(face_a) + 2;
  } else if (face_b >= 0) {
    points = clipOverFace(on_b, face_b, on_a, closest.features.a, window.manifold);
    for (ManifoldPoint& p : points) p.n_W = -p.n_W;
    reference_id = 2 * static_cast<std::uint64_t>(face_b) + 3;
  } else if (closest.features.a.kind != FeatureKind::kFace && closest.features.b.kind != FeatureKind::kFace) {
    const int edge_a = edgeAcross(on_a, closest.features.a, single.n_W);
    const int edge_b = edgeAcross(on_b, closest.features.b, single.n_W);
    if (edge_a >= 0 && edge_b >= 0) points = sharedStretch(on_a, edge_a, on_b, edge_b, single.n_W);
  }
  double least = window.manifold;
  for (const ManifoldPoint& p : points) least = std::min(least, p.gap_m);
  ContactManifold manifold;
  if (!points.empty()) reduce(points, points[0].n_W);
  for (const ManifoldPoint& p : points) {
    ManifoldPoint& kept = manifold.points[static_cast<std::size_t>(manifold.count++)];
    kept = p;
    kept.id = combineIds(p.id, reference_id);
  }
  // A reference turned away from the contact's normal, or that lost the closest point beyond its rim, does
  // not hold that point's motion; the point itself does.
  const bool holds_closest = !points.empty() && points[0].n_W.dot(single.n_W) > 1.0 - kSameCosine &&
                             least <= closest.distance_m + kSameGap * window.floor;
  if (!holds_closest)
    manifold.points[static_cast<std::size_t>(manifold.count++)] = {single.p_W, single.n_W, single.gap_m, 0};
  return manifold;
}

}  // namespace carom
