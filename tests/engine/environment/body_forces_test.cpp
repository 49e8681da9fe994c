#include "engine/environment/body_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

constexpr double kDensity = 600.0;

/// A body with what its forces need.
struct Subject {
  Solid solid;
  SolidSurface surface;
  Inertia inertia;

  explicit Subject(Solid s)
      : solid(std::move(s)),
        surface(surfaceOf(solid)),
        inertia(inertiaOf(kDensity, solid.volume(), solid.unitInertia())) {}
  Subject(const Subject&) = delete;

  BodyForces forces(const Environment& environment, const Pose& X_WB, const Vec6& v = Vec6::Zero()) const {
    ForceScratch scratch;
    return bodyForces(environment, {&surface, &inertia, {}}, X_WB, v, 0.0, scratch);
  }
};

Solid dumbbell() {
  return Solid({{boxPolyhedron(Vec3(0.4, 0.3, 0.2)), 0.0},
                {ConvexPolyhedron::point(Vec3(0.6, 0.1, 0.0)), 0.25},
                {ConvexPolyhedron::segment(Vec3(-0.3, 0.0, 0.4), Vec3(-0.3, 0.4, 0.6)), 0.1}});
}

std::vector<Solid> allForms() {
  return {Solid::box(Vec3(0.6, 0.5, 0.4)),
          Solid::ball(0.3),
          Solid::capsule(0.15, 0.5),
          Solid::roundedBox(Vec3(0.6, 0.5, 0.4), 0.08),
          Solid::polyhedron(oracle::dodecahedron()),
          dumbbell()};
}

Environment pool(double drag = 0.0, double linear_drag = 0.0) {
  Environment environment;
  environment.gravity = Vec3(0.0, 0.0, -9.81);
  Fluid water;
  water.drag = drag;
  water.linear_drag_mps = linear_drag;
  environment.fluids.push_back(water);
  return environment;
}

Quat someTurn() {
  return oracle::turned(Vec3(1.0, 2.0, 0.7), 0.9);
}

TEST(BodyForces, UnderWaterTheLiftIsTheWeightOfTheWaterAndHasNoMomentForAnyForm) {
  for (Solid& solid : allForms()) {
    const Subject s(std::move(solid));
    const Pose X_WB{someTurn(), Vec3(0.3, 0.2, -3.0)};
    const Vec6 load = s.forces(pool(), X_WB).load;
    const Vec3 force_W = X_WB.rotation * Vec3(load.head<3>());
    const double expected = (1000.0 - kDensity) * s.solid.volume() * 9.81;
    EXPECT_LT((force_W - Vec3(0.0, 0.0, expected)).norm(), 1e-10 * expected);
    EXPECT_LT(load.tail<3>().norm(), 1e-10 * expected);
  }
}

// The lift is minus the slope of the potential, and its moment that about two level axes.
TEST(BodyForces, LiftAndMomentAreTheSlopesOfThePotential) {
  const Environment environment = pool();
  for (Solid& solid : allForms()) {
    const Subject s(std::move(solid));
    ForceScratch scratch;
    const auto potential = [&](const Pose& X) {
      return buoyancyPotential(environment, s.surface, X, 0.0, scratch);
    };
    for (double z : {-0.15, 0.0, 0.07}) {
      const Pose X_WB{someTurn(), Vec3(0.0, 0.0, z)};
      const Vec6 load = s.forces(environment, X_WB).load;
      const Vec3 force = X_WB.rotation * Vec3(load.head<3>()) + s.inertia.mass_kg * Vec3(0.0, 0.0, 9.81);
      const Vec3 torque = X_WB.rotation * Vec3(load.tail<3>());
      const double h = 1e-5;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Pose up = X_WB, down = X_WB;
        up.position += h * Vec3::Unit(axis);
        down.position -= h * Vec3::Unit(axis);
        EXPECT_NEAR(force[axis], -(potential(up) - potential(down)) / (2.0 * h), 1e-4);
        up = down = X_WB;
        up.rotation = oracle::turned(Vec3::Unit(axis), h) * X_WB.rotation;
        down.rotation = oracle::turned(Vec3::Unit(axis), -h) * X_WB.rotation;
        EXPECT_NEAR(torque[axis], -(potential(up) - potential(down)) / (2.0 * h), 1e-4);
      }
    }
  }
}

// Entry and exit without a kick: where the force changes most between two depths, it does so evenly: among
// fifty parts of that way none takes a fifth of the change, which a jump would.
TEST(BodyForces, AllForcesAreContinuousInTheDepth) {
  const Environment environment = pool(1.0, 0.05);
  for (const Quat& turn : {Quat(Quat::Identity()), someTurn()}) {
    for (double speed : {-3.0, 3.0}) {
      for (Solid& solid : allForms()) {
        const Subject s(std::move(solid));
        Vec6 v;
        v.head<3>() = turn.conjugate() * Vec3(0.4, 0.0, speed);
        v.tail<3>() = Vec3(0.1, 0.2, 0.3);
        const auto at = [&](double z) {
          return s.forces(environment, {turn, Vec3(0.0, 0.0, z)}, v).total(v);
        };
        const auto largestChange = [&](double low, double high, int parts) {
          std::pair<double, double> worst{0.0, low};
          Vec6 before = at(low);
          for (int i = 1; i <= parts; ++i) {
            const Vec6 now = at(low + (high - low) * i / parts);
            worst = std::max(worst, {(now - before).norm(), low + (high - low) * (i - 1) / parts});
            before = now;
          }
          return worst;
        };
        const double reach = s.solid.radius() + 0.05, step = 2.0 * reach / 700;
        const auto [change, where] = largestChange(-reach, reach, 700);
        EXPECT_LT(largestChange(where, where + step, 50).first, 0.2 * change)
            << "at " << speed << " m/s, z = " << where << ", form of " << s.solid.volume() << " m^3";
      }
    }
  }
}

TEST(BodyForces, ABodyHalfOverTheEdgeOfAPoolDisplacesOnlyWhatIsInIt) {
  Environment environment = pool();
  environment.fluids[0].min = Vec3(-2.0, -2.0, -2.0);
  environment.fluids[0].max = Vec3(0.0, 2.0, 0.0);
  const Subject s(Solid::box(Vec3(0.6, 0.5, 0.4)));
  const BodyForces f = s.forces(environment, {Quat::Identity(), Vec3(0.1, 0.0, 0.0)});
  EXPECT_NEAR(f.submerged_m3, 0.2 * 0.5 * 0.2, 1e-15);
  EXPECT_GT(f.load[4], 0.0) << "it is lifted on the side of -x, which turns it about +y";
}

TEST(BodyForces, TwoPoolsSideBySideLiftAsOne) {
  Environment one = pool(1.0, 0.05), two = pool(1.0, 0.05);
  two.fluids.push_back(two.fluids[0]);
  two.fluids[0].max.x() = 0.05;
  two.fluids[1].min.x() = 0.05;
  const Subject s(Solid::box(Vec3(0.6, 0.5, 0.4)));
  const Pose X_WB{someTurn(), Vec3(0.0, 0.0, -0.1)};
  Vec6 v;
  v << 0.3, -0.2, 0.5, 0.1, 0.7, -0.4;
  const BodyForces a = s.forces(one, X_WB, v), b = s.forces(two, X_WB, v);
  EXPECT_LT((a.load - b.load).norm(), 1e-9 * a.load.norm());
  EXPECT_LT((a.linear - b.linear).norm(), 0.02 * a.linear.norm());
}

TEST(BodyForces, AddedMassIsThatOfTheDisplacedFluid) {
  Environment environment = pool();
  environment.fluids[0].added_mass = 0.5;
  const Subject s(Solid::ball(0.3));
  const BodyForces f = s.forces(environment, {Quat::Identity(), Vec3(0.0, 0.0, -2.0)});
  EXPECT_NEAR(f.added_mass(2, 2), 0.5 * 1000.0 * s.solid.volume(), 1e-9);
}

TEST(BodyForces, AirPressesOnlyOnWhatIsDry) {
  Environment environment = pool();
  environment.air.density_kgpm3 = 1.2;
  environment.air.wind = Vec3(-10.0, 0.0, 0.0);
  for (Solid& solid : allForms()) {
    const Subject s(std::move(solid));
    const auto push = [&](double z) {
      return -s.forces(environment, {Quat::Identity(), Vec3(0.0, 0.0, z)}).total(Vec6::Zero())[0];
    };
    EXPECT_GT(push(5.0), 0.0);
    EXPECT_EQ(push(-5.0), 0.0);
    EXPECT_GT(push(0.0), 0.2 * push(5.0));
    EXPECT_LT(push(0.0), 0.8 * push(5.0));
  }
}

TEST(BodyForces, MirroredAndTurnedAboutTheVerticalTheyAreTheSame) {
  Environment environment = pool(1.0, 0.05);
  environment.air = {1.2, Vec3(3.0, 1.0, 0.0), 0.0};
  environment.fluids[0].flow = Vec3(0.5, -0.3, 0.0);
  const Subject s(Solid::box(Vec3(0.6, 0.5, 0.4)));
  const Pose X_WB{someTurn(), Vec3(0.0, 0.0, -0.05)};
  Vec6 v;
  v << 0.3, -0.2, 0.5, 0.1, 0.7, -0.4;
  const Vec6 expected = s.forces(environment, X_WB, v).total(v);
  const Quat turn = oracle::turned(Vec3::UnitZ(), 1.1);
  Environment turned = environment;
  turned.air.wind = turn * environment.air.wind;
  turned.fluids[0].flow = turn * environment.fluids[0].flow;
  const Vec6 same = s.forces(turned, {turn * X_WB.rotation, X_WB.position}, v).total(v);
  EXPECT_LT((same - expected).norm(), 1e-10 * expected.norm());

  // The mirror y -> -y: rotation vectors turn the other way; a box is its own image.
  const auto mirrored = [](const Vec3& p) { return Vec3(p.x(), -p.y(), p.z()); };
  Environment image = environment;
  image.air.wind = mirrored(environment.air.wind);
  image.fluids[0].flow = mirrored(environment.fluids[0].flow);
  const Quat& q = X_WB.rotation;
  Vec6 w;
  w.head<3>() = mirrored(v.head<3>());
  w.tail<3>() = -mirrored(v.tail<3>());
  const Vec6 reflected = s.forces(image, {Quat(q.w(), -q.x(), q.y(), -q.z()), X_WB.position}, w).total(w);
  EXPECT_LT((mirrored(reflected.head<3>()) - expected.head<3>()).norm(), 1e-10 * expected.norm());
  EXPECT_LT((-mirrored(reflected.tail<3>()) - expected.tail<3>()).norm(), 1e-10 * expected.norm());
}

// Linear drag is its coefficient times the surface, however small: the side along the axis and half a ball at
// each end. About the axis and across it that differs by what the places along it make of it.
TEST(BodyForces, ACapsulesLinearDragIsThatOfItsSurfaceAtItsPlaces) {
  const double r = 0.15, length = 0.5;
  const Subject s(Solid::capsule(r, length));
  const double side = 2.0 * std::numbers::pi * r * length, ends = 4.0 * std::numbers::pi * r * r;
  for (const double drag_mps : {1e-3, 0.05}) {
    const Mat6 linear = s.forces(pool(0.0, drag_mps), {someTurn(), Vec3(0.0, 0.0, -3.0)}).linear;
    const double c = 1000.0 * drag_mps;
    EXPECT_NEAR(linear(0, 0), c * (side + ends), 1e-12 * c);
    EXPECT_LT((linear.topRightCorner<3, 3>().norm()), 1e-12 * c);
    EXPECT_NEAR(linear(3, 3) - linear(5, 5), c * (side / 12.0 + ends / 4.0) * length * length, 1e-12 * c);
    EXPECT_NEAR(linear(4, 4), linear(3, 3), 1e-12 * c);
  }
}

}  // namespace
}  // namespace carom
