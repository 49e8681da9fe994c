#include "renderer/contact_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom::renderer {
namespace {

constexpr double kReach = 1.3;      // Of the smaller half width of the near body.
constexpr double kMinPixels = 1.5;  // Effects with a shorter reach on the image are left out.
constexpr double kUpward = 0.999;   // z of a normal that counts as level.

struct Square {
  Vec3 center;
  TangentBasis basis;
  double half_1 = 0.0;
  double half_2 = 0.0;
};

// The near part, placed in E.
struct Occluder {
  Pose X_ER;
  const RoundedBox* box = nullptr;
  double extentAlong(const Vec3& axis_E) const {
    return (X_ER.rotation.conjugate() * axis_E).cwiseAbs().dot(box->half) + box->radius;
  }
};

// What of the polygon lies on the positive side of the plane through `p` with normal `n`.
std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Vec3& p, const Vec3& n) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = n.dot(a - p), db = n.dot(b - p);
    if (da >= 0.0) kept.push_back(a);
    if ((da < 0.0) != (db < 0.0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

std::vector<Vec3> corners(const Square& s) {
  const Vec3 a = s.half_1 * s.basis.t1, b = s.half_2 * s.basis.t2;
  return {s.center - a - b, s.center + a - b, s.center + a + b, s.center - a + b};
}

class Collector {
 public:
  explicit Collector(double focal_px) : focal_px_(focal_px) {}

  void darken(const OcclusionBody& receiver, const OcclusionBody& near_body) {
    if (near_body.endless_ground) return;
    for (std::size_t i = 0; i < near_body.boxes.size(); ++i) {
      const Occluder occluder{near_body.X_EB * near_body.boxes[i].X_BR, &near_body.boxes[i]};
      for (std::size_t k = 0; k < receiver.boxes.size(); ++k) darkenPart(receiver, k, occluder);
    }
  }

  std::vector<OcclusionVertex> take() { return std::move(triangles_); }

 private:
  void darkenPart(const OcclusionBody& receiver, std::size_t part, const Occluder& occluder) {
    const double reach = kReach * std::min(occluder.box->size(), receiver.boxes[part].span());
    const double distance = std::min(occluder.X_ER.position.norm(), receiver.X_EB.position.norm());
    if (reach * focal_px_ < kMinPixels * distance) return;
    const ConvexPolyhedron& core = receiver.solid->parts()[part].core;
    for (int f = 0; f < core.faceCount(); ++f) {
      const Vec3 n = receiver.X_EB.rotation * core.plane(f).normal;
      const double offset = core.plane(f).offset + n.dot(receiver.X_EB.position);
      const double height = n.dot(occluder.X_ER.position) - offset;
      if (offset >= 0.0 || height <= 0.0 || height - occluder.extentAlong(n) >= reach) continue;
      darkenFace(receiver, core, f, n, height, reach, occluder);
    }
  }

  void darkenFace(const OcclusionBody& receiver, const ConvexPolyhedron& core, int f, const Vec3& n,
                  double height, double reach, const Occluder& occluder) {
    const TangentBasis basis = tangentBasis(n);
    const Square square{occluder.X_ER.position - height * n, basis, occluder.extentAlong(basis.t1) + reach,
                        occluder.extentAlong(basis.t2) + reach};
    std::vector<Vec3> polygon = corners(square);
    const std::span<const int> edges = core.faceEdges(f), vertices = core.faceVertices(f);
    const bool unbounded = receiver.endless_ground && n.z() > kUpward;
    for (std::size_t i = 0; i < edges.size() && !polygon.empty() && !unbounded; ++i)
      polygon = clip(polygon, receiver.X_EB * core.vertex(vertices[i]),
                     receiver.X_EB.rotation * core.intoFace(edges[i], f));
    for (std::size_t i = 2; i < polygon.size(); ++i)
      for (const Vec3& p : {polygon[0], polygon[i - 1], polygon[i]}) append(p, n, reach, occluder);
  }

  void append(const Vec3& p_E, const Vec3& n_E, double reach, const Occluder& occluder) {
    const Eigen::Vector3f p = p_E.cast<float>(), h = occluder.box->half.cast<float>();
    const Eigen::Vector3f q = (occluder.X_ER.inverse() * p_E).cast<float>();
    const Eigen::Vector3f n = (occluder.X_ER.rotation.conjugate() * n_E).cast<float>();
    triangles_.push_back({{p.x(), p.y(), p.z()},
                          {q.x(), q.y(), q.z()},
                          {n.x(), n.y(), n.z()},
                          {h.x(), h.y(), h.z()},
                          static_cast<float>(occluder.box->radius),
                          static_cast<float>(reach)});
  }

  double focal_px_;
  std::vector<OcclusionVertex> triangles_;
};

// How far from its surface a body can matter to another or another to it.
double outreach(const OcclusionBody& body) {
  double size = 0.0;
  for (const RoundedBox& box : body.boxes) size = std::max(size, box.size());
  return kReach * size;
}

bool nearEachOther(const OcclusionBody& a, const OcclusionBody& b) {
  if (a.endless_ground || b.endless_ground) return true;
  const double limit = a.radius_m + b.radius_m + std::max(outreach(a), outreach(b));
  return (a.X_EB.position - b.X_EB.position).squaredNorm() < limit * limit;
}

}  // namespace

std::vector<OcclusionVertex> contactOcclusion(std::span<const OcclusionBody> bodies, double focal_px) {
  const auto low = [&](std::size_t i) {
    return bodies[i].endless_ground ? -1e30
                                    : bodies[i].X_EB.position.x() - bodies[i].radius_m - outreach(bodies[i]);
  };
  const auto high = [&](std::size_t i) {
    return bodies[i].endless_ground ? 1e30
                                    : bodies[i].X_EB.position.x() + bodies[i].radius_m + outreach(bodies[i]);
  };
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(low(a), a) < std::pair(low(b), b); });

  // Sweep along x: a body meets those that begin before it ends.
  Collector collector(focal_px);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && low(order[k]) <= high(order[i]); ++k) {
      const OcclusionBody &a = bodies[order[i]], &b = bodies[order[k]];
      if (!nearEachOther(a, b)) continue;
      collector.darken(a, b);
      collector.darken(b, a);
    }
  return collector.take();
}

}  // namespace carom::renderer
