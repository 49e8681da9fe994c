#include "engine/environment/rounded_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

Plane randomPlane(oracle::Random& random, double reach) {
  const Vec3 n =
      Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)).normalized();
  return {n, random.uniform(-reach, reach)};
}

/// A disk of radius R about a height h over the plane, the plane tilted so that height changes by `slope` a
/// metre: the area below, and its first moment along the rise.
struct Slice {
  Real area = 0, moment = 0;
};
Slice diskBelow(Real radius, Real height, Real slope) {
  const Real t = slope > 0 ? -height / slope : (height <= 0 ? 2 * radius : -2 * radius);
  if (t >= radius) return {kPi * radius * radius, 0};
  if (t <= -radius) return {};
  const Real half = std::sqrt((radius - t) * (radius + t));
  return {radius * radius * (kPi - std::acos(t / radius)) + t * half, -2 * half * half * half / 3};
}

/// Independent of the code: a capsule along z by disks across its axis, in long double, with a substitution
/// that smooths the ends (the step of a plane through a disk's rim stays: 40000 disks a third).
struct Slices {
  Real volume = 0, along = 0, across = 0;
};
Slices capsuleBelow(double r, double length, const Plane& plane) {
  const Real u = plane.normal.z(), slope = std::sqrt(1 - u * u);
  const Real half = Real(length) / 2, R = r;
  Slices sum;
  const auto addThird = [&](Real low, Real high, int n) {
    for (int i = 0; i < n; ++i) {
      const Real angle = kPi * (Real(i) + Real(0.5)) / n - kPi / 2;
      const Real s = (low + high) / 2 + (high - low) / 2 * std::sin(angle);
      const Real weight = (high - low) / 2 * std::cos(angle) * kPi / n;
      const Real beyond = std::max(std::abs(s) - half, Real(0));
      const Slice disk =
          diskBelow(std::sqrt(std::max(R * R - beyond * beyond, Real(0))), s * u - Real(plane.offset), slope);
      sum.volume += weight * disk.area;
      sum.along += weight * disk.area * s;
      sum.across += weight * disk.moment;
    }
  };
  addThird(-half - R, -half, 20000);
  addThird(-half, half, 20000);
  addThird(half, half + R, 20000);
  return sum;
}

TEST(RoundedCut, BallCapsAreTheClosedForm) {
  oracle::Random random(3);
  RoundedScratch scratch;
  const Solid ball = Solid::ball(0.7);
  for (int i = 0; i < 2000; ++i) {
    const Plane plane = randomPlane(random, 0.7);
    const VolumeMoments cap = cutRounded(ball.parts()[0], plane, scratch);
    const double d = 0.7 + plane.offset;
    ASSERT_NEAR(cap.volume_m3, std::numbers::pi * d * d * (3.0 * 0.7 - d) / 3.0, 1e-14);
    const double below = 3.0 * (1.4 - d) * (1.4 - d) / (4.0 * (2.1 - d));
    ASSERT_LT((cap.centroid() + below * plane.normal).norm(), 1e-9);
  }
}

TEST(RoundedCut, CapsulesAgreeWithDisksInLongDouble) {
  oracle::Random random(5);
  RoundedScratch scratch;
  const Solid capsule = Solid::capsule(0.3, 0.8);
  for (int i = 0; i < 60; ++i) {
    Plane plane = randomPlane(random, 0.6);
    if (i % 10 == 0) plane.normal = i % 20 == 0 ? Vec3::UnitZ() : Vec3::UnitX();
    const VolumeMoments cut = cutRounded(capsule.parts()[0], plane, scratch);
    const Slices exact = capsuleBelow(0.3, 0.8, plane);
    // Disks level with the plane are in or out as a whole: one of 20000 may be either.
    const double accuracy = plane.normal == Vec3::UnitZ() ? 2e-5 : 2e-9;
    ASSERT_NEAR(cut.volume_m3, static_cast<double>(exact.volume), accuracy) << i;
    ASSERT_NEAR(cut.first_m4.z(), static_cast<double>(exact.along), accuracy) << i;
    const Vec3 across = Vec3(plane.normal.x(), plane.normal.y(), 0.0);
    if (across.norm() < 1e-6) continue;
    ASSERT_NEAR(cut.first_m4.dot(across.normalized()), static_cast<double>(exact.across), accuracy) << i;
  }
}

/// The chord of a rounded box along the plane's normal: bisection on the distance to the core.
struct Chord {
  double low = 0.0, high = 0.0;
};
bool chordOf(const Vec3& half, double r, const Vec3& base, const Vec3& n, Chord& chord) {
  const auto distance = [&](double s) {
    const Vec3 p = base + s * n;
    return (p - p.cwiseMax(-half).cwiseMin(half)).norm() - r;
  };
  double a = -2.0, b = 2.0;  // the distance is convex: its lowest point by golden section
  for (int i = 0; i < 60; ++i) {
    const double left = a + 0.382 * (b - a), right = b - 0.382 * (b - a);
    (distance(left) < distance(right) ? b : a) = distance(left) < distance(right) ? right : left;
  }
  const double inside = 0.5 * (a + b);
  if (distance(inside) > 0.0) return false;
  const auto bisect = [&](double in, double out) {
    for (int i = 0; i < 45; ++i) (distance(0.5 * (in + out)) <= 0.0 ? in : out) = 0.5 * (in + out);
    return in;
  };
  chord = {bisect(inside, -2.0), bisect(inside, 2.0)};
  return true;
}

TEST(RoundedCut, RoundedBoxesAgreeWithChords) {
  oracle::Random random(9);
  RoundedScratch scratch;
  const double r = 0.15;
  const Solid solid = Solid::roundedBox(Vec3(1.0, 0.8, 0.6), r);
  const Vec3 half = 0.5 * Vec3(1.0, 0.8, 0.6) - Vec3::Constant(r);
  for (int i = 0; i < 6; ++i) {
    const Plane plane = randomPlane(random, 0.35);
    const TangentBasis basis = tangentBasis(plane.normal);
    const int n = 220;
    const double cell = 1.6 / n;
    double volume = 0.0;
    Vec3 first = Vec3::Zero();
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        const Vec3 base = ((x + 0.5) * cell - 0.8) * basis.t1 + ((y + 0.5) * cell - 0.8) * basis.t2;
        Chord chord;
        if (!chordOf(half, r, base, plane.normal, chord) || chord.low > plane.offset) continue;
        chord.high = std::min(chord.high, plane.offset);
        const double length = chord.high - chord.low;
        volume += cell * cell * length;
        first += cell * cell * length * (base + 0.5 * (chord.low + chord.high) * plane.normal);
      }
    }
    const VolumeMoments cut = cutRounded(solid.parts()[0], plane, scratch);
    EXPECT_NEAR(cut.volume_m3, volume, 4e-4) << i;
    EXPECT_LT((cut.first_m4 - first).norm(), 3e-4) << i;
  }
}

// The volume's slope in the offset is the area of the cut, which does not depend on the side it is seen from;
// and both sides together are the whole, in volume and first moment (the centre of mass is the origin).
TEST(RoundedCut, BothSidesTogetherAreTheWhole) {
  oracle::Random random(13);
  RoundedScratch scratch;
  std::vector<Solid> solids{Solid::capsule(0.2, 0.9), Solid::roundedBox(Vec3(1.0, 0.8, 0.6), 0.1),
                            Solid({{oracle::dodecahedron(), 0.3}}), Solid({{oracle::tetrahedron(), 0.2}})};
  for (int i = 0; i < 10; ++i) solids.push_back(Solid({{oracle::randomHull(random, 14), 0.25}}));
  for (const Solid& solid : solids) {
    for (int i = 0; i < 300; ++i) {
      const Plane plane = randomPlane(random, 0.9 * solid.radius());
      const VolumeMoments a = cutRounded(solid.parts()[0], plane, scratch);
      const VolumeMoments b = cutRounded(solid.parts()[0], {-plane.normal, -plane.offset}, scratch);
      ASSERT_NEAR((a.volume_m3 + b.volume_m3) / solid.volume(), 1.0, 1e-12);
      ASSERT_LT((a.first_m4 + b.first_m4).norm() / solid.volume(), 1e-11);
    }
  }
}

}  // namespace
}  // namespace carom
