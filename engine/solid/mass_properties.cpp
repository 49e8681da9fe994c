#include "engine/solid/mass_properties.h"

#include <numbers>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

// Inertia of mass m at offset d from the axis point (parallel-axis theorem).
Mat3 pointInertia(double mass, const Vec3& d) {
  return mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

/// a b^T made symmetric.
Mat3 symmetric(const Vec3& a, const Vec3& b) {
  const Mat3 ab = a * b.transpose();
  return 0.5 * (ab + ab.transpose());
}

/// Integrals of 1, p and p p^T over a region.
struct Moments {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  /// Adds a region whose moments are taken about the point `at`.
  void add(const Moments& region, const Vec3& at) {
    volume += region.volume;
    first += region.volume * at + region.first;
    second += region.volume * at * at.transpose() + 2.0 * symmetric(at, region.first) + region.second;
  }
};

// Signed tetrahedra between the origin and a fan of each face: for a tetrahedron with one corner at the
// origin and the others at a, b, c (det = a . b x c), volume = det/6, first moment = det/24 (a+b+c), and the
// second moment is det/120 (sum v v^T + s s^T), s = a+b+c (the divergence theorem on monomials of degree
// <= 2).
Moments coreMoments(const ConvexPolyhedron& core, const Vec3& origin) {
  Moments sum;
  for (int f = 0; f < core.faceCount(); ++f) {
    const std::span<const int> loop = core.faceVertices(f);
    const Vec3 a = core.vertex(loop[0]) - origin;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec3 b = core.vertex(loop[i]) - origin;
      const Vec3 c = core.vertex(loop[i + 1]) - origin;
      const double det = dot(a, b.cross(c));
      const Vec3 s = a + b + c;
      sum.volume += det / 6.0;
      sum.first += det / 24.0 * s;
      sum.second +=
          det / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  return sum;
}

// A slab {q + t n: q in the face, 0 <= t <= r}, about the face's first corner. With the face's area A and the
// integrals F of q and S of q q^T over it (a fan of triangles: area/3 (b+c), area/12 (b b^T + c c^T + s s^T),
// s = b+c): volume r A, first moment r F + r^2/2 A n, second r S + r^2/2 (F n^T + n F^T) + r^3/3 A n n^T.
Moments slabMoments(const ConvexPolyhedron& core, int f, double r) {
  const std::span<const int> loop = core.faceVertices(f);
  const Vec3& base = core.vertex(loop[0]);
  const Vec3& n = core.plane(f).normal;
  double area = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Vec3 b = core.vertex(loop[i]) - base;
    const Vec3 c = core.vertex(loop[i + 1]) - base;
    const Vec3 s = b + c;
    const double triangle = 0.5 * dot(n, b.cross(c));
    area += triangle;
    first += triangle / 3.0 * s;
    second += triangle / 12.0 * (b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  Moments slab;
  slab.volume = r * area;
  slab.first = r * first + 0.5 * r * r * area * n;
  slab.second = r * second + r * r * symmetric(first, n) + r * r * r / 3.0 * area * n * n.transpose();
  return slab;
}

/// The angle between two unit vectors, in [0, pi], to rounding everywhere (Kahan).
double angleBetween(const Vec3& a, const Vec3& b) {
  return rotationOf(Quat((a + b).norm(), (a - b).norm(), 0.0, 0.0).normalized()).x();
}

/// The outward directions at an edge: the arc from one face's normal to the other's, or the whole circle
/// around a segment.
struct Arc {
  double angle = 0.0;
  Vec3 first = Vec3::Zero();   ///< Integral of the direction e along the arc.
  Mat3 second = Mat3::Zero();  ///< Integral of e e^T.
};

// With b the arc's middle, h its half angle and c = u x b across, e = b cos t + c sin t, -h <= t <= h:
// the integral of e is 2 sin h b, that of e e^T is (h + sin h cos h) b b^T + (h - sin h cos h) c c^T.
Arc arcOf(const ConvexPolyhedron& core, const Edge& edge) {
  const Vec3& u = edge.direction;
  if (edge.left < 0)
    return {2.0 * std::numbers::pi, Vec3::Zero(), std::numbers::pi * (Mat3::Identity() - u * u.transpose())};
  const Vec3& left = core.plane(edge.left).normal;
  const Vec3& right = core.plane(edge.right).normal;
  const Vec3 middle = (left + right).normalized();
  const Vec3 across = u.cross(middle);
  const double sine = 0.5 * (left - right).norm(), cosine = 0.5 * (left + right).norm();
  const double half = 0.5 * angleBetween(left, right);
  return {2.0 * half, 2.0 * sine * middle,
          (half + sine * cosine) * middle * middle.transpose() +
              (half - sine * cosine) * across * across.transpose()};
}

// A wedge of a cylinder: points of the edge plus s e, e on the arc, 0 <= s <= r; about the edge's middle.
Moments wedgeMoments(const Edge& edge, const Arc& arc, double r) {
  const double length = edge.length_m;
  const Vec3& u = edge.direction;
  Moments wedge;
  wedge.volume = 0.5 * r * r * arc.angle * length;
  wedge.first = r * r * r / 3.0 * length * arc.first;
  wedge.second =
      wedge.volume * length * length / 12.0 * u * u.transpose() + 0.25 * r * r * r * r * length * arc.second;
  return wedge;
}

/// The outward directions w at a vertex: a spherical polygon whose corners are the normals of the faces there
/// and whose sides are the arcs of the edges. Its integrals follow from its border:
/// - area: Gauss-Bonnet. The polygon turns by a face's own angle at each corner, so the area is 2 pi less
///   those angles; the whole sphere, which has no border, 4 pi.
/// - integral of w: half the integral of x cross dx along the border. An arc of angle a turns about the edge,
///   towards the vertex: the sum of -a d / 2, with d the edge's direction away from the vertex.
/// - integral of w w^T: by the divergence theorem on the sphere area/3 I plus a term for each arc that is
///   linear in d. The two ends of an edge have opposite d, so in the sum over all vertices these terms cancel
///   (all sectors moved together make one ball), and are left out.
struct DirectionSum {
  double area = 0.0;
  Vec3 first = Vec3::Zero();

  // A sector of the ball around the vertex.
  Moments moments(double r) const {
    const double r3 = r * r * r;
    return {area * r3 / 3.0, 0.25 * r3 * r * first, area * r3 * r * r / 15.0 * Mat3::Identity()};
  }
};

std::vector<DirectionSum> directionsAtVertices(const ConvexPolyhedron& core, std::span<const Arc> arcs) {
  const bool is_point = core.edgeCount() == 0;
  std::vector<DirectionSum> at(static_cast<std::size_t>(core.vertexCount()));
  for (DirectionSum& sum : at) sum.area = (is_point ? 4.0 : 2.0) * std::numbers::pi;
  for (int f = 0; f < core.faceCount(); ++f) {
    const std::span<const int> loop = core.faceVertices(f);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3& corner = core.vertex(loop[i]);
      const Vec3 before = core.vertex(loop[(i + loop.size() - 1) % loop.size()]) - corner;
      const Vec3 after = core.vertex(loop[(i + 1) % loop.size()]) - corner;
      at[static_cast<std::size_t>(loop[i])].area -= angleBetween(before.normalized(), after.normalized());
    }
  }
  for (int e = 0; e < core.edgeCount(); ++e) {
    const Edge& edge = core.edge(e);
    const Vec3 half_turn = 0.5 * arcs[static_cast<std::size_t>(e)].angle * edge.direction;
    at[static_cast<std::size_t>(edge.tail)].first -= half_turn;
    at[static_cast<std::size_t>(edge.head)].first += half_turn;
  }
  return at;
}

/// What the rounding adds to the core.
void addRounding(Moments& sum, const ConvexPolyhedron& core, double r, const Vec3& origin) {
  for (int f = 0; f < core.faceCount(); ++f)
    sum.add(slabMoments(core, f, r), core.vertex(core.faceVertices(f)[0]) - origin);
  std::vector<Arc> arcs;
  for (int e = 0; e < core.edgeCount(); ++e) {
    const Edge& edge = core.edge(e);
    arcs.push_back(arcOf(core, edge));
    const Vec3 middle = 0.5 * (core.vertex(edge.tail) + core.vertex(edge.head));
    sum.add(wedgeMoments(edge, arcs.back(), r), middle - origin);
  }
  const std::vector<DirectionSum> directions = directionsAtVertices(core, arcs);
  for (int v = 0; v < core.vertexCount(); ++v)
    sum.add(directions[static_cast<std::size_t>(v)].moments(r), core.vertex(v) - origin);
}

}  // namespace

MassProperties MassProperties::combined(const MassProperties& a, const MassProperties& b) {
  MassProperties sum;
  sum.mass = a.mass + b.mass;
  sum.center = (a.mass * a.center + b.mass * b.center) / sum.mass;
  sum.inertia = a.inertia + pointInertia(a.mass, a.center - sum.center) + b.inertia +
                pointInertia(b.mass, b.center - sum.center);
  return sum;
}

MassProperties roundedMass(const ConvexPolyhedron& core, double radius_m) {
  const Vec3& origin = core.vertex(0);  // near the body: no cancellation far from the origin
  Moments sum = coreMoments(core, origin);
  if (radius_m > 0.0) addRounding(sum, core, radius_m, origin);
  MassProperties result;
  if (!(sum.volume > 0.0)) return result;
  const Vec3 center = sum.first / sum.volume;
  const Mat3 covariance = sum.second - sum.volume * center * center.transpose();
  result.mass = sum.volume;
  result.center = origin + center;
  result.inertia = covariance.trace() * Mat3::Identity() - covariance;
  return result;
}

MassProperties polyhedronMass(const ConvexPolyhedron& polyhedron) {
  return roundedMass(polyhedron, 0.0);
}

}  // namespace carom
