#include "renderer/mesh/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "renderer/mesh/curved_part_mesh.h"

namespace carom::renderer {
namespace {

// Texels around a caster within which a look-up may meet it: the tent of the filter reaches two, the lift
// above a grazed surface two more.
constexpr double kLookUpReach = 5.0;
// Of a texel: what sticks out less over a face's plane darkens nothing, because the face is looked up at
// least so far above itself.
constexpr double kUnseenHeight = 0.4;
constexpr int kMostVertices = 64;  // Bodies with more are taken for their boxes.

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double x) { low = std::min(low, x), high = std::max(high, x); }
};

// Bounds seen from the sun: across the light twice, and towards it.
using LightBounds = std::array<Interval, 3>;

struct Axes {
  Vec3 axis[3];
};

// A body placed in E.
struct Placed {
  const ShadedBody* body = nullptr;
  Mat3 R_EB, R_EO;  // Of the body and of its box.
  LightBounds bounds;
  FaceMask open = kAllFaces;  // Faces that nothing found so far can darken.

  bool mayDarken(const LightBounds& other, double reach_m) const {
    const auto near = [&](std::size_t i) {
      return bounds[i].low - reach_m <= other[i].high && other[i].low <= bounds[i].high + reach_m;
    };
    return near(0) && near(1) && bounds[2].high > other[2].low;
  }

  // How far the body reaches along `n`.
  double extentAlong(const Vec3& n) const {
    const ShadowCaster& box = body->bounds;
    return n.dot(box.X_EB.position) + (R_EO.transpose() * n).cwiseAbs().dot(box.half);
  }
  double exactExtentAlong(const Vec3& n) const {
    const std::vector<ConvexPart>& parts = body->solid->parts();
    int vertices = 0;
    for (const ConvexPart& part : parts) vertices += part.core.vertexCount();
    if (vertices > kMostVertices) return extentAlong(n);
    const Vec3 n_B = R_EB.transpose() * n;
    double most = -std::numeric_limits<double>::infinity();
    for (const ConvexPart& part : parts)
      for (const Vec3& v : part.core.vertices()) most = std::max(most, n_B.dot(v) + part.radius_m);
    return most + n.dot(body->X_EB.position);
  }
};

Placed place(const ShadedBody& body, const Axes& light) {
  Placed placed;
  placed.body = &body;
  placed.R_EB = body.X_EB.rotation.toRotationMatrix();
  placed.R_EO = body.bounds.X_EB.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < 3; ++i) {
    placed.bounds[i].include(placed.extentAlong(light.axis[i]));
    placed.bounds[i].include(-placed.extentAlong(-light.axis[i]));
  }
  return placed;
}

LightBounds faceBounds(const Placed& placed, int face, const Axes& light) {
  const ConvexPolyhedron& core = placed.body->solid->parts().front().core;
  LightBounds bounds;
  for (const int v : core.faceVertices(face)) {
    const Vec3 p = placed.R_EB * core.vertex(v) + placed.body->X_EB.position;
    for (std::size_t i = 0; i < 3; ++i) bounds[i].include(light.axis[i].dot(p));
  }
  return bounds;
}

// Takes from `receiver` the open faces that `caster` may darken.
void darken(Placed& receiver, const Placed& caster, const Axes& light, double texel_m) {
  const double reach_m = kLookUpReach * texel_m;
  if (receiver.open == 0 || !caster.mayDarken(receiver.bounds, reach_m)) return;
  if (!hasLitFaces(*receiver.body->solid)) {
    receiver.open = 0;
    return;
  }
  const ConvexPolyhedron& core = receiver.body->solid->parts().front().core;
  for (int f = 0; f < core.faceCount(); ++f) {
    const FaceMask bit = FaceMask{1} << f;
    const Vec3 n = receiver.R_EB * core.plane(f).normal;
    if ((receiver.open & bit) == 0 || n.dot(light.axis[2]) <= 0.0) continue;
    const double height =
        core.plane(f).offset + n.dot(receiver.body->X_EB.position) + kUnseenHeight * texel_m;
    if (caster.extentAlong(n) <= height || caster.exactExtentAlong(n) <= height) continue;
    if (caster.mayDarken(faceBounds(receiver, f, light), reach_m)) receiver.open &= ~bit;
  }
  receiver.open &= ~(FaceMask{1} << kNoFace);
}

// How wide a face is on an image across its own direction, at its narrowest.
double narrowestPixels(const Placed& placed, int face, double focal_px) {
  const ConvexPolyhedron& core = placed.body->solid->parts().front().core;
  const std::span<const int> vertices = core.faceVertices(face);
  Vec3 middle = Vec3::Zero();
  std::vector<Vec3> seen;
  for (const int v : vertices) {
    seen.push_back(placed.R_EB * core.vertex(v) + placed.body->X_EB.position);
    middle += seen.back();
  }
  middle.normalize();
  for (Vec3& p : seen) {
    const double depth = p.dot(middle);
    if (!(depth > 0.0)) return focal_px;  // Beside the eye.
    p *= focal_px / depth;
  }
  double narrowest = focal_px;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3 across = middle.cross(seen[(i + 1) % seen.size()] - seen[i]);
    double width = 0.0;
    for (const Vec3& p : seen) width = std::max(width, std::abs(across.dot(p - seen[i])));
    narrowest = std::min(narrowest, width / std::max(across.norm(), 1e-30));
  }
  return narrowest;
}

// The faces whose plane has the eye before it, but for slivers.
FaceMask facingTheEye(const Placed& placed, double focal_px) {
  const ConvexPolyhedron& core = placed.body->solid->parts().front().core;
  const Vec3 eye_B = placed.R_EB.transpose() * -placed.body->X_EB.position;
  FaceMask facing = 0;
  for (int f = 0; f < core.faceCount(); ++f)
    if (core.plane(f).signedDistance(eye_B) > 0.0 &&
        (focal_px == 0.0 || narrowestPixels(placed, f, focal_px) >= kSliver_px))
      facing |= FaceMask{1} << f;
  return facing;
}

// An edge catches the sun's light from either of its faces: one turned away is as sunlit as its neighbours.
FaceLight lightOn(const Placed& placed, const Vec3& to_light, double focal_px) {
  const Solid& solid = *placed.body->solid;
  if (!hasLitFaces(solid)) {
    // Several parts darken each other, and a surface itself.
    const bool sunlit = placed.open == kAllFaces && solid.parts().size() == 1 && !solid.hasSurface();
    return sunlit ? FaceLight{kAllFaces, 0, 0} : FaceLight{0, 0, kAllFaces};
  }
  const FaceMask facing = facingTheEye(placed, focal_px);
  if (placed.open == kAllFaces) return {facing, 0, 0};
  const ConvexPolyhedron& core = solid.parts().front().core;
  const Vec3 to_light_B = placed.R_EB.transpose() * to_light;
  FaceMask turned = 0;
  for (int f = 0; f < core.faceCount(); ++f)
    if (core.plane(f).normal.dot(to_light_B) <= 0.0) turned |= FaceMask{1} << f;
  FaceMask dark = 0;
  for (int f = 0; f < core.faceCount(); ++f) {
    if ((turned >> f & 1) == 0) continue;
    FaceMask around = 0;
    for (const int e : core.faceEdges(f)) around |= FaceMask{1} << core.faceAcross(e, f);
    if ((around & ~turned & ~placed.open) != 0) dark |= FaceMask{1} << f;
  }
  return {facing & (placed.open | turned) & ~dark, facing & dark, facing & ~placed.open & ~turned};
}

}  // namespace

bool hasLitFaces(const Solid& solid) {
  if (solid.parts().size() != 1 || solid.hasSurface()) return false;
  const ConvexPart& part = solid.parts().front();
  return part.radius_m == 0.0 && part.core.faceCount() > 0 && part.core.faceCount() <= kNoFace &&
         !isCurved(part.core);
}

std::vector<FaceLight> faceLights(const ShadowView& view, const Vec3& to_light,
                                  std::span<const ShadedBody> bodies, double focal_px) {
  const TangentBasis basis = tangentBasis(to_light);
  const Axes light{{basis.t1, basis.t2, to_light}};
  std::vector<Placed> placed;
  placed.reserve(bodies.size());
  for (const ShadedBody& body : bodies) placed.push_back(place(body, light));
  std::vector<std::size_t> order(placed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(placed[a].bounds[0].low, a) < std::pair(placed[b].bounds[0].low, b);
  });

  // Sweep across the light: a body meets those that begin before it ends.
  const double reach_m = kLookUpReach * view.texel_m;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      Placed &a = placed[order[i]], &b = placed[order[k]];
      if (view.texel_m == 0.0 || b.bounds[0].low > a.bounds[0].high + reach_m) break;
      darken(a, b, light, view.texel_m);
      darken(b, a, light, view.texel_m);
    }

  std::vector<FaceLight> lights;
  for (const Placed& body : placed) lights.push_back(lightOn(body, to_light, focal_px));
  return lights;
}

}  // namespace carom::renderer
