// The contact polygon against the crossings of all pairs of boundary lines in long double, its names against
// the places of the features they name, and both against swapping and moving the bodies.

#include "engine/contact/contact_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "engine/contact/contact_id.h"
#include "engine/contact/contact_manifold.h"
#include "tests/oracle/placed_convex.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;
using oracle::Real;
using oracle::turned;
using oracle::Vec3R;
using Vec2R = Eigen::Matrix<Real, 2, 1>;

struct Pair {
  ConvexPart a;
  Pose X_WA;
  ConvexPart b;
  Pose X_WB;

  CollisionWindow window() const { return collisionWindow(a, b); }
  ClosestFeatures closest() const {
    FeaturePair cold;
    return closestFeatures(a, X_WA, b, X_WB, cold);
  }
  ContactPolygon polygon() const { return contactPolygon(closest(), a, X_WA, b, X_WB, window()); }
  ContactManifold manifold() const { return contactManifold(closest(), {a, X_WA, b, X_WB}, window()); }
  Pair swapped() const { return {b, X_WB, a, X_WA}; }
  Pair moved(const Pose& X) const { return {a, X * X_WA, b, X * X_WB}; }
};

ConvexPart box(double x, double y, double z, double radius_m = 0.0) {
  return {boxPolyhedron({x, y, z}), radius_m};
}
ConvexPart wheel(int n, double radius_m, double height_m) {
  return {oracle::prism(n, radius_m, height_m), 0.0};
}

// B with its bottom at this gap over A's top, both seen along z of frame F.
struct Layer {
  const ConvexPart& part;
  double height_m;
};

Pair stacked(const Layer& below, const Layer& above, double gap, const Vec2& shift, const Quat& turn,
             const Pose& X_WF) {
  const ConvexPart &a = below.part, &b = above.part;
  const Pose X_FA{Quat::Identity(), Vec3(0, 0, -0.5 * below.height_m - a.radius_m)};
  double lowest = 0.0;
  for (const Vec3& v : b.core.vertices()) lowest = std::min(lowest, (turn * v).z());
  if (turn.vec().head<2>().isZero(0.0)) lowest = -0.5 * above.height_m;  // upright: exactly
  return {a, X_WF * X_FA, b, X_WF * Pose{turn, Vec3(shift.x(), shift.y(), gap - lowest + b.radius_m)}};
}

// The face of a part that looks along `direction`, as corners and lines in the plane of the polygon.
struct Seen {
  std::vector<Vec3R> corners;  ///< In the frame (t1, t2, n).
  int face = -1;
};

using Mat3R = Eigen::Matrix<Real, 3, 3>;

Mat3R frameOf(const Vec3& n_W) {
  const Vec3R n = n_W.cast<Real>().normalized();
  const Vec3R t1 = n.unitOrthogonal();
  Mat3R R;
  R << t1.transpose(), n.cross(t1).transpose(), n.transpose();
  return R;
}

Seen seenFace(const ConvexPart& part, const Pose& X_W, const Vec3& direction_W, const Mat3R& R) {
  const oracle::PlacedConvex placed = oracle::place(part, X_W);
  Seen seen;
  Real most = -2;
  for (std::size_t f = 0; f < placed.face_normals.size(); ++f)
    if (const Real c = placed.face_normals[f].dot(direction_W.cast<Real>()); c > most) {
      most = c;
      seen.face = static_cast<int>(f);
    }
  for (const int v : part.core.faceVertices(seen.face))
    seen.corners.push_back(R * placed.vertices[static_cast<std::size_t>(v)]);
  return seen;
}

// Height of the plane through a face's corners over a place, by Newell's normal.
Real heightAt(const Seen& face, const Vec2R& p) {
  Vec3R sum = Vec3R::Zero();
  for (std::size_t i = 1; i + 1 < face.corners.size(); ++i)
    sum += (face.corners[i] - face.corners[0]).cross(face.corners[i + 1] - face.corners[0]);
  return face.corners[0].z() - (sum.template head<2>().dot(p - face.corners[0].template head<2>())) / sum.z();
}

struct HalfPlane {
  Vec2R into;
  Real offset;
};

struct OracleCorner {
  Vec2R p;
  Real gap;
};

struct Oracle {
  Mat3R R;
  Seen a, b;
  Real radii;
  std::vector<OracleCorner> corners;

  Real gap(const Vec2R& p) const { return heightAt(b, p) - heightAt(a, p) - radii; }
};

// All crossings of two boundary lines that lie inside all of them.
Oracle bruteForce(const Pair& pair, const Vec3& n_W) {
  Oracle o{frameOf(n_W), {}, {}, 0, {}};
  o.a = seenFace(pair.a, pair.X_WA, n_W, o.R);
  o.b = seenFace(pair.b, pair.X_WB, -n_W, o.R);
  o.radii = static_cast<Real>(pair.a.radius_m) + static_cast<Real>(pair.b.radius_m);
  std::vector<HalfPlane> planes;
  for (const Seen* face : {&o.a, &o.b}) {
    Vec2R middle = Vec2R::Zero();
    for (const Vec3R& c : face->corners) middle += c.head<2>() / static_cast<Real>(face->corners.size());
    for (std::size_t i = 0; i < face->corners.size(); ++i) {
      const Vec2R p = face->corners[i].head<2>(), q = face->corners[(i + 1) % face->corners.size()].head<2>();
      Vec2R into(-(q - p).y(), (q - p).x());
      into.normalize();
      if (into.dot(middle - p) < 0) into = -into;
      planes.push_back({into, into.dot(p)});
    }
  }
  const Real g0 = o.gap(Vec2R(0, 0));
  const Vec2R slope(o.gap(Vec2R(1, 0)) - g0, o.gap(Vec2R(0, 1)) - g0);
  if (slope.norm() > 1e-12L)
    planes.push_back(
        {-slope / slope.norm(), (g0 - static_cast<Real>(pair.window().manifold)) / slope.norm()});
  constexpr Real kInside = 1e-14L;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Real det = planes[i].into.x() * planes[j].into.y() - planes[i].into.y() * planes[j].into.x();
      if (std::abs(det) < 1e-12L) continue;
      const Vec2R p((planes[i].offset * planes[j].into.y() - planes[j].offset * planes[i].into.y()) / det,
                    (planes[j].offset * planes[i].into.x() - planes[i].offset * planes[j].into.x()) / det);
      bool inside = true;
      for (std::size_t k = 0; k < planes.size() && inside; ++k)
        inside = planes[k].into.dot(p) - planes[k].offset > -kInside;
      for (const OracleCorner& c : o.corners) inside = inside && (c.p - p).norm() > 1e-11L;
      if (inside) o.corners.push_back({p, o.gap(p)});
    }
  return o;
}

Real areaOf(std::vector<Vec2R> corners) {
  Vec2R middle = Vec2R::Zero();
  for (const Vec2R& c : corners) middle += c / static_cast<Real>(corners.size());
  std::sort(corners.begin(), corners.end(), [&](const Vec2R& x, const Vec2R& y) {
    return std::atan2(x.y() - middle.y(), x.x() - middle.x()) <
           std::atan2(y.y() - middle.y(), y.x() - middle.x());
  });
  Real twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2R p = corners[i] - middle, q = corners[(i + 1) % corners.size()] - middle;
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}

// How far a place is, seen along n, from what the name says of one part.
Real offFeature(const ConvexPart& part, const Pose& X_W, Feature feature, const Seen& face, const Mat3R& R,
                const Vec2R& p) {
  const oracle::PlacedConvex placed = oracle::place(part, X_W);
  const auto at = [&](int v) { return Vec2R((R * placed.vertices[static_cast<std::size_t>(v)]).head<2>()); };
  if (feature.kind == FeatureKind::kVertex) return (at(feature.index) - p).norm();
  if (feature.kind == FeatureKind::kFace) return feature.index == face.face ? 0 : 1;
  const Vec2R tail = at(part.core.edge(feature.index).tail);
  const Vec2R d = (at(part.core.edge(feature.index).head) - tail).normalized();
  return std::abs(d.x() * (p - tail).y() - d.y() * (p - tail).x());
}

// Corners, gaps, area, names: all as the oracle has them. `margin` is the tolerance within which corners are
// one.
void expectAsByBruteForce(const Pair& pair) {
  const ContactPolygon polygon = pair.polygon();
  const Oracle o = bruteForce(pair, polygon.n_W);
  const Real margin = 2 * static_cast<Real>(sameCorner_m(pair.X_WA, pair.X_WB, pair.window()));
  std::vector<Vec2R> found, expected;
  std::set<std::uint64_t> ids;
  for (const PolygonCorner& c : polygon.corners) {
    const Vec2R p = (o.R * c.p_W.cast<Real>()).head<2>();
    found.push_back(p);
    Real nearest = 1e9L;
    for (const OracleCorner& e : o.corners) nearest = std::min(nearest, (e.p - p).norm());
    EXPECT_LT(nearest, margin);
    EXPECT_NEAR(static_cast<double>(o.gap(p)), c.gap_m, 1e-12);
    const Real off_a = offFeature(pair.a, pair.X_WA, c.features.a, o.a, o.R, p);
    const Real off_b = offFeature(pair.b, pair.X_WB, c.features.b, o.b, o.R, p);
    EXPECT_LT(off_a, margin) << "not at the feature of A";
    EXPECT_LT(off_b, margin) << "not at the feature of B";
    const auto kinds = std::minmax(c.features.a.kind, c.features.b.kind);
    if (kinds.first == FeatureKind::kEdge && kinds.second == FeatureKind::kFace) {
      EXPECT_NEAR(c.gap_m, pair.window().manifold, 1e-12) << "an edge over a face is a corner only at k";
    }
    ids.insert(contactId(c.features));
  }
  EXPECT_EQ(ids.size(), polygon.corners.size()) << "each corner has a name of its own";
  for (const OracleCorner& e : o.corners) {
    expected.push_back(e.p);
    Real nearest = 1e9L;
    for (const Vec2R& p : found) nearest = std::min(nearest, (e.p - p).norm());
    EXPECT_LT(nearest, margin) << "a corner is missing";
  }
  if (found.size() > 2 && expected.size() > 2) {
    EXPECT_NEAR(static_cast<double>(areaOf(found)), static_cast<double>(areaOf(expected)), 1e-8);
  }
  const Vec3 n_a = pair.X_WA.rotation * pair.a.core.plane(o.a.face).normal;
  const Vec3 n_b = -(pair.X_WB.rotation * pair.b.core.plane(o.b.face).normal);
  const double off_normal = std::min({(polygon.n_W - n_a).norm(), (polygon.n_W - n_b).norm(),
                                      (polygon.n_W - (n_a + n_b).normalized()).norm()});
  EXPECT_LT(off_normal, 1e-14);
}

Quat smallTilt(Random& random, double most) {
  return turned(random.direction().cwiseProduct(Vec3(1, 1, 0)) + Vec3(1e-9, 0, 0), random.uniform(0, most));
}

TEST(ContactPolygon, OfBoxes_IsWhatAllPairsOfBoundaryLinesLeave) {
  const std::uint64_t seed = 401;
  Random random(seed);
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const double h_a = random.uniform(0.3, 1), h_b = random.uniform(0.3, 1);
    const ConvexPart a = box(random.uniform(0.5, 2), random.uniform(0.5, 2), h_a, i % 4 == 1 ? 0.05 : 0.0);
    const ConvexPart b = box(random.uniform(0.5, 2), random.uniform(0.5, 2), h_b, i % 4 == 2 ? 0.1 : 0.0);
    const Quat turn = smallTilt(random, i % 2 ? 6e-3 : 0.0) * turned(Vec3::UnitZ(), random.uniform(-3, 3));
    const Vec2 shift(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6));
    const Pair pair = stacked({a, h_a}, {b, h_b}, 3e-4, shift, turn, random.pose(5));
    if (pair.polygon().corners.size() < 2) continue;  // an edge or a corner beyond the rim is nearest
    expectAsByBruteForce(pair);
    if (HasFailure()) return;
  }
}

TEST(ContactPolygon, OfPrisms_IsWhatAllPairsOfBoundaryLinesLeave) {
  const std::uint64_t seed = 402;
  Random random(seed);
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const ConvexPart a = wheel(random.integer(3, 30), random.uniform(0.4, 1), 0.7);
    const ConvexPart b = wheel(random.integer(3, 30), random.uniform(0.4, 1), 0.5);
    const Quat turn = smallTilt(random, i % 2 ? 3e-3 : 0.0) * turned(Vec3::UnitZ(), random.uniform(-3, 3));
    const Vec2 shift(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
    expectAsByBruteForce(stacked({a, 0.7}, {b, 0.5}, 3e-4, shift, turn, random.pose(5)));
    if (HasFailure()) return;
  }
}

TEST(ContactPolygon, Of200GonsHasUpTo400Corners) {
  const std::uint64_t seed = 403;
  Random random(seed);
  const ConvexPart gon = wheel(200, 0.5, 0.4);
  const Pair centred = stacked({gon, 0.4}, {gon, 0.4}, 3e-4, Vec2::Zero(),
                               turned(Vec3::UnitZ(), std::numbers::pi / 200 + 1e-3), Pose{});
  EXPECT_EQ(centred.polygon().corners.size(), 400u);
  expectAsByBruteForce(centred);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Quat turn = smallTilt(random, i % 2 ? 2e-3 : 0.0) * turned(Vec3::UnitZ(), random.uniform(-3, 3));
    const Vec2 shift(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
    expectAsByBruteForce(stacked({gon, 0.4}, {gon, 0.4}, 3e-4, shift, turn, random.pose(5)));
  }
}

std::string nameOf(const FeaturePair& f) {
  const auto one = [](const Feature& x) { return "VEF"[static_cast<int>(x.kind)] + std::to_string(x.index); };
  return one(f.a) + "/" + one(f.b);
}

// Points by name; of a manifold, so that reduction is held to it as well.
std::map<std::string, ManifoldPoint> byName(const ContactManifold& manifold, bool swap) {
  std::map<std::string, ManifoldPoint> points;
  for (const ManifoldPoint& p : manifold.view())
    points[nameOf(swap ? swappedPair(p.features) : p.features)] = p;
  return points;
}
std::set<std::string> names(const ContactPolygon& polygon, bool swap = false) {
  std::set<std::string> all;
  for (const PolygonCorner& c : polygon.corners)
    all.insert(nameOf(swap ? swappedPair(c.features) : c.features));
  return all;
}

struct Case {
  std::string name;
  Pair pair;
};

// Contacts of every kind, in general position and, above all, in those special positions where rounding
// chooses: aligned, equal, coincident, parallel.
std::vector<Case> cases() {
  std::vector<Case> all;
  const Quat none = Quat::Identity();
  const Quat lying = turned(Vec3::UnitY(), std::numbers::pi / 2);
  const auto turnedBy = [](double angle) { return turned(Vec3::UnitZ(), angle); };
  const auto add = [&](const std::string& name, const Pair& pair) { all.push_back({name, pair}); };
  const ConvexPart cube = box(1, 1, 1), slab = box(3, 2, 0.5), wheel24 = wheel(24, 0.5, 1);
  add("cube stacked exactly on a cube", stacked({cube, 1}, {cube, 1}, 1e-3, {0, 0}, none, {}));
  add("cube on a cube, shifted along one axis", stacked({cube, 1}, {cube, 1}, 1e-3, {0.3, 0}, none, {}));
  add("cube on a cube, shifted along both", stacked({cube, 1}, {cube, 1}, 1e-3, {0.3, -0.2}, none, {}));
  add("cube on a cube, turned by 45 degrees",
      stacked({cube, 1}, {cube, 1}, 1e-3, {0, 0}, turnedBy(std::numbers::pi / 4), {}));
  add("cube on a cube, turned by 90 degrees",
      stacked({cube, 1}, {cube, 1}, 1e-3, {0, 0}, turnedBy(std::numbers::pi / 2), {}));
  // B's corner on A's rim, an edge of B leading outwards from it, A's corner under B.
  const Quat thirty = turnedBy(std::numbers::pi / 6);
  const Vec3 on_rim = Vec3(0.5, -0.2, 0) - thirty * Vec3(-0.5, -0.5, 0);
  add("cube with a corner on the rim of a cube",
      stacked({cube, 1}, {cube, 1}, 1e-3, on_rim.head<2>(), thirty, {}));
  for (const double s : {-1.0, 1.0})
    for (const double t : {-0.25, 0.25}) {
      add("cube sharing a side with a cube, along x", stacked({cube, 1}, {cube, 1}, 1e-3, {t, s}, none, {}));
      add("cube sharing a side with a cube, along y", stacked({cube, 1}, {cube, 1}, 1e-3, {s, t}, none, {}));
    }
  add("cube on a slab", stacked({slab, 0.5}, {cube, 1}, 1e-3, {0.4, 0.1}, turnedBy(0.3), {}));
  add("slab on a cube", stacked({cube, 1}, {slab, 0.5}, 1e-3, {0.4, 0.1}, turnedBy(0.3), {}));
  add("cube flush with a slab's corner", stacked({slab, 0.5}, {cube, 1}, 1e-3, {1, 0.5}, none, {}));
  add("cube tilted on a slab",
      stacked({slab, 0.5}, {cube, 1}, 3e-4, {0.4, 0.1}, turned({1, 2, 0}, 1e-3) * turnedBy(0.3), {}));
  add("cube tilted on a cube, reaching k",
      stacked({cube, 1}, {cube, 1}, 3e-4, {0.2, 0.1}, turned({1, 2, 0}, 8e-3) * turnedBy(0.3), {}));
  add("wheel on a wheel, corner on corner", stacked({wheel24, 1}, {wheel24, 1}, 1e-3, {0, 0}, none, {}));
  add("wheel on a wheel, half a corner on",
      stacked({wheel24, 1}, {wheel24, 1}, 1e-3, {0, 0}, turnedBy(std::numbers::pi / 24), {}));
  add("wheel on a wheel", stacked({wheel24, 1}, {wheel24, 1}, 1e-3, {0.2, 0.1}, turnedBy(0.1), {}));
  add("rounded box on a slab",
      stacked({slab, 0.5}, {box(0.8, 0.6, 0.4, 0.1), 0.4}, 1e-3, {0.4, 0.1}, turnedBy(0.3), {}));
  add("rounded box on a rounded box",
      stacked({box(0.8, 0.6, 0.4, 0.1), 0.4}, {box(0.8, 0.6, 0.4, 0.1), 0.4}, 1e-3, {0, 0}, none, {}));
  add("edge on a slab", {slab, Pose{none, Vec3(0, 0, -0.25)}, cube,
                         Pose{turnedBy(0.2) * turned(Vec3::UnitY(), std::numbers::pi / 4),
                              Vec3(0.2, 0.1, std::sqrt(0.5) + 1e-3)}});
  // Both roofs are equally flat: which of them lies on the slab is for their names to decide.
  const double rise = 0.5 * std::tan(3.0 * std::numbers::pi / 180);
  std::vector<Vec3> roof;
  for (const double y : {-0.5, 0.5}) {
    roof.emplace_back(0, y, -rise);
    for (const double x : {-0.5, 0.5})
      for (const double z : {0.0, 0.5}) roof.emplace_back(x, y, z);
  }
  add("flat roof on a slab, ridge down", {slab,
                                          Pose{none, Vec3(0, 0, -0.25)},
                                          {convexHull(roof).polyhedron, 0.0},
                                          Pose{turnedBy(0.2), Vec3(0.1, 0.2, rise + 1e-3)}});
  const ConvexPart capsule{ConvexPolyhedron::segment(Vec3(0, 0, -0.5), Vec3(0, 0, 0.5)), 0.2};
  const ConvexPart ball{ConvexPolyhedron::point(Vec3::Zero()), 0.3};
  add("capsule on a slab",
      {slab, Pose{none, Vec3(0, 0, -0.25)}, capsule, Pose{turnedBy(0.2) * lying, Vec3(0.2, 0.1, 0.201)}});
  add("capsule beside an equal capsule", {capsule, Pose{}, capsule, Pose{none, Vec3(0.401, 0, 0)}});
  add("capsule beside a capsule, overlapping", {capsule, Pose{}, capsule, Pose{none, Vec3(0.401, 0, 0.4)}});
  add("capsule beside a capsule upside down",
      {capsule, Pose{}, capsule, Pose{turned(Vec3::UnitX(), std::numbers::pi), Vec3(0.401, 0, 0.4)}});
  add("capsule across a capsule",
      {capsule, Pose{}, capsule, Pose{turned(Vec3::UnitX(), 1.0), Vec3(0.401, 0, 0)}});
  add("ball on a slab", {slab, Pose{none, Vec3(0, 0, -0.25)}, ball, Pose{none, Vec3(0.2, 0.1, 0.301)}});
  add("ball on a ball", {ball, Pose{}, ball, Pose{none, Vec3(0.2, 0.3, 0.5)}});
  const Quat edge_down = turned(Vec3::UnitY(), std::numbers::pi / 4);
  add("edge across an edge", {cube, Pose{edge_down, Vec3(0, 0, -std::sqrt(0.5))}, cube,
                              Pose{turnedBy(1.2) * edge_down, Vec3(0, 0, std::sqrt(0.5) + 1e-3)}});
  add("edge along an edge", {cube, Pose{edge_down, Vec3(0, 0, -std::sqrt(0.5))}, cube,
                             Pose{edge_down, Vec3(0, 0.3, std::sqrt(0.5) + 1e-3)}});
  return all;
}

TEST(ContactPolygon, IsTheSameFromBothBodies) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ContactPolygon polygon = c.pair.polygon(), from_b = c.pair.swapped().polygon();
    EXPECT_EQ(names(polygon), names(from_b, true));
    if (!polygon.corners.empty() && !from_b.corners.empty()) {
      EXPECT_EQ(symmetricKey(polygon.corners[0].features), symmetricKey(from_b.corners[0].features))
          << "both begin at the same corner";
    }
    const auto points = byName(c.pair.manifold(), false), swapped = byName(c.pair.swapped().manifold(), true);
    EXPECT_EQ(points.size(), swapped.size());
    for (const auto& [name, p] : points) {
      ASSERT_TRUE(swapped.contains(name)) << name;
      EXPECT_LT((p.p_W - swapped.at(name).p_W).norm(), 1e-9) << name;
      EXPECT_LT((p.n_W + swapped.at(name).n_W).norm(), 1e-9) << name;
      EXPECT_NEAR(p.gap_m, swapped.at(name).gap_m, 1e-12) << name;
    }
  }
}

TEST(ContactPolygon, MovesWithTheBodies_AlsoFarFromTheOrigin) {
  const std::uint64_t seed = 404;
  Random random(seed);
  for (const Case& c : cases()) {
    const auto points = byName(c.pair.manifold(), false);
    for (int i = 0; i < 30; ++i) {
      SCOPED_TRACE(testing::Message() << c.name << ", seed " << seed << " case " << i);
      const Pose X{random.rotation(), (i % 2 ? 1e4 : 3.0) * random.direction()};
      const Pair there = c.pair.moved(X);
      ASSERT_EQ(names(there.polygon()), names(c.pair.polygon()));
      const auto moved = byName(there.manifold(), false);
      ASSERT_EQ(moved.size(), points.size());
      for (const auto& [name, p] : points) {
        ASSERT_TRUE(moved.contains(name)) << name;
        EXPECT_LT((X * p.p_W - moved.at(name).p_W).norm(), 1e-9) << name;
        EXPECT_LT((X.rotation * p.n_W - moved.at(name).n_W).norm(), 1e-7) << name;
      }
    }
  }
}

TEST(ContactPolygon, KeepsItsNamesUnderMotionBelowTheTolerance) {
  const std::uint64_t seed = 405;
  Random random(seed);
  for (const Case& c : cases()) {
    const double little = 1e-10 * std::min(c.pair.a.width(), c.pair.b.width());
    const auto points = byName(c.pair.manifold(), false);
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(testing::Message() << c.name << ", seed " << seed << " case " << i);
      Pair moved = c.pair;
      moved.X_WB.position += little * random.direction();
      moved.X_WB.rotation = turned(random.direction(), little) * moved.X_WB.rotation;
      ASSERT_EQ(names(moved.polygon()), names(c.pair.polygon()));
      const auto now = byName(moved.manifold(), false);
      ASSERT_EQ(now.size(), points.size());
      for (const auto& [name, p] : points) ASSERT_TRUE(now.contains(name)) << name;
    }
  }
}

ConvexPart randomPart(Random& random) {
  const double size = random.logUniform(1e-2, 10);
  const double radius = random.integer(0, 2) == 0 ? 0.1 * size : 0.0;
  switch (random.integer(0, 4)) {
    case 0:
      return {oracle::prism(random.integer(3, 40), size, size * random.uniform(0.3, 2)), radius};
    case 1:
      return {oracle::randomHull(random, random.integer(4, 20), size * Vec3(1, 0.7, 0.4)), radius};
    case 2:
      return {ConvexPolyhedron::segment(Vec3(0, 0, -size), Vec3(0, 0, size)), 0.3 * size};
    default:
      return box(size, size * random.uniform(0.3, 2), size * random.uniform(0.3, 2), radius);
  }
}

// Two random parts at a gap inside the window; every other time turned so that a face of each is parallel to
// the other, or almost.
Pair randomContact(Random& random) {
  Pair pair{randomPart(random), Pose{random.rotation(), Vec3::Zero()}, randomPart(random), Pose{}};
  Quat turn = random.rotation();
  if (pair.a.core.faceCount() > 0 && pair.b.core.faceCount() > 0 && random.integer(0, 3) > 0) {
    const Vec3 n_a =
        pair.X_WA.rotation * pair.a.core.plane(random.integer(0, pair.a.core.faceCount() - 1)).normal;
    const Vec3 n_b = pair.b.core.plane(random.integer(0, pair.b.core.faceCount() - 1)).normal;
    const double tilt = random.integer(0, 1) == 0 ? 0.0 : random.logUniform(1e-6, 1e-1);
    turn = turned(random.direction(), tilt) * turned(n_a, random.uniform(-3, 3)) *
           Quat::FromTwoVectors(n_b, Vec3(-n_a));
    pair.X_WB = {turn, 100.0 * n_a};
  } else {
    pair.X_WB = {turn, 100.0 * random.direction()};
  }
  for (int i = 0; i < 5; ++i) {  // bring B to the gap along the shortest way
    const ClosestFeatures closest = pair.closest();
    pair.X_WB.position -= (closest.distance_m - 0.5 * pair.window().ceiling) * closest.n_W;
  }
  return pair;
}

TEST(ContactPolygon, OfRandomContacts_IsTheSameFromBothBodies_AndNamesEachPointOnce) {
  const std::uint64_t seed = 407;
  Random random(seed);
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Pair pair = randomContact(random);
    const ContactPolygon polygon = pair.polygon();
    flat += polygon.corners.size() > 2;
    ASSERT_EQ(names(polygon).size(), polygon.corners.size());
    ASSERT_EQ(names(polygon), names(pair.swapped().polygon(), true));
    const ContactManifold manifold = pair.manifold();
    std::set<std::uint64_t> ids;
    for (const ManifoldPoint& p : manifold.view()) ids.insert(p.id);
    EXPECT_EQ(static_cast<int>(ids.size()), manifold.count);
    const auto points = byName(manifold, false), swapped = byName(pair.swapped().manifold(), true);
    ASSERT_EQ(points.size(), swapped.size());
    for (const auto& [name, p] : points) {
      ASSERT_TRUE(swapped.contains(name)) << name;
      ASSERT_LT((p.p_W - swapped.at(name).p_W).norm(), 1e-9) << name;
      ASSERT_LT((p.n_W + swapped.at(name).n_W).norm(), 1e-7) << name;
      ASSERT_NEAR(p.gap_m, swapped.at(name).gap_m, 1e-11) << name;
    }
  }
  EXPECT_GT(flat, 1000);
}

std::size_t cornersOf(const Pair& pair) {
  return pair.polygon().corners.size();
}

TEST(ContactPolygon, OfExactlyStackedCubes_IsTheirFourCornersAndHalfwayBetweenTheirNormals) {
  const ConvexPart cube = box(1, 1, 1);
  Pair pair = stacked({cube, 1}, {cube, 1}, 1e-3, {0, 0}, Quat::Identity(), {});
  pair.X_WB.rotation = turned(Vec3::UnitX(), 1e-5);
  const ContactPolygon polygon = pair.polygon();
  ASSERT_EQ(polygon.corners.size(), 4u);
  EXPECT_LT((polygon.n_W - turned(Vec3::UnitX(), 0.5e-5) * Vec3::UnitZ()).norm(), 1e-14);
  pair.X_WB.rotation = Quat::Identity();
  for (const PolygonCorner& c : pair.polygon().corners) {
    EXPECT_EQ(c.features.a.kind, FeatureKind::kVertex);
    EXPECT_EQ(c.features.b.kind, FeatureKind::kVertex);
  }
}

TEST(ContactPolygon, OfFacesThatLean_HasTheGroundsNormalHoweverSmallItsFace) {
  const ConvexPart tile = box(0.2, 0.2, 1), plate = box(1, 1, 1);
  Pair pair = stacked({tile, 1}, {plate, 1}, 1e-3, {0, 0}, Quat::Identity(), {});
  pair.X_WB.rotation = turned(Vec3::UnitX(), 1e-6);
  const Vec3 of_plate = pair.X_WB.rotation * Vec3::UnitZ();
  const auto normal = [&](Ground ground) {
    ContactPolygon polygon;
    contactPolygon(pair.closest(), {pair.a, pair.X_WA, pair.b, pair.X_WB}, pair.window(), ground, polygon);
    EXPECT_EQ(polygon.corners.size(), 4u);
    return polygon.n_W;
  };
  EXPECT_EQ(normal(Ground::kA), Vec3::UnitZ());
  EXPECT_LT((normal(Ground::kB) - of_plate).norm(), 1e-15);
  EXPECT_LT((normal(Ground::kNone) - of_plate).norm(), 1e-15);
  // A lean that is more than rounding decides by itself: the tile's edge is below the plate's face.
  pair.X_WB.rotation = turned(Vec3::UnitX(), 1e-3);
  EXPECT_LT((normal(Ground::kA) - pair.X_WB.rotation * Vec3::UnitZ()).norm(), 1e-15);
}

TEST(ContactPolygon, OfFacesThatShareOnlyASideOrACorner_IsThatSideOrCorner) {
  const ConvexPart cube = box(1, 1, 1);
  const ContactPolygon side = stacked({cube, 1}, {cube, 1}, 1e-3, {1, 0.25}, Quat::Identity(), {}).polygon();
  ASSERT_EQ(side.corners.size(), 2u);
  for (const PolygonCorner& c : side.corners) {
    EXPECT_NEAR(c.p_W.x(), 0.5, 1e-12);
    EXPECT_EQ(std::set({c.features.a.kind, c.features.b.kind}),
              std::set({FeatureKind::kVertex, FeatureKind::kEdge}));
  }
  const ContactPolygon corner = stacked({cube, 1}, {cube, 1}, 1e-3, {1, 1}, Quat::Identity(), {}).polygon();
  ASSERT_EQ(corner.corners.size(), 1u);
  EXPECT_LT((corner.corners[0].p_W - Vec3(0.5, 0.5, 0.5e-3)).norm(), 1e-12);
}

TEST(ContactPolygon, OfSlivers_IsWhatAllPairsOfBoundaryLinesLeave) {
  const std::uint64_t seed = 406;
  Random random(seed);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const double breadth = random.logUniform(1e-4, 1e-2);
    const ConvexPart sliver = box(breadth, random.uniform(0.5, 2), 0.5);
    const Pair pair =
        stacked({box(1, 1, 0.5), 0.5}, {sliver, 0.5}, 1e-3 * breadth, {random.uniform(-0.4, 0.4), 0},
                turned(Vec3::UnitZ(), random.uniform(-3, 3)), random.pose(2));
    ASSERT_GE(cornersOf(pair), 4u);
    expectAsByBruteForce(pair);
    if (HasFailure()) return;
  }
}

TEST(ContactPolygon, WithSidesShorterThanTheTolerance_StillNamesEachCornerOnce) {
  const std::uint64_t seed = 408;
  Random random(seed);
  const double cut = 1e-10;  // off each corner of a square
  std::vector<Vec3> points;
  for (const double z : {-0.25, 0.25})
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        points.emplace_back(x - std::copysign(cut, x), y, z);
        points.emplace_back(x, y - std::copysign(cut, y), z);
      }
  // Around: the corners in the order of their angle.
  std::vector<int> ring{0, 1, 2, 3, 4, 5, 6, 7};
  std::sort(ring.begin(), ring.end(), [&](int i, int j) {
    const Vec3 &p = points[static_cast<std::size_t>(i)], &q = points[static_cast<std::size_t>(j)];
    return std::atan2(p.y(), p.x()) < std::atan2(q.y(), q.x());
  });
  std::vector<std::vector<int>> loops(2);
  for (int i = 0; i < 8; ++i) {
    const int here = ring[static_cast<std::size_t>(i)], next = ring[static_cast<std::size_t>((i + 1) % 8)];
    loops[0].insert(loops[0].begin(), here);
    loops[1].push_back(here + 8);
    loops.push_back({here, next, next + 8, here + 8});
  }
  const ConvexPart a{ConvexPolyhedron::fromFaces(points, loops), 0.0};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Quat turn = turned(Vec3::UnitZ(), i % 2 ? 0.0 : random.uniform(-3, 3));
    const Vec2 shift(random.uniform(-0.4, 0.4), i % 4 == 1 ? 0.0 : random.uniform(-0.4, 0.4));
    const ContactPolygon polygon = stacked({a, 0.5}, {a, 0.5}, 1e-4, shift, turn, random.pose(2)).polygon();
    ASSERT_GE(polygon.corners.size(), 3u);
    EXPECT_EQ(names(polygon).size(), polygon.corners.size());
  }
}

TEST(ContactPolygon, OfARoundedBoxOnAFace_IsTheCoresCornersMovedDownByTheRadius) {
  const double radius = 0.1;
  const ConvexPart rounded = box(0.8, 0.6, 0.4, radius);
  const ContactPolygon polygon =
      stacked({box(3, 2, 0.5), 0.5}, {rounded, 0.4}, 1e-3, {0.2, 0.1}, Quat::Identity(), {}).polygon();
  ASSERT_EQ(polygon.corners.size(), 4u);
  for (const PolygonCorner& c : polygon.corners) {
    EXPECT_NEAR(std::abs(c.p_W.x() - 0.2), 0.4, 1e-14);
    EXPECT_NEAR(std::abs(c.p_W.y() - 0.1), 0.3, 1e-14);
    EXPECT_NEAR(c.p_W.z(), 0.5e-3, 1e-14);
    EXPECT_NEAR(c.gap_m, 1e-3, 1e-14);
  }
}

TEST(ContactPolygon, OfWhatMeetsInAPoint_HasNoCorner) {
  for (const Case& c : cases())
    for (const char* name :
         {"capsule across a capsule", "ball on a slab", "ball on a ball", "edge across an edge"})
      if (c.name == name) {
        EXPECT_EQ(cornersOf(c.pair), 0u) << name;
        EXPECT_EQ(c.pair.manifold().count, 1) << name;
      }
}

TEST(ContactPolygon, OfAlmostParallelEdges_IsTheStretchWithinTheDistanceK) {
  // Ridges that cross at their ends: from the common end they part by sin(angle) a metre.
  const Quat ridge = turned(Vec3::UnitY(), std::numbers::pi / 4);
  const ConvexPart bar = box(0.2, 2, 0.2);
  const double angle = 0.02, z = std::sqrt(0.5) * 0.2;
  const Quat fan = turned(Vec3::UnitZ(), angle);
  const Pair pair{bar, Pose{ridge, Vec3(0, 1, -z)}, bar,
                  Pose{fan * ridge, fan * Vec3(0, 1, 0) + Vec3(0, 0, z + 5e-4)}};
  const ContactPolygon polygon = pair.polygon();
  ASSERT_EQ(polygon.corners.size(), 2u);
  double low = 1e9, high = -1e9;
  for (const PolygonCorner& c : polygon.corners) {
    low = std::min(low, c.p_W.y());
    high = std::max(high, c.p_W.y());
  }
  const double k = pair.window().manifold;
  const double lateral = std::sqrt(k * k - 25e-8);  // across, with the gap of 0.5 mm: k in all
  EXPECT_NEAR(low, 0.0, 1e-9);
  EXPECT_NEAR(high, 0.5 * lateral / std::sin(0.5 * angle) * std::cos(0.5 * angle), 1e-4);
}

}  // namespace
}  // namespace carom
