// Mass, centre and inertia against closed forms; turned and far from the origin.

#include "engine/solid/mass_properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

MassProperties moved(const MassProperties& m, const Pose& X) {
  const Mat3 R = X.rotation.toRotationMatrix();
  return {m.mass, X * m.center, R * m.inertia * R.transpose()};
}

ConvexPolyhedron moved(const ConvexPolyhedron& p, const Pose& X) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : p.vertices()) vertices.push_back(X * v);
  std::vector<std::vector<int>> loops;
  for (int f = 0; f < p.faceCount(); ++f)
    loops.emplace_back(p.faceVertices(f).begin(), p.faceVertices(f).end());
  return ConvexPolyhedron::fromFaces(vertices, loops);
}

void expectEqual(const MassProperties& got, const MassProperties& want, double relative, const char* what) {
  const double size = std::cbrt(want.mass);
  EXPECT_NEAR(got.mass, want.mass, relative * want.mass) << what;
  EXPECT_LT((got.center - want.center).norm(), relative * (size + want.center.norm())) << what;
  EXPECT_LT((got.inertia - want.inertia).norm(), relative * want.inertia.norm()) << what;
}

// In its own frame, in a general pose, and 10^4 sizes away, where the vertices themselves are rounded to
// 1e-12.
void expectEverywhere(const ConvexPolyhedron& p, const MassProperties& want, const char* what) {
  expectEqual(polyhedronMass(p), want, 1e-14, what);
  const Pose turned{oracle::turned(Vec3(1, -2, 0.5), 1.1), Vec3(0.3, -0.7, 1.9)};
  expectEqual(polyhedronMass(moved(p, turned)), moved(want, turned), 1e-14, what);
  const Pose far{oracle::turned(Vec3(-3, 1, 2), 2.3), Vec3(1e4, -2e4, 5e3)};
  expectEqual(polyhedronMass(moved(p, far)), moved(want, far), 1e-10, what);
}

TEST(PolyhedronMass, OfABox) {
  const double a = 0.7, b = 1.3, c = 2.9, m = a * b * c;
  const Mat3 inertia = (m / 12 * Vec3(b * b + c * c, a * a + c * c, a * a + b * b)).asDiagonal();
  expectEverywhere(boxPolyhedron({a, b, c}), {m, Vec3::Zero(), inertia}, "box");
  expectEverywhere(oracle::triangulatedBox({a, b, c}), {m, Vec3::Zero(), inertia}, "box of triangles");
}

TEST(PolyhedronMass, OfTheRegularSolids) {
  // With edge length s: volume and the inertia about any axis through the centre, for unit density.
  const double phi = std::numbers::phi, sqrt2 = std::numbers::sqrt2, sqrt5 = std::sqrt(5.0);
  struct Regular {
    const char* name;
    ConvexPolyhedron solid;
    double s, volume, per_mass;
  };
  const Regular solids[] = {
      {"tetrahedron", oracle::tetrahedron(), 2 * sqrt2, 8.0 / 3, 1.0 / 20},
      {"octahedron", oracle::octahedron(), sqrt2, 4.0 / 3, 1.0 / 10},
      {"icosahedron", oracle::icosahedron(), 2.0, 8 * 5 * (3 + sqrt5) / 12, phi * phi / 10},
      {"dodecahedron", oracle::dodecahedron(), 2 / phi, (15 + 7 * sqrt5) / 4 * 8 / (phi * phi * phi),
       (39 * phi + 28) / 150},
  };
  for (const auto& [name, solid, s, volume, per_mass] : solids)
    expectEverywhere(solid, {volume, Vec3::Zero(), volume * per_mass * s * s * Mat3::Identity()}, name);
}

TEST(PolyhedronMass, OfACornerTetrahedron_WithItsProductsOfInertia) {
  // Corners 0, (a,0,0), (0,b,0), (0,0,c): integral of x^2 = a^2 V/10, of xy = ab V/20, centroid at a quarter.
  const double a = 1.2, b = 0.8, c = 2.0, V = a * b * c / 6;
  const ConvexPolyhedron solid = ConvexPolyhedron::fromFaces({{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}},
                                                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const Vec3 s(a, b, c), center = s / 4;
  Mat3 second = V / 20 * s * s.transpose();
  second.diagonal() *= 2;
  const Mat3 covariance = second - V * center * center.transpose();
  expectEverywhere(solid, {V, center, covariance.trace() * Mat3::Identity() - covariance}, "corner");
}

TEST(PolyhedronMass, OfAPrismOverARegularPolygon) {
  const double R = 0.8, h = 1.7;
  for (int n : {3, 6, 60}) {
    const double turn = 2 * std::numbers::pi / n;
    const double area = 0.5 * n * R * R * std::sin(turn), m = area * h;
    const double polar = m * R * R * (2 + std::cos(turn)) / 6;  // about the axis
    const double across = polar / 2 + m * h * h / 12;
    expectEverywhere(oracle::prism(n, R, h), {m, Vec3::Zero(), Vec3(across, across, polar).asDiagonal()},
                     "prism");
  }
}

// Closed forms of ball and capsule: two fifths; a cylinder with half balls whose centroids are 3/8 r from
// their flat sides.
MassProperties ballMass(const Vec3& center, double r) {
  const double mass = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  return {mass, center, 0.4 * mass * r * r * Mat3::Identity()};
}
MassProperties capsuleMass(double r, double h) {
  const double cylinder = std::numbers::pi * r * r * h;
  const double caps = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double along = 0.5 * cylinder * r * r + 0.4 * caps * r * r;
  const double across =
      cylinder * (0.25 * r * r + h * h / 12.0) + caps * (0.4 * r * r + 0.25 * h * h + 0.375 * h * r);
  return {cylinder + caps, Vec3::Zero(), Vec3(across, across, along).asDiagonal()};
}
MassProperties capsuleAlongZ(double r, double h) {
  return roundedMass(ConvexPolyhedron::segment({0, 0, -h / 2}, {0, 0, h / 2}), r);
}

TEST(RoundedMass, OfAPointIsTheBall) {
  const MassProperties m = roundedMass(ConvexPolyhedron::point({1, 2, 3}), 0.5);
  expectEqual(m, ballMass({1, 2, 3}, 0.5), 1e-15, "ball");
  EXPECT_EQ(m.center, Vec3(1, 2, 3));
  EXPECT_EQ(m.inertia, Mat3(m.inertia(0, 0) * Mat3::Identity())) << "no axis is special, to the bit";
}

// Along the axis and across it, integrated numerically over discs: an oracle without half-ball centroids.
MassProperties capsuleByDiscs(double r, double h) {
  MassProperties sum;
  double along = 0, across = 0;
  const int n = 200000;
  const double dz = (h + 2 * r) / n;
  for (int i = 0; i < n; ++i) {
    const double z = -0.5 * h - r + (i + 0.5) * dz;
    const double beyond = std::max(std::abs(z) - 0.5 * h, 0.0);
    const double r2 = r * r - beyond * beyond;
    const double m = std::numbers::pi * r2 * dz;
    sum.mass += m;
    along += 0.5 * m * r2;
    across += m * (0.25 * r2 + z * z);
  }
  sum.inertia = Vec3(across, across, along).asDiagonal();
  return sum;
}

TEST(RoundedMass, OfASegmentIsTheCapsule) {
  for (const auto& [r, h] : {std::pair{0.5, 2.0}, {0.3, 0.1}, {2.0, 1e-3}}) {
    expectEqual(capsuleAlongZ(r, h), capsuleByDiscs(r, h), 1e-8, "capsule by discs");
    expectEqual(capsuleAlongZ(r, h), capsuleMass(r, h), 1e-14, "capsule");
  }
}

TEST(RoundedMass, TurnsWithItsCore) {
  const Pose X{oracle::turned(Vec3(1, 2, 3), 0.9), Vec3(4, -5, 6)};
  const ConvexPolyhedron segment = ConvexPolyhedron::segment(X * Vec3(0, 0, -1), X * Vec3(0, 0, 1));
  expectEqual(roundedMass(segment, 0.4), moved(capsuleAlongZ(0.4, 2), X), 1e-14, "turned capsule");
  oracle::Random random(41);
  for (const double r : {0.01, 0.3, 5.0}) {
    const ConvexPolyhedron hull = oracle::randomHull(random, 20, {1, 0.5, 2});
    expectEqual(roundedMass(moved(hull, X), r), moved(roundedMass(hull, r), X), 1e-13, "turned hull");
  }
}

// Steiner: V + S r + M r^2 + 4/3 pi r^3 with M half the sum of edge length times outer angle.
double steinerVolume(const ConvexPolyhedron& core, double r) {
  double surface = 0.0, mean = 0.0;
  for (int f = 0; f < core.faceCount(); ++f) {
    const std::span<const int> loop = core.faceVertices(f);
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      area += 0.5 * (core.vertex(loop[i]) - core.vertex(loop[0]))
                        .cross(core.vertex(loop[i + 1]) - core.vertex(loop[0]));
    surface += area.norm();
  }
  for (int e = 0; e < core.edgeCount(); ++e) {
    const Vec3 &a = core.plane(core.edge(e).left).normal, &b = core.plane(core.edge(e).right).normal;
    mean += 0.5 * core.edge(e).length_m * std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return polyhedronMass(core).mass + surface * r + mean * r * r + 4.0 / 3 * std::numbers::pi * r * r * r;
}

TEST(RoundedMass, VolumeIsSteinersPolynomial) {
  const Vec3 a(0.7, 1.3, 2.9);
  for (const double r : {1e-6, 0.1, 1.0, 30.0}) {
    const double box = a.prod() + 2 * (a.x() * a.y() + a.y() * a.z() + a.z() * a.x()) * r +
                       std::numbers::pi * a.sum() * r * r + 4.0 / 3 * std::numbers::pi * r * r * r;
    EXPECT_NEAR(roundedMass(boxPolyhedron(a), r).mass, box, 1e-14 * box);
    oracle::Random random(42);
    for (const ConvexPolyhedron& core :
         {oracle::tetrahedron(), oracle::dodecahedron(), oracle::prism(60, 1, 0.3),
          oracle::triangulatedBox(a), oracle::randomHull(random, 100, {1, 0.5, 0.05})})
      EXPECT_NEAR(roundedMass(core, r).mass, steinerVolume(core, r), 1e-13 * steinerVolume(core, r));
  }
}

// A box grown by r is the box, six slabs, twelve quarter cylinders and eight ball octants; the moments of
// each are elementary integrals in the axes of the box. By symmetry only the squares x^2, y^2, z^2 remain.
MassProperties roundedBoxByPieces(const Vec3& a, double r) {
  constexpr double pi = std::numbers::pi;
  const Vec3 h = 0.5 * a;
  double volume = a.prod();
  Vec3 squares = volume / 3.0 * h.cwiseProduct(h);  // integrals of x^2, y^2, z^2
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    // Two slabs across axis i.
    const double slab = 2.0 * a[j] * a[k] * r;
    volume += slab;
    squares[i] += 2.0 * a[j] * a[k] * (std::pow(h[i] + r, 3) - std::pow(h[i], 3)) / 3.0;
    squares[j] += slab * h[j] * h[j] / 3.0;
    squares[k] += slab * h[k] * h[k] / 3.0;
    // Four quarter cylinders along axis i: area pi r^2/4, first moment r^3/3, second pi r^4/16.
    const double quarter = 4.0 * a[i] * pi * r * r / 4.0;
    volume += quarter;
    squares[i] += quarter * h[i] * h[i] / 3.0;
    for (int side : {j, k})
      squares[side] += 4.0 * a[i] *
                       (h[side] * h[side] * pi * r * r / 4.0 + 2.0 * h[side] * r * r * r / 3.0 +
                        pi * r * r * r * r / 16.0);
    // Eight octants: volume pi r^3/6, first moment pi r^4/16, second pi r^5 2/60.
    squares[i] += 8.0 * (h[i] * h[i] * pi * r * r * r / 6.0 + 2.0 * h[i] * pi * std::pow(r, 4) / 16.0 +
                         pi * std::pow(r, 5) / 30.0);
  }
  volume += 4.0 / 3 * pi * r * r * r;
  const Vec3 inertia = Vec3::Constant(squares.sum()) - squares;
  return {volume, Vec3::Zero(), inertia.asDiagonal()};
}

TEST(RoundedMass, OfABoxIsTheSumOfItsTwentySevenPieces) {
  const Vec3 a(0.7, 1.3, 2.9);
  for (const double r : {0.0, 1e-6, 0.1, 1.0, 30.0})
    expectEqual(roundedMass(boxPolyhedron(a), r), roundedBoxByPieces(a, r), 2e-14, "rounded box");
}

// Volume, centre and inertia by summing over rays p = s w, 0 <= s <= R(w), from a point inside: the integrals
// of s^2, s^3 w and s^4 w w^T. The directions are the midpoints of a grid on the faces of a cube, whose error
// falls as 1/n^2. R(w) is where the distance from the core, by brute force over its features, is r.
double distanceToCore(const ConvexPolyhedron& core, const Vec3& p) {
  double inside = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < core.faceCount(); ++f) inside = std::max(inside, core.plane(f).signedDistance(p));
  if (inside <= 0.0) return inside;
  double best = std::numeric_limits<double>::infinity();
  for (int f = 0; f < core.faceCount(); ++f) {
    const std::span<const int> loop = core.faceVertices(f);
    bool over = true;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 tail = core.vertex(loop[i]), side = core.vertex(loop[(i + 1) % loop.size()]) - tail;
      over = over && side.cross(p - tail).dot(core.plane(f).normal) >= 0.0;
      const double share = std::clamp((p - tail).dot(side) / side.squaredNorm(), 0.0, 1.0);
      best = std::min(best, (p - tail - share * side).norm());
    }
    const double height = core.plane(f).signedDistance(p);
    if (over && height >= 0.0) best = std::min(best, height);
  }
  return best;
}

double reachAlong(const ConvexPolyhedron& core, double r, const Vec3& middle, const Vec3& w) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 40; ++i) {
    const double s = 0.5 * (low + high);
    (distanceToCore(core, middle + s * w) <= r ? low : high) = s;
  }
  return 0.5 * (low + high);
}

MassProperties massByRays(const ConvexPolyhedron& core, double r, const Vec3& middle, int n) {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          Vec3 c;
          c[axis] = sign;
          c[(axis + 1) % 3] = (2.0 * i + 1.0) / n - 1.0;
          c[(axis + 2) % 3] = (2.0 * j + 1.0) / n - 1.0;
          const double angle = 4.0 / (n * n) / std::pow(c.norm(), 3);
          const Vec3 w = c.normalized();
          const double R = reachAlong(core, r, middle, w);
          volume += angle * R * R * R / 3.0;
          first += angle * std::pow(R, 4) / 4.0 * w;
          second += angle * std::pow(R, 5) / 5.0 * w * w.transpose();
        }
  const Vec3 center = first / volume;
  const Mat3 covariance = second - volume * center * center.transpose();
  return {volume, middle + center, covariance.trace() * Mat3::Identity() - covariance};
}

TEST(RoundedMass, OfAnyHullIsWhatRaysIntegrate) {
  oracle::Random random(43);
  for (const double r : {0.05, 0.4}) {
    const ConvexPolyhedron hull = oracle::randomHull(random, 9, {1, 0.6, 0.8});
    const Vec3 middle = polyhedronMass(hull).center;
    expectEqual(roundedMass(hull, r), massByRays(hull, r, middle, 96), 1e-4, "hull");
  }
  const ConvexPolyhedron corner = oracle::tetrahedron();
  expectEqual(roundedMass(corner, 0.3), massByRays(corner, 0.3, Vec3(0.1, 0, 0), 96), 1e-4, "tetrahedron");
}

TEST(RoundedMass, GoesToItsLimits) {
  const ConvexPolyhedron box = boxPolyhedron({0.7, 1.3, 2.9});
  expectEqual(roundedMass(box, 1e-13), polyhedronMass(box), 1e-12, "no radius");
  const double tiny = 1e-12;
  expectEqual(roundedMass(boxPolyhedron({tiny, tiny, tiny}), 0.5), ballMass(Vec3::Zero(), 0.5), 1e-11,
              "ball");
  expectEqual(roundedMass(boxPolyhedron({tiny, tiny, 2}), 0.5), capsuleMass(0.5, 2), 1e-11, "capsule");
}

TEST(RoundedMass, CoplanarTrianglesChangeNothing) {
  const Vec3 a(0.7, 1.3, 2.9);
  expectEqual(roundedMass(oracle::triangulatedBox(a), 0.2), roundedMass(boxPolyhedron(a), 0.2), 1e-14,
              "triangulated");
}

TEST(CombinedMass, OfTwoHalvesIsTheWhole) {
  const MassProperties left =
      moved(polyhedronMass(boxPolyhedron({1, 2, 3})), {Quat::Identity(), Vec3(-0.5, 0, 0)});
  const MassProperties right =
      moved(polyhedronMass(boxPolyhedron({1, 2, 3})), {Quat::Identity(), Vec3(0.5, 0, 0)});
  expectEqual(MassProperties::combined(left, right), polyhedronMass(boxPolyhedron({2, 2, 3})), 1e-14,
              "two halves");
}

}  // namespace
}  // namespace carom
