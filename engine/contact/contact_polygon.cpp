#include "engine/contact/contact_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/contact_id.h"
#include "engine/contact/polygon_clip.h"
#include "engine/foundation/stack_arena.h"

namespace carom {
namespace {

using tolerance::kLyingSine;

constexpr double kSameSine = 1e-6;    // the same for the sines of edges
constexpr double kSameArea = 1e-9;    // relative: faces this close in area are equally large
constexpr double kSameCorner = 1e-5;  // of the window's floor
constexpr double kPoseRounding = 16.0 * std::numeric_limits<double>::epsilon();  // relative to the positions

// Bytes for the corners of a clipped face: those of two faces of some hundred sides, twice.
constexpr std::size_t kClipBytes = std::size_t{32} << 10;

// The frame of one contact: its origin near the contact, so that far from the world's origin no more is lost
// than the poses have lost; its third axis the polygon's normal.
struct ContactFrame {
  Vec3 origin_W;
  Mat3 R_CW;

  ContactFrame(const Vec3& origin, const Vec3& n_W) : origin_W(origin) {
    const TangentBasis t = tangentBasis(n_W);
    R_CW << t.t1.transpose(), t.t2.transpose(), n_W.transpose();
  }
};

// A part whose far corners are within the distance k lies, too, however it leans: all of it may come down
// while the contact lasts. Where one is over the other they are no wider than the smaller of them. One that
// leans by more than half a right angle lies on its next face.
double lyingSine(const PosedParts& parts, const CollisionWindow& window) {
  const double extent_m = 2.0 * std::min(parts.a.core.radius(), parts.b.core.radius());
  if (window.manifold <= kLyingSine * extent_m) return kLyingSine;
  return std::min(std::sqrt(0.5), window.manifold / extent_m);
}

// One of the two parts in that frame.
struct Placed {
  const ConvexPolyhedron& core;
  double radius_m;
  Mat3 R_CP;
  Vec3 t_CP;

  Placed(const ConvexPart& part, const Pose& X_WP, const ContactFrame& C)
      : core(part.core),
        radius_m(part.radius_m),
        R_CP(C.R_CW * X_WP.rotation.toRotationMatrix()),
        t_CP(C.R_CW * (X_WP.position - C.origin_W)) {}

  Vec3 vertex(int v) const { return R_CP * core.vertex(v) + t_CP; }
};

// The face at the feature whose normal comes nearest to `direction` (in the part's frame), with its cosine.
// Face -1: none is within the angle of that sine. Equals go to the lower index.
struct FacingFace {
  int face = -1;
  double cosine = -1.0;
};

FacingFace faceTowards(const ConvexPolyhedron& core, Feature feature, const Vec3& direction,
                       double lying_sine) {
  const double least = std::sqrt(1.0 - lying_sine * lying_sine);
  FacingFace best;
  const auto consider = [&](int f) {
    if (f < 0) return;
    const double c = dot(core.plane(f).normal, direction);
    if (c < least || c < best.cosine - kSameCosine) return;
    if (best.face < 0 || c > best.cosine + kSameCosine || f < best.face) best.face = f;
    best.cosine = std::max(best.cosine, c);
  };
  if (feature.kind == FeatureKind::kFace) {
    consider(feature.index);
  } else if (feature.kind == FeatureKind::kEdge) {
    consider(core.edge(feature.index).left);
    consider(core.edge(feature.index).right);
  } else {
    for (const Spoke& spoke :
         core.spokes(feature.index)) {  // each face once: it is left of one edge that leaves
      const Edge& edge = core.edge(spoke.edge);
      consider(edge.tail == feature.index ? edge.left : edge.right);
    }
  }
  return best;
}

// The edge at the feature that is flattest against `normal` (in the part's frame), if it lies within the
// angle of that sine; -1 if none does.
int edgeAcross(const ConvexPolyhedron& core, Feature feature, const Vec3& normal, double lying_sine) {
  int best = -1;
  double least = lying_sine;
  const auto consider = [&](int e) {
    const double s = std::abs(dot(core.edge(e).direction, normal));
    if (s >= lying_sine || s > least + kSameSine) return;
    if (best < 0 || s < least - kSameSine || e < best) best = e;
    least = std::min(least, s);
  };
  if (feature.kind == FeatureKind::kEdge) {
    consider(feature.index);
  } else if (feature.kind == FeatureKind::kFace) {
    for (const int e : core.faceEdges(feature.index)) consider(e);
  } else {
    for (const Spoke& spoke : core.spokes(feature.index)) consider(spoke.edge);
  }
  return best;
}

double faceArea(const ConvexPolyhedron& core, int f) {
  const std::span<const int> loop = core.faceVertices(f);
  const Vec3& base = core.vertex(loop[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum += (core.vertex(loop[i]) - base).cross(core.vertex(loop[i + 1]) - base);
  return 0.5 * sum.norm();
}

Vec3 inPart(const Pose& X_WP, const Vec3& direction_W) {
  return X_WP.rotation.conjugate() * direction_W;
}

// What is clipped against what: a face of the subject, or else an edge, against a face of the other part.
struct Lying {
  bool subject_is_b = true;
  int clip_face = -1;
  int subject_face = -1;
  int subject_edge = -1;
  Vec3 n_W = Vec3::UnitZ();

  bool any() const { return subject_face >= 0 || subject_edge >= 0; }
};

struct PartAtPose {
  const ConvexPart& part;
  const Pose& X_W;
  Feature feature;
  double lying_sine = kLyingSine;  // of what lies on the other

  /// The face on which the other part lies.
  FacingFace faceUnder(const Vec3& n_W) const {
    return faceTowards(part.core, feature, inPart(X_W, n_W), kLyingSine);
  }
  /// The face, or else the edge, that lies on the other part.
  FacingFace faceAlong(const Vec3& n_W) const {
    return faceTowards(part.core, feature, inPart(X_W, n_W), lying_sine);
  }
  int edgeAcrossTo(const Vec3& n_W) const {
    return edgeAcross(part.core, feature, inPart(X_W, n_W), lying_sine);
  }
  Vec3 faceNormal(int f) const { return X_W.rotation * part.core.plane(f).normal; }
};

// What lies on face f of `reference`.
Lying lyingOn(const PartAtPose& reference, int f, const PartAtPose& incident, bool reference_is_a) {
  const Vec3 normal = reference.faceNormal(f);
  Lying lying;
  lying.subject_is_b = reference_is_a;
  lying.clip_face = f;
  lying.n_W = reference_is_a ? normal : Vec3(-normal);
  lying.subject_face = incident.faceAlong(-normal).face;
  if (lying.subject_face < 0) lying.subject_edge = incident.edgeAcrossTo(normal);
  return lying;
}

// Which of the two faces is the reference is decided by what both ways of naming the bodies share: the angle
// to the contact, who is the ground, then the area. What glides over many small tiles would otherwise go
// where its own face points, and that leans by what the solver leaves. Equals have no canonical choice
// between them; their mean is one.
Lying whatLies(const PartAtPose& a, const PartAtPose& b, const Vec3& n_W, Ground ground) {
  const FacingFace face_a = a.faceUnder(n_W);
  const FacingFace face_b = b.faceUnder(-n_W);
  if (face_a.face < 0 && face_b.face < 0) return {};
  if (face_a.cosine > face_b.cosine + kSameCosine) return lyingOn(a, face_a.face, b, true);
  if (face_b.cosine > face_a.cosine + kSameCosine) return lyingOn(b, face_b.face, a, false);
  if (ground == Ground::kA) return lyingOn(a, face_a.face, b, true);
  if (ground == Ground::kB) return lyingOn(b, face_b.face, a, false);
  const double area_a = faceArea(a.part.core, face_a.face);
  const double area_b = faceArea(b.part.core, face_b.face);
  if (area_a > area_b * (1.0 + kSameArea)) return lyingOn(a, face_a.face, b, true);
  if (area_b > area_a * (1.0 + kSameArea)) return lyingOn(b, face_b.face, a, false);
  Lying lying{true, face_a.face, face_b.face, -1, Vec3::Zero()};
  lying.n_W = (a.faceNormal(face_a.face) - b.faceNormal(face_b.face)).normalized();
  return lying;
}

std::size_t cornersOfSubject(const ConvexPolyhedron& core, const Lying& lying) {
  return lying.subject_face >= 0 ? core.faceVertices(lying.subject_face).size() : 2;
}

void loadSubject(const Placed& subject, const Lying& lying, ClipPolygon& polygon) {
  const auto add = [&](int v, int edge) {
    const Vec3 p = subject.vertex(v);
    ClipCorner& c = polygon.corners.emplace_back();
    c.p = p.head<2>();
    c.height_m = p.z();
    c.on_subject = vertexFeature(v);
    c.on_clip = faceFeature(lying.clip_face);
    c.subject_edge = edge;
  };
  polygon.corners.clear();
  if (lying.subject_face >= 0) {
    const std::span<const int> loop = subject.core.faceVertices(lying.subject_face);
    const std::span<const int> edges = subject.core.faceEdges(lying.subject_face);
    for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], edges[i]);
  } else {
    add(subject.core.edge(lying.subject_edge).tail, lying.subject_edge);
    add(subject.core.edge(lying.subject_edge).head, lying.subject_edge);
  }
}

// B's face looks against the normal: its loop is clockwise here. Turned round, each corner's way on is the
// way that led to it.
void turnRound(ArenaVector<ClipCorner>& corners) {
  std::reverse(corners.begin(), corners.end());
  const int first = corners.front().subject_edge;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) corners[i].subject_edge = corners[i + 1].subject_edge;
  corners.back().subject_edge = first;
}

// The plane of the clipping face as a height over the contact frame's third plane.
struct PlaneHeight {
  double at_origin = 0.0;
  Vec2 slope = Vec2::Zero();
  double operator()(const Vec2& p) const { return at_origin + slope.x() * p.x() + slope.y() * p.y(); }
};

PlaneHeight heightOf(const Placed& part, int f) {
  const Vec3 m = part.R_CP * part.core.plane(f).normal;
  const Vec3 p = part.vertex(part.core.faceVertices(f)[0]);
  const Vec2 slope = -m.head<2>() / m.z();
  return {p.z() - dot(slope, p.head<2>()), slope};
}

void clipBySides(const Placed& clip, int f, bool seen_from_outside, Feature subject_face, double same_m,
                 ClipPolygon& polygon) {
  for (const int e : clip.core.faceEdges(f)) {
    const Edge& edge = clip.core.edge(e);
    const Vec2 along = (clip.R_CP.topRows<2>() * edge.direction).normalized();
    const Vec2 left(-along.y(), along.x());
    ClipLine side;
    side.into = (edge.left == f) == seen_from_outside ? left : Vec2(-left);
    side.offset_m =
        dot(side.into, (clip.R_CP.topRows<2>() * clip.core.vertex(edge.tail) + clip.t_CP.head<2>()));
    clipBySide(polygon, side, clip.core, e, subject_face, same_m);
    if (polygon.corners.empty()) return;
  }
}

// Two parts seen from their contact, what of them counts as one point there, and up to which distance k they
// are in contact.
struct PlacedPair {
  PlacedPair(const PosedParts& parts, const ContactFrame& frame, const CollisionWindow& window)
      : C(frame),
        a(parts.a, parts.X_WA, frame),
        b(parts.b, parts.X_WB, frame),
        k_m(window.manifold),
        same_m(sameCorner_m(parts.X_WA, parts.X_WB, window)) {}

  const ContactFrame& C;
  Placed a, b;
  double k_m, same_m;

  double radii() const { return a.radius_m + b.radius_m; }
  Vec3 inWorld(const Vec3& p_C) const { return C.origin_W + C.R_CW.transpose() * p_C; }
};

// From the clipped subject to corners in the world, halfway between the two parts' surfaces.
void writeCorners(const PlacedPair& pair, const ClipPolygon& clipped, const Lying& lying,
                  const PlaneHeight& clip_height, ContactPolygon& polygon) {
  polygon.corners.reserve(clipped.corners.size());
  for (const ClipCorner& c : clipped.corners) {
    const double on_clip = clip_height(c.p);
    const double top_of_a = (lying.subject_is_b ? on_clip : c.height_m) + pair.a.radius_m;
    const double bottom_of_b = (lying.subject_is_b ? c.height_m : on_clip) - pair.b.radius_m;
    const Vec3 p_C(c.p.x(), c.p.y(), 0.5 * (top_of_a + bottom_of_b));
    polygon.corners.push_back(
        {pair.inWorld(p_C), bottom_of_b - top_of_a,
         lying.subject_is_b ? FeaturePair{c.on_clip, c.on_subject} : FeaturePair{c.on_subject, c.on_clip}});
  }
}

void clippedPolygon(const PlacedPair& pair, const Lying& lying, ContactPolygon& polygon) {
  const Placed& subject = lying.subject_is_b ? pair.b : pair.a;
  const Placed& clip = lying.subject_is_b ? pair.a : pair.b;
  const Feature subject_face = faceFeature(lying.subject_face);
  const std::size_t most = cornersOfSubject(subject.core, lying) +
                           clip.core.faceEdges(lying.clip_face).size() + 2;  // a cut adds one corner at most
  StackArena<kClipBytes> arena;
  ClipPolygon clipped(most, &arena);
  loadSubject(subject, lying, clipped);
  if (lying.subject_face >= 0 && lying.subject_is_b) turnRound(clipped.corners);
  clipBySides(clip, lying.clip_face, lying.subject_is_b, subject_face, pair.same_m, clipped);
  if (clipped.corners.empty()) return;
  const PlaneHeight clip_height = heightOf(clip, lying.clip_face);
  for (ClipCorner& c : clipped.corners) {
    const double apart = lying.subject_is_b ? c.height_m - clip_height(c.p) : clip_height(c.p) - c.height_m;
    c.inside_m = pair.k_m - (apart - pair.radii());
  }
  clipByHeight(clipped, subject_face, faceFeature(lying.clip_face), pair.same_m);
  writeCorners(pair, clipped, lying, clip_height, polygon);
}

// An edge as a line over the stations along the common direction: its low and high end.
struct Line {
  int low_vertex, high_vertex;
  Vec3 low_C, high_C;
  double low_m, high_m;
  Vec3 at(double t) const { return low_C + (t - low_m) / (high_m - low_m) * (high_C - low_C); }
};

Line lineOf(const Placed& part, int e, const Vec3& along) {
  const Edge& edge = part.core.edge(e);
  const Vec3 tail = part.vertex(edge.tail);
  const Vec3 head = part.vertex(edge.head);
  const double t_tail = dot(along, tail);
  const double t_head = dot(along, head);
  if (t_tail <= t_head) return {edge.tail, edge.head, tail, head, t_tail, t_head};
  return {edge.head, edge.tail, head, tail, t_head, t_tail};
}

// An end of the shared stretch: of the two lines' ends the one further in, or both if they coincide.
struct StretchEnd {
  double t_m = 0.0;
  FeaturePair features;
};

// An end of an edge, at its station along the common direction.
struct EdgeEnd {
  double t_m;
  int vertex, edge;
};

// `inwards`: the way along that direction from this end into the stretch, 1 or -1.
StretchEnd endOf(const EdgeEnd& a, const EdgeEnd& b, double inwards, double same_m) {
  const double a_beyond = inwards * (a.t_m - b.t_m);
  if (std::abs(a_beyond) <= same_m)
    return {0.5 * (a.t_m + b.t_m), {vertexFeature(a.vertex), vertexFeature(b.vertex)}};
  if (a_beyond > 0.0) return {a.t_m, {vertexFeature(a.vertex), edgeFeature(b.edge)}};
  return {b.t_m, {edgeFeature(a.edge), vertexFeature(b.vertex)}};
}

// Shortens the stretch to where the two lines are no farther apart than `reach_m`; false if nothing, or only
// the middle of two crossing edges, is left.
bool withinReach(const Line& a, const Line& b, const FeaturePair& edges, double reach_m, StretchEnd& low,
                 StretchEnd& high) {
  const Vec3 w = b.at(low.t_m) - a.at(low.t_m);
  const Vec3 dw = b.at(high.t_m) - a.at(high.t_m) - w;
  const bool low_in = w.squaredNorm() <= reach_m * reach_m;
  const bool high_in = (w + dw).squaredNorm() <= reach_m * reach_m;
  if (low_in && high_in) return true;
  if (!low_in && !high_in) return false;
  // |w + s dw| = reach: one root lies between an end within reach and one beyond.
  const double q = dw.squaredNorm();
  const double p = dot(w, dw);
  const double root = std::sqrt(std::max(0.0, p * p - q * (w.squaredNorm() - reach_m * reach_m)));
  const double s = (-p + (low_in ? root : -root)) / q;
  StretchEnd& cut = low_in ? high : low;
  cut = {low.t_m + std::clamp(s, 0.0, 1.0) * (high.t_m - low.t_m), edges};
  return true;
}

// Two edges that run alongside each other without a face to lie on (capsules, roof ridges): the ends of the
// stretch they share, as far as they are within the distance k of each other.
void sharedStretch(const PlacedPair& pair, int e_a, int e_b, ContactPolygon& polygon) {
  const Placed &a = pair.a, &b = pair.b;
  const Vec3 d_a = a.R_CP * a.core.edge(e_a).direction;
  const Vec3 d_b = b.R_CP * b.core.edge(e_b).direction;
  if (d_a.cross(d_b).norm() > kLyingSine) return;
  const Vec3 along = (dot(d_a, d_b) < 0.0 ? Vec3(d_a - d_b) : Vec3(d_a + d_b)).normalized();
  const Line line_a = lineOf(a, e_a, along);
  const Line line_b = lineOf(b, e_b, along);
  StretchEnd low =
      endOf({line_a.low_m, line_a.low_vertex, e_a}, {line_b.low_m, line_b.low_vertex, e_b}, 1.0, pair.same_m);
  StretchEnd high = endOf({line_a.high_m, line_a.high_vertex, e_a}, {line_b.high_m, line_b.high_vertex, e_b},
                          -1.0, pair.same_m);
  if (!(high.t_m - low.t_m > pair.same_m)) return;
  const FeaturePair edges{edgeFeature(e_a), edgeFeature(e_b)};
  if (!withinReach(line_a, line_b, edges, pair.k_m + pair.radii(), low, high)) return;
  for (const StretchEnd& end : {low, high}) {
    const Vec3 p_a = line_a.at(end.t_m) + a.radius_m * Vec3::UnitZ();
    const Vec3 p_b = line_b.at(end.t_m) - b.radius_m * Vec3::UnitZ();
    polygon.corners.push_back({pair.inWorld(0.5 * (p_a + p_b)), p_b.z() - p_a.z(), end.features});
  }
}

// The polygon begins with the corner whose name is lowest.
void beginWithLowestName(ArenaVector<PolygonCorner>& corners) {
  const auto lowest =
      std::min_element(corners.begin(), corners.end(), [](const PolygonCorner& x, const PolygonCorner& y) {
        return symmetricKey(x.features) < symmetricKey(y.features);
      });
  std::rotate(corners.begin(), lowest, corners.end());
}

}  // namespace

double sameCorner_m(const Pose& X_WA, const Pose& X_WB, const CollisionWindow& window) {
  return kSameCorner * window.floor +
         kPoseRounding * (X_WA.position.lpNorm<Eigen::Infinity>() + X_WB.position.lpNorm<Eigen::Infinity>());
}

void contactPolygon(const ClosestFeatures& closest, const PosedParts& parts, const CollisionWindow& window,
                    Ground ground, ContactPolygon& polygon) {
  const ContactPoint single = contactPoint(closest, parts.a, parts.X_WA, parts.b, parts.X_WB);
  const double lying_sine = lyingSine(parts, window);
  const PartAtPose at_a{parts.a, parts.X_WA, closest.features.a, lying_sine};
  const PartAtPose at_b{parts.b, parts.X_WB, closest.features.b, lying_sine};
  polygon.corners.clear();
  polygon.n_W = single.n_W;
  const Lying lying = whatLies(at_a, at_b, single.n_W, ground);
  if (lying.any()) {
    polygon.n_W = lying.n_W;
    const ContactFrame C(single.p_W, polygon.n_W);
    clippedPolygon({parts, C, window}, lying, polygon);
  } else if (lying.clip_face < 0 && parts.a.core.edgeCount() > 0 && parts.b.core.edgeCount() > 0) {
    const int e_a = at_a.edgeAcrossTo(single.n_W);
    const int e_b = at_b.edgeAcrossTo(single.n_W);
    if (e_a < 0 || e_b < 0) return;
    const ContactFrame C(single.p_W, polygon.n_W);
    sharedStretch({parts, C, window}, e_a, e_b, polygon);
  }
  if (!polygon.corners.empty()) beginWithLowestName(polygon.corners);
}

ContactPolygon contactPolygon(const ClosestFeatures& closest, const ConvexPart& a, const Pose& X_WA,
                              const ConvexPart& b, const Pose& X_WB, const CollisionWindow& window) {
  ContactPolygon polygon;
  contactPolygon(closest, {a, X_WA, b, X_WB}, window, Ground::kNone, polygon);
  return polygon;
}

}  // namespace carom
