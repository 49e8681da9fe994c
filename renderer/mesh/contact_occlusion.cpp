#include "renderer/mesh/contact_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom::renderer {
namespace {

constexpr double kReach = 1.3;  // Of the smaller half width of the near body: how far off it darkens what
                                // it touches, and the ground.
constexpr double kApartReach = 1.0;  // The same for bodies that do not touch.
constexpr double kSeen = 0.86;       // The part of it where more than a hundredth of the light is lost.
constexpr double kStrength = 0.62;
constexpr double kMinPixels = 1.5;    // Effects with a shorter reach on the image are left out;
constexpr double kPlainPixels = 4.0;  // those of bodies that do not touch fade away between these two.
constexpr double kTouchingGap = 0.1;  // Of the same half width.
constexpr double kUpward = 0.999;     // z of a normal that counts as level.

struct Square {
  Vec3 center;
  TangentBasis basis;
  double half_1 = 0.0;
  double half_2 = 0.0;
};

// How far from its surface an occluder darkens, how far so that it is seen, how far beside itself in the
// plane of a face, and how much.
struct Reach {
  double whole = 0.0;
  double seen = 0.0;
  double across = 0.0;
  double strength = 0.0;
};

// A face turned to the eye: its plane in E.
struct Facing {
  int face = 0;
  Vec3 normal;
  double offset = 0.0;
};

// A part, placed in E: its rounded box, which darkens others, and its faces, which others darken.
struct PlacedPart {
  Mat3 R_RE;
  Vec3 center;
  const RoundedBox* box = nullptr;
  std::vector<Facing> faces;

  double extentAlong(const Vec3& axis_E) const {
    return (R_RE * axis_E).cwiseAbs().dot(box->half) + box->radius;
  }
};

struct PlacedBody {
  const OcclusionBody* body = nullptr;
  Mat3 R_EB;
  double outreach = 0.0;  // How far from its surface it can matter to another or another to it.
  std::vector<PlacedPart> parts;

  double low() const {
    return body->endless_ground ? -1e30 : body->X_EB.position.x() - body->radius_m - outreach;
  }
  double high() const {
    return body->endless_ground ? 1e30 : body->X_EB.position.x() + body->radius_m + outreach;
  }
};

std::vector<Facing> facesToTheEye(const ConvexPolyhedron& core, const Mat3& R_EB, const Vec3& position_E) {
  std::vector<Facing> faces;
  for (int f = 0; f < core.faceCount(); ++f) {
    const Vec3 n = R_EB * core.plane(f).normal;
    const double offset = core.plane(f).offset + n.dot(position_E);
    if (offset < 0.0) faces.push_back({f, n, offset});
  }
  return faces;
}

PlacedBody place(const OcclusionBody& body) {
  PlacedBody placed;
  placed.body = &body;
  placed.R_EB = body.X_EB.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < body.boxes.size(); ++i) {
    const RoundedBox& box = body.boxes[i];
    const Pose X_ER = body.X_EB * box.X_BR;
    placed.parts.push_back({X_ER.rotation.toRotationMatrix().transpose(), X_ER.position, &box,
                            box.part < 0
                                ? std::vector<Facing>{}
                                : facesToTheEye(body.solid->parts()[static_cast<std::size_t>(box.part)].core,
                                                placed.R_EB, body.X_EB.position)});
    placed.outreach = std::max(placed.outreach, kReach * box.size());
  }
  return placed;
}

bool nearEachOther(const PlacedBody& a, const PlacedBody& b) {
  if (a.body->endless_ground || b.body->endless_ground) return true;
  const double limit = a.body->radius_m + b.body->radius_m + std::max(a.outreach, b.outreach);
  return (a.body->X_EB.position - b.body->X_EB.position).squaredNorm() < limit * limit;
}

// What of the polygon lies on the positive side of the plane through `p` with normal `n`.
void clip(const std::vector<Vec3>& polygon, const Vec3& p, const Vec3& n, std::vector<Vec3>& kept) {
  kept.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double da = n.dot(a - p), db = n.dot(b - p);
    if (da >= 0.0) kept.push_back(a);
    if ((da < 0.0) != (db < 0.0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
}

void setCorners(const Square& s, std::vector<Vec3>& polygon) {
  const Vec3 a = s.half_1 * s.basis.t1, b = s.half_2 * s.basis.t2;
  polygon.assign({s.center - a - b, s.center + a - b, s.center + a + b, s.center - a + b});
}

class Collector {
 public:
  explicit Collector(double focal_px) : focal_px_(focal_px) {}

  void darken(const PlacedBody& receiver, const PlacedBody& near_body) {
    if (near_body.body->endless_ground) return;
    for (const PlacedPart& occluder : near_body.parts)
      for (std::size_t k = 0; k < receiver.parts.size(); ++k) darkenPart(receiver, k, occluder);
  }

  std::vector<OcclusionTriangle> take() { return std::move(triangles_); }

 private:
  void darkenPart(const PlacedBody& receiver, std::size_t part, const PlacedPart& occluder) {
    const double size = std::min(occluder.box->size(), receiver.parts[part].box->span());
    const double distance = std::min(occluder.center.norm(), receiver.body->X_EB.position.norm());
    const double reach_px = kReach * size * focal_px_ / distance;
    if (!(reach_px >= kMinPixels)) return;
    const double plainness = std::clamp((reach_px - kMinPixels) / (kPlainPixels - kMinPixels), 0.0, 1.0);
    for (const Facing& facing : receiver.parts[part].faces) {
      const double height = facing.normal.dot(occluder.center) - facing.offset;
      if (height <= 0.0) continue;
      const double gap = std::max(0.0, height - occluder.extentAlong(facing.normal));
      const bool plain = receiver.body->endless_ground || gap < kTouchingGap * size;
      const double strength = kStrength * (plain ? 1.0 : plainness);
      const double reach = (plain ? kReach : kApartReach) * size, seen = kSeen * reach;
      if (gap >= seen || strength == 0.0) continue;
      const Reach reaches{reach, seen, std::sqrt(seen * seen - gap * gap), strength};
      const auto index = static_cast<std::size_t>(receiver.parts[part].box->part);
      darkenFace(receiver, receiver.body->solid->parts()[index].core, facing, height, reaches, occluder);
    }
  }

  void darkenFace(const PlacedBody& receiver, const ConvexPolyhedron& core, const Facing& facing,
                  double height, const Reach& reach, const PlacedPart& occluder) {
    const Vec3& n = facing.normal;
    const TangentBasis basis = tangentBasis(n);
    setCorners({occluder.center - height * n, basis, occluder.extentAlong(basis.t1) + reach.across,
                occluder.extentAlong(basis.t2) + reach.across},
               polygon_);
    const std::span<const int> edges = core.faceEdges(facing.face), vertices = core.faceVertices(facing.face);
    const bool unbounded = receiver.body->endless_ground && n.z() > kUpward;
    for (std::size_t i = 0; i < edges.size() && !polygon_.empty() && !unbounded; ++i) {
      clip(polygon_, receiver.R_EB * core.vertex(vertices[i]) + receiver.body->X_EB.position,
           receiver.R_EB * core.intoFace(edges[i], facing.face), kept_);
      polygon_.swap(kept_);
    }
    clipToReach(occluder, reach.seen);
    for (std::size_t i = 2; i < polygon_.size(); ++i)
      triangles_.push_back({vertex(polygon_[0], n, reach, occluder),
                            vertex(polygon_[i - 1], n, reach, occluder),
                            vertex(polygon_[i], n, reach, occluder)});
  }

  // Leaves what lies in the occluder's box, widened on all sides.
  void clipToReach(const PlacedPart& occluder, double reach_m) {
    for (int axis = 0; axis < 3; ++axis) {
      const double side = occluder.box->half[axis] + occluder.box->radius + reach_m;
      for (const double sign : {-1.0, 1.0}) {
        if (polygon_.empty()) return;
        const Vec3 out_E = sign * occluder.R_RE.row(axis).transpose();
        clip(polygon_, occluder.center + side * out_E, -out_E, kept_);
        polygon_.swap(kept_);
      }
    }
  }

  static OcclusionVertex vertex(const Vec3& p_E, const Vec3& n_E, const Reach& reach,
                                const PlacedPart& occluder) {
    const Eigen::Vector3f p = p_E.cast<float>(), h = occluder.box->half.cast<float>();
    const Eigen::Vector3f q = (occluder.R_RE * (p_E - occluder.center)).cast<float>();
    const Eigen::Vector3f n = (occluder.R_RE * n_E).cast<float>();
    return {{p.x(), p.y(), p.z()},
            {q.x(), q.y(), q.z()},
            {n.x(), n.y(), n.z()},
            {h.x(), h.y(), h.z()},
            static_cast<float>(occluder.box->radius),
            static_cast<float>(reach.whole),
            static_cast<float>(reach.strength)};
  }

  double focal_px_;
  std::vector<Vec3> polygon_, kept_;
  std::vector<OcclusionTriangle> triangles_;
};

}  // namespace

std::vector<OcclusionTriangle> contactOcclusion(std::span<const OcclusionBody> bodies, double focal_px) {
  std::vector<PlacedBody> placed;
  for (const OcclusionBody& body : bodies) placed.push_back(place(body));
  std::vector<std::size_t> order(placed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(placed[a].low(), a) < std::pair(placed[b].low(), b);
  });

  // Sweep along x: a body meets those that begin before it ends.
  Collector collector(focal_px);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && placed[order[k]].low() <= placed[order[i]].high(); ++k) {
      const PlacedBody &a = placed[order[i]], &b = placed[order[k]];
      if (!nearEachOther(a, b)) continue;
      collector.darken(a, b);
      collector.darken(b, a);
    }
  return collector.take();
}

}  // namespace carom::renderer
