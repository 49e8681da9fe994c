#include "engine/environment/rounded_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

constexpr double kLongestPiece =
    std::numbers::pi / 3.0;  // rad: of an arc that one application of Gauss's rule takes

// Nodes in (0, 1) and weights of Gauss's rule with eight points.
constexpr std::array<std::array<double, 2>, 8> kGauss{{{0.019855071751231884, 0.05061426814518813},
                                                       {0.10166676129318664, 0.11119051722668724},
                                                       {0.2372337950418355, 0.15685332293894363},
                                                       {0.4082826787521751, 0.18134189168918100},
                                                       {0.5917173212478249, 0.18134189168918100},
                                                       {0.7627662049581645, 0.15685332293894363},
                                                       {0.8983332387068134, 0.11119051722668724},
                                                       {0.9801449282487681, 0.05061426814518813}}};

// The rounding along an edge: points a + s u + r e(t), 0 <= s <= length, e(t) = m cos t + c sin t for |t| <=
// half. Positions are relative to a point on the plane, so that n . x is the height over it.
struct CylinderPiece {
  Vec3 a, u, m, c;
  double length = 0.0;
  double half = 0.0;
};

CylinderPiece cylinderOf(const ConvexPolyhedron& core, const Edge& edge, const Vec3& apex) {
  CylinderPiece piece{core.vertex(edge.tail) - apex,
                      edge.direction,
                      Vec3::Zero(),
                      Vec3::Zero(),
                      edge.length_m,
                      std::numbers::pi};
  if (edge.left < 0) {
    const TangentBasis basis = tangentBasis(edge.direction);
    piece.m = basis.t1;
    piece.c = basis.t2;
    return piece;
  }
  const Vec3& left = core.plane(edge.left).normal;
  const Vec3& right = core.plane(edge.right).normal;
  piece.m = (left + right).normalized();
  piece.c = edge.direction.cross(piece.m).normalized();
  piece.half = angleOf((left - right).norm(), (left + right).norm());
  return piece;
}

// The angles between which the lower end of the line along the edge stays on one side of the plane, and the
// upper end too: ascending, from one end of the arc to the other.
using Angles = std::array<double, 6>;

Angles cuttingAngles(const CylinderPiece& piece, double r, const Vec3& n) {
  Angles angles;
  angles.fill(piece.half);
  angles[0] = -piece.half;
  std::size_t count = 1;
  const double along_m = dot(n, piece.m), along_c = dot(n, piece.c);
  const double reach = r * std::sqrt(along_m * along_m + along_c * along_c);
  const double middle = angleOf(along_c, along_m);
  const double low = dot(n, piece.a), high = dot(n, piece.a + piece.length * piece.u);
  for (double height : {low, high}) {
    if (!(std::abs(height) < reach)) continue;
    const double cosine = -height / reach;
    const double off = angleOf(std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
    for (double t : {middle - off, middle + off}) {
      t -= 2.0 * std::numbers::pi * std::nearbyint(t / (2.0 * std::numbers::pi));
      if (std::abs(t) < piece.half) angles[count++] = t;
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

// What of the line at angle t lies below the plane: from, to.
struct Stretch {
  double from = 0.0, to = 0.0;
};
Stretch stretchBelow(const CylinderPiece& piece, const Vec3& n, double height) {
  const double rise = dot(n, piece.u);
  if (height <= 0.0 && height + piece.length * rise <= 0.0) return {0.0, piece.length};
  if (height >= 0.0 && height + piece.length * rise >= 0.0) return {};
  const double crossing = std::clamp(-height / rise, 0.0, piece.length);
  return rise > 0.0 ? Stretch{0.0, crossing} : Stretch{crossing, piece.length};
}

void addCylinder(VolumeMoments& sum, const CylinderPiece& piece, double r, const Vec3& n) {
  const Angles angles = cuttingAngles(piece, r, n);
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double width = angles[i + 1] - angles[i];
    const int parts = static_cast<int>(std::ceil(width / kLongestPiece));
    for (int k = 0; k < parts; ++k) {
      for (const auto& [node, weight] : kGauss) {
        const SineCosine at = sineCosine(angles[i] + width * (k + node) / parts);
        const Vec3 e = at.cosine * piece.m + at.sine * piece.c;
        const Stretch wet = stretchBelow(piece, n, dot(n, piece.a) + r * dot(n, e));
        const double length = wet.to - wet.from;
        if (!(length > 0.0)) continue;
        const double share = weight * width / parts * r * (dot(piece.a, e) + r);  // (x . e) r dt
        sum.volume_m3 += share * length / 3.0;
        sum.first_m4 +=
            share / 4.0 *
            (length * (piece.a + r * e) + 0.5 * (wet.to - wet.from) * (wet.to + wet.from) * piece.u);
      }
    }
  }
}

// The offset of a face, clipped.
void addFace(VolumeMoments& sum, const ConvexPart& part, int f, const Plane& plane, const Vec3& apex,
             CutScratch& scratch) {
  const Vec3& normal = part.core.plane(f).normal;
  scratch.polygon.clear();
  for (int v : part.core.faceVertices(f))
    scratch.polygon.push_back(part.core.vertex(v) + part.radius_m * normal - apex);
  const double height = dot(normal, scratch.polygon[0]);
  clipPolygon(scratch.polygon, {plane.normal, 0.0}, scratch.next);
  const PolygonArea piece = areaOf(scratch.next, normal);
  sum.volume_m3 += height * piece.area_m2 / 3.0;
  sum.first_m4 += height * piece.area_m2 / 4.0 * piece.centroid;
}

// Points p + r w of the sphere at a vertex, w over the outward directions there that lie below the plane.
void addSphere(VolumeMoments& sum, const Vec3& p, double r, const SphereIntegrals& w) {
  const double heights = dot(p, w.first) + r * w.area;  // the integral of x . w
  sum.volume_m3 += r * r / 3.0 * heights;
  sum.first_m4 += r * r / 4.0 * (heights * p + r * (w.second * p + r * w.first));
}

void addVertex(VolumeMoments& sum, const ConvexPart& part, int v, const Plane& plane, const Vec3& apex,
               SpherePiece& piece) {
  const ConvexPolyhedron& core = part.core;
  piece.clear();
  for (const Spoke& spoke : core.spokes(v)) {
    const Edge& edge = core.edge(spoke.edge);
    if (edge.left < 0)
      piece.addHemisphere(spoke.direction);
    else
      piece.addArc(spoke.direction, core.plane(edge.left).normal, core.plane(edge.right).normal);
  }
  const Vec3 p = core.vertex(v) - apex;
  addSphere(sum, p, part.radius_m, piece.below(plane.normal, -dot(plane.normal, p) / part.radius_m));
}

}  // namespace

VolumeMoments cutBall(const Vec3& center, double radius_m, const Plane& plane) {
  const double r = radius_m;
  const double depth = std::clamp(r - plane.signedDistance(center), 0.0, 2.0 * r);
  VolumeMoments cap;
  cap.volume_m3 = std::numbers::pi * depth * depth * (r - depth / 3.0);
  // Below the centre by the integral of pi t (r^2 - t^2) dt from r - depth to r.
  const double below = 0.25 * std::numbers::pi * depth * depth * (2.0 * r - depth) * (2.0 * r - depth);
  cap.first_m4 = cap.volume_m3 * center - below * plane.normal;
  return cap;
}

VolumeMoments cutRounded(const ConvexPart& part, const Plane& plane, RoundedScratch& scratch) {
  const ConvexPolyhedron& core = part.core;
  if (core.vertexCount() == 1) return cutBall(core.vertex(0), part.radius_m, plane);
  const Vec3 apex = core.center() - plane.signedDistance(core.center()) * plane.normal;
  VolumeMoments sum;
  for (int f = 0; f < core.faceCount(); ++f) addFace(sum, part, f, plane, apex, scratch.cut);
  for (int e = 0; e < core.edgeCount(); ++e)
    addCylinder(sum, cylinderOf(core, core.edge(e), apex), part.radius_m, plane.normal);
  for (int v = 0; v < core.vertexCount(); ++v) addVertex(sum, part, v, plane, apex, scratch.piece);
  sum.first_m4 += sum.volume_m3 * apex;
  return sum;
}

}  // namespace carom
